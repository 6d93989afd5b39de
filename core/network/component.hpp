#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/signal.hpp"
#include "core/network/dual.hpp"

namespace rheonet {

class Characteristic;
class SwitchedFunction;

/// The role of an element in a network. Structural analysis depends on nothing else of a law.
enum class Role {
  deflection,  ///< Force from a deflection p of its own: f = force(p), p' = w - creep(f). Springs and all laws with a memory.
  rate,        ///< Force from the relative velocity: f = force(w), or w = rate(f). Dashpots.
  slip,        ///< Sticks under any force up to a bound, otherwise slips at this bound. Ideal sliders.
  mass,        ///< Inertia of a node.
  inerter,     ///< f = b w'.
  train,       ///< A transmission that is an equation between the velocities of up to three nodes: SceneElement::row.
  motion,      ///< Prescribes a node's motion.
  force,       ///< Applies a given force.
  block,       ///< Not part of the network: computes a signal from other signals.
  nothing,     ///< Carries no force: a law at a limit of its parameters.
};

/// All elements of one deflection law, in contiguous arrays. One call evaluates them all.
///
/// The memory of an element (side of a loop, point of the last reversal) is constant between events.
class DeflectionBatch {
 public:
  virtual ~DeflectionBatch() = default;
  virtual std::size_t size() const = 0;

  /// Forces f[i] and creep rates c[i] at deflections p[i].
  virtual void evaluate(const double* p, double* f, double* c) const = 0;
  /// The same, with the derivatives with respect to p.
  virtual void linearise(const double* p, double* f, double* df, double* c, double* dc) const = 0;

  /// For a law with contacts: the side of element i that is in contact, -1, 1, or 0 for none. Absent for other laws. A mass may
  /// touch a side and leave it within one step. Event 0 is that of side 1, event 1 that of side -1.
  virtual std::optional<int> contact(std::size_t) const { return {}; }

  /// False if c is identically 0 for element i. Its deflection is then the relative displacement of its ends plus a
  /// constant, and a function of time alone if both ends are prescribed.
  virtual bool creeps(std::size_t i) const = 0;

  /// Delay [s], 0 for most laws: element i responds to the past velocity of its ends, p'(t) = w(t - delay) - creep(f).
  virtual double delay(std::size_t i) const = 0;

  /// The deflection of element i at the start, when the relative displacement of its ends is d. For a spring it follows from
  /// d, for a law with a memory from its initial force.
  virtual double start(std::size_t i, double d) = 0;
  /// Whether it follows from d.
  virtual bool starts_by_place(std::size_t i) const = 0;
  /// The same where the balance with its neighbours requires an initial force; NaN if the law accepts none.
  virtual double start_with(std::size_t i, double force) = 0;

  /// Number of event functions of element i (0 for laws without memory).
  virtual int events(std::size_t i) const = 0;
  /// Event functions of element i at deflection p, its rate dp and velocity w; positive as long as the memory stays as it
  /// is. `dead_band` is the dead band of reversals [m/s].
  virtual void event_functions(std::size_t i, double p, double dp, double w, double dead_band, double* g) const = 0;
  /// Changes the memory of element i at its event `which`. The force does not change.
  virtual void switch_memory(std::size_t i, int which, double p, double w) = 0;
  /// The deflection jumps from p to p + jump at one event (a displacement step at an end), and the memory follows. Returns
  /// the energy dissipated [J].
  virtual double jump(std::size_t i, double p, double jump) = 0;
  /// Adapts the memory to a motion at velocity w that begins in `direction` (-1, 1, or 0 for rest). Returns true if the
  /// memory changed.
  virtual bool set_direction(std::size_t i, double p, double w, int direction) = 0;
  /// True if the memory fits a motion at velocity w (0: rest): set_direction would not change it.
  virtual bool fits(std::size_t i, double w) const = 0;
  /// Starts a Filippov sliding mode of element i, where motion in either direction would drive the velocity back to 0. Until
  /// an event or `set_direction`, its velocity is 0 instead of p' + creep, and its force follows from its neighbours. A
  /// slider in parallel may be at its bound, in the direction `lean` (0: none); it sticks again at the event at which the
  /// branch may rest. Returns false if the law has no sliding mode.
  virtual bool hold(std::size_t i, double p, int lean) = 0;
  virtual bool holds(std::size_t i) const = 0;
  /// The direction of motion in its memory: -1, 1, or 0 for rest and for laws that store none.
  virtual int direction(std::size_t i) const = 0;
  /// Element i may enter a sliding mode.
  virtual bool can_hold(std::size_t i) const = 0;
  /// In a sliding mode: the rates p' with which motion to either side would begin, or the rate at rest for a side that a
  /// slider blocks. The true rate lies between the two.
  virtual void hold_rates(std::size_t i, const Dual& p, Dual& forward, Dual& backward) const = 0;

  /// Slope df/dp at deflection p at the beginning of a motion in `direction`; 0 for rest.
  virtual double slope(std::size_t i, double p, int direction) const = 0;
  /// Slope with which the force leaves its bound when the deflection stops growing; 0 if it does not leave.
  virtual double release_slope(std::size_t i, double p) const = 0;
  /// Force after the deflection has gone from p to p + step along the law, and its slope there. The memory stays.
  virtual double force_along(std::size_t i, double p, double step, double& slope) const = 0;
  /// Force at the deflection p, with the memory as it is [N].
  virtual double force(std::size_t i, double p) const {
    double slope;
    return force_along(i, p, 0, slope);
  }
  /// Until the next event the force is linear in the deflection, and the creep in the force.
  virtual bool linear(std::size_t i) const = 0;
  /// The force does not depend on the deflection until the next event: friction at its bound.
  virtual bool constant(std::size_t i) const = 0;

  /// The force of element i in steady motion, at a constant velocity w and a constant force: rest sgn w + slope w, limited
  /// to +-bound; at w = 0 any force within +-rest. Without steady motion (a spring) `rest` is infinite.
  struct Steady { double rest, slope, bound; };
  virtual Steady steady(std::size_t i) const = 0;
  /// Gives element i such a force f, with the memory of a steady motion in `direction` (-1, 1, or 0 for rest). Its
  /// deflection was p; returns the new deflection.
  virtual double settle(std::size_t i, double p, double f, int direction) = 0;

  virtual double stored_energy(std::size_t i, double p) const = 0;
  /// Power dissipated at deflection p, its rate dp and velocity w. Never negative, except for a law with a delay, which may
  /// return more than it stored.
  virtual double dissipated_power(std::size_t i, double p, double dp, double w) const = 0;
  /// If true, `heat` is the energy dissipated since the last change of the memory [J], a function of the deflection. No
  /// quadrature of a discontinuous power is then needed.
  virtual bool knows_heat() const { return false; }
  virtual double heat(std::size_t, double) const { return 0; }
  /// If a new branch of the law begins at the present deflection p of element i (a reversal), counts the deflection from
  /// here on, so that p becomes 0. Returns the amount subtracted; 0 if p stays. Without this, friction that reverses after a
  /// long slip would carry the round-off of the whole path in its force.
  virtual double recentre(std::size_t, double) { return 0; }
};

/// f = coefficient abs(w)^exponent sgn(w) for large velocities w.
struct Growth { double coefficient, exponent; };

/// All elements of one rate law.
class RateBatch {
 public:
  virtual ~RateBatch() = default;
  virtual std::size_t size() const = 0;
  /// Element i is solved for its force (w = rate(f)) instead of f = force(w). Initially true if its slope df/dw is infinite
  /// at rest.
  virtual bool by_force(std::size_t i) const = 0;
  virtual void set_by_force(std::size_t i, bool by_force) = 0;
  /// Makes element i linear up to the velocity `w` if its slope would otherwise be infinite or 0 at rest: the integrator
  /// could not follow a mass that such an element brings to rest.
  virtual void regularise(std::size_t i, double w) = 0;
  /// The force falls with the velocity somewhere: no balance of forces then determines the velocity.
  virtual bool falls(std::size_t) const { return false; }
  /// f = B w at all velocities.
  virtual bool linear(std::size_t i) const = 0;
  /// Growth of the force of element i at large velocities.
  virtual Growth growth(std::size_t i) const = 0;
  /// Impulse per unit of a displacement step of an end [N s/m]: the damping of a linear dashpot; infinite for faster growth,
  /// 0 for slower.
  double impulse(std::size_t i) const {
    const Growth g = growth(i);
    return g.exponent == 1 ? g.coefficient : g.exponent < 1 ? 0 : std::numeric_limits<double>::infinity();
  }
  /// in[i] is w (by_force: f), out[i] is f (by_force: w).
  virtual void evaluate(const double* in, double* out) const = 0;
  virtual void linearise(const double* in, double* out, double* derivative) const = 0;
  /// Force of element i at velocity w, and its velocity at force f, for both settings of by_force.
  virtual double force_at(std::size_t i, double w) const = 0;
  virtual double velocity_at(std::size_t i, double f) const = 0;
};

/// Bounds of the force of a set-valued law in one direction of motion: magnitudes, infinite where it never moves that way [N].
struct Bounds {
  Dual sliding;    ///< While it slips.
  Dual breakaway;  ///< While it sticks; not less than `sliding`.
};

/// A law of the role `slip`, at one time. It sticks (w = 0) while -backward.breakaway <= f <= forward.breakaway. It slips with
/// f = forward.sliding for w > 0, and with f = -backward.sliding for w < 0.
struct Box {
  Bounds forward, backward;

  const Bounds& at(int side) const { return side < 0 ? backward : forward; }
  /// Friction: the same in both directions.
  static Box symmetric(const Bounds& bounds) { return {bounds, bounds}; }
  /// Larger of the two forces at which it breaks away [N]; infinite ones do not count.
  double largest() const {
    double result = 0;
    for (const Bounds* b : {&forward, &backward}) {
      if (std::isfinite(b->breakaway.value)) result = std::max(result, b->breakaway.value);
    }
    return result;
  }
  bool takes_force() const { return forward.breakaway.value > 0 || backward.breakaway.value > 0; }
  /// Needs more force to break away than to slide, in some direction.
  bool breaks_away() const { return forward.breakaway > forward.sliding || backward.breakaway > backward.sliding; }
  bool rigid() const { return std::isinf(forward.breakaway.value) && std::isinf(backward.breakaway.value); }
};

/// A law of the role `slip` that has a force only in contact, and none while it is apart. Its gauge measures the displacement.
struct Contact {
  double lowest, highest;  ///< Displacements at which it is in contact; infinite where there is no such side [m].
  Box lower, upper;        ///< Its box there; without force where there is no such side.
  double restitution;      ///< Velocity after an impact over that before it, turned round.

  const Box& at(int side) const { return side < 0 ? lower : upper; }
  double bound(int side) const { return side < 0 ? lowest : highest; }
};

/// Losses of a transmission whose second node gets the force m, as seen at its first node. The first node has the force
///     max((m + bearing_a)/efficiency_a, efficiency_b (m + bearing_b))   while it turns forwards,
///     min((m - bearing_a)/efficiency_a, efficiency_b (m - bearing_b))   while it turns backwards,
/// the first term if a drives, the second one if b does; at rest any force between the two.
struct Loss {
  double efficiency_a = 1, efficiency_b = 1;  ///< While a drives, while b drives; 0 or less: b cannot drive.
  double bearing_a = 0, bearing_b = 0;        ///< Friction of the bearings, seen at a [N].

  bool none() const { return efficiency_a == 1 && efficiency_b == 1 && bearing_a == 0 && bearing_b == 0; }

  /// Force at the first node: factor m + offset.
  struct Line {
    double factor, offset;
    double at(double m) const { return factor * m + offset; }
  };
  Line line(int side, bool b_drives) const {
    return b_drives ? Line{efficiency_b, side * efficiency_b * bearing_b} : Line{1 / efficiency_a, side * bearing_a / efficiency_a};
  }
  /// Rate of the line where the four numbers have the rates `by`.
  Line slope(int side, bool b_drives, const Loss& by) const {
    if (b_drives) return {by.efficiency_b, side * (by.efficiency_b * bearing_b + efficiency_b * by.bearing_b)};
    return {-by.efficiency_a / (efficiency_a * efficiency_a), side * (by.bearing_a - by.efficiency_a * bearing_a / efficiency_a) / efficiency_a};
  }
  /// By how much a drives, while it turns to this side [N]: the difference of both lines.
  double lead_of_a(int side, double m) const { return side * (line(side, false).at(m) - line(side, true).at(m)); }
  bool b_drives(int side, double m) const { return lead_of_a(side, m) < 0; }
  /// Force that is lost at the first node while it turns to this side [N], at least 0.
  double lost(int side, double m) const { return std::max(0.0, side * (line(side, b_drives(side, m)).at(m) - m)); }
};

/// A law of the role `block`. With u the sum of the inputs (or the generated signal), its output is
///
///     z, where z' = gain u - leak z and z = initial at first   if it has a state
///     u(t - delay), before that `initial`                      if it has a delay
///     u at the last multiple of `period`                       if it samples
///     gain u, but not beyond `lower` and `upper`               else
struct BlockLaw {
  double gain = 1;     ///< [unit of the output / unit of the inputs], for a state divided by s.
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  bool state = false;
  double leak = 0;     ///< [1/s]
  double delay = 0;    ///< [s]
  double period = 0;   ///< Between samples [s]; 0: it does not sample.
  double quantum = 0;  ///< Samples are rounded to multiples of this [unit of the output]; 0: they are not.
  double initial = 0;  ///< [unit of the output].

  bool limits() const { return upper < std::numeric_limits<double>::infinity() || lower > -std::numeric_limits<double>::infinity(); }
};

/// A deflection law f = stiffness (d - rest).
struct LinearSpring {
  double stiffness;     ///< N/m
  double rest;          ///< m
  double force;         ///< At the start [N], replaces `rest`; or not_given.
  double displacement;  ///< At the start [m]; or not_given.
};

/// A limit of the parameters at which a law becomes another one.
struct Limit {
  std::string when = {};     ///< "damping = inf", for the reference.
  std::string becomes = {};  ///< A component's type; "" for nothing (no force at all).
  std::function<bool(std::span<const double>)> applies = {};
  std::function<std::vector<double>(std::span<const double>)> values = {};  ///< Parameters of the new law.
};

/// How a type is drawn: paths in a box of 1 x 1, y downwards, in SVG's notation with absolute coordinates (M, L, H, V, C, Q,
/// A, Z). A symbol that joins two nodes has them at (0, 0.5) and (1, 0.5). The arrow of a motion or force leads from (0,
/// 0.5) to (1, 0.5). A block has its inputs at x = 0 and its output at (1, 0.5). All of these keep their proportions; the
/// box of a mass is stretched to fit its label and its whole load.
struct Symbol {
  std::string outline = {};  ///< Closed, filled with the background.
  std::string lines = {};
  std::string thin = {};     ///< Hatching and shading.
  std::string solid = {};    ///< filled

  bool empty() const { return outline.empty() && lines.empty() && thin.empty() && solid.empty(); }
};

/// The data of a law: the values of its declared parameters, and its characteristic if it has one.
struct LawValues : std::span<const double> {
  const Characteristic* characteristic;

  LawValues(std::span<const double> values, const Characteristic* of = nullptr) : std::span<const double>(values), characteristic(of) {}
};
using Values = std::vector<LawValues>;  ///< For each element of a batch.

/// An expression over the displacement `d` [m] and the velocity `w` [m/s] of an element, over `names`, and, beside a deflection law,
/// over its force `f` [N]; in SI. Empty where the characteristic of the parameter stands in its place.
struct MotionExpression {
  std::string expression;
  std::map<std::string, double> names;
  int parameter = -1;  ///< Whose value it is; -1: it is a force.
};

/// A law where signals give some of its parameters, in SI: expressions over d and w, as in MotionExpression, and over the names of its
/// parameters.
struct VaryingLaw {
  struct State {
    std::string name, rate;
    double start = 0;
  };
  std::string force;        ///< Force that it resists with.
  std::string stored = {};  ///< Energy that it stores: what changes a parameter supplies energy too; "": none.
  bool lossless = false;    ///< All power beyond the stored energy comes from what changes the parameters.
  std::vector<State> states = {};
};

/// Everything that the simulator knows about an element type. Each file in components/ defines and registers one.
struct Component {
  Declaration declaration = {};
  Role role = Role::deflection;
  bool hidden = false;                   ///< No netlist names it: it is that of a characteristic, of a limit, or of a transmission with a row.
  std::vector<Limit> limits = {};  ///< Tried in order; the first one that applies replaces the element.
  std::string with_characteristic = {};  ///< The component that an element with a characteristic has instead.
  std::string with_row = {};             ///< The component that a transmission has instead if it is an equation of its own.
  std::function<std::unique_ptr<DeflectionBatch>(const Values&)> deflection = {};  ///< For Role::deflection; and the gauge of a contact.
  std::function<std::unique_ptr<RateBatch>(const Values&)> rate = {};              ///< For Role::rate.
  /// If signals may give parameters of a deflection or rate law: the law of an element with these values, NaN where a signal gives one.
  std::function<VaryingLaw(std::span<const double>)> varying = {};
  /// For Role::slip: the box that belongs to the values of the parameters. These may vary in time (Parameter::may_vary).
  std::function<Box(std::span<const Dual>)> box = {};
  /// For Role::slip: of a law that has a force only in contact. Its gauge is a deflection law without force, whose contact
  /// (DeflectionBatch::contact) selects the box. `box` is that of the law while it is apart.
  std::function<Contact(std::span<const double>)> contact = {};
  /// For a transmission (Role::slip, rigid): velocity of its first node over that of its second, relative to its support. See
  /// transmission.hpp.
  std::function<double(std::span<const double>)> ratio = {};
  /// The losses of a transmission. It gets the value at the present speed where a characteristic stands in place of a value.
  std::function<Loss(std::span<const double>)> loss = {};
  /// For Role::slip: a parameter that depends on the velocity; absent if none does.
  std::function<std::optional<MotionExpression>(const LawValues&)> over_velocity = {};
  /// For Role::deflection: a force beside that of the law, which dissipates; absent if there is none.
  std::function<std::optional<MotionExpression>(std::span<const double>)> beside = {};
  std::function<BlockLaw(std::span<const double>)> block = {};       ///< For Role::block.
  std::function<LinearSpring(std::span<const double>)> spring = {};  ///< For a deflection law that is a linear spring.
  Symbol drawing = {};             ///< If empty, a plain box.
  Symbol rotational_drawing = {};  ///< In a rotational scene, if it differs.
  std::function<std::string(const Signal&)> signal_drawing = {};  ///< Extra lines that show the shape of its signal.

  const Symbol& drawn_in(Domain domain) const {
    return domain == Domain::rotation && !rotational_drawing.empty() ? rotational_drawing : drawing;
  }
};

/// Component::over_velocity for these values; absent if the component has none.
std::optional<MotionExpression> over_velocity(const Component& component, const LawValues& values);

/// The box of a component whose parameters are constant; those that are left out at the end are not given.
Box constant_box(const Component& component, std::span<const double> values);

/// The components that a netlist can name, in alphabetical order of their types.
const std::vector<const Component*>& components();
/// Their declarations, in the same order (an element's `declaration` is an index into both).
Declarations declarations();
/// Any component; nullptr if there is none.
const Component* find_component(const std::string& type);

/// Registers a component. Define one at namespace scope in each file of components/.
struct RegisterComponent {
  explicit RegisterComponent(Component component);
};

}  // namespace rheonet
