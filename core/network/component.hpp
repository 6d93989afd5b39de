#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/signal.hpp"
#include "core/network/dual.hpp"

namespace rheonet {

/// What a branch is to the structure of a network; the analysis of a network asks for nothing else.
enum class Role {
  deflection,  ///< force from an own deflection p: f = force(p), p' = w - creep(f). Springs and all laws with a memory
  rate,        ///< force from the relative velocity: f = force(w), or w = rate(f). Dashpots
  slip,        ///< sticks under any force up to a bound, else slips at a constant one. Ideal sliders
  mass,        ///< inertia of a node
  motion,      ///< prescribes a node's motion
  force,       ///< applies a given force
  block,       ///< no part of the network: makes a signal of others
  nothing,     ///< carries no force: what a law becomes at a limit of its parameters
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
  /// The same with the derivatives with respect to p.
  virtual void linearise(const double* p, double* f, double* df, double* c, double* dc) const = 0;

  /// True if c is identically 0 for element i: its deflection is then the relative displacement of its ends but for a
  /// constant, and a function of time alone where both ends are prescribed.
  virtual bool creeps(std::size_t i) const = 0;

  /// Element i feels the velocity of its ends this much later: p'(t) = w(t - delay) - creep(f). 0 for most laws [s].
  virtual double delay(std::size_t i) const = 0;

  /// The deflection of element i at the start, when the relative displacement of its ends is d: a spring's follows from
  /// d, that of a law with a memory from its initial force.
  virtual double start(std::size_t i, double d) = 0;
  /// The same where its neighbours demand an initial force of it; NaN if the law knows none.
  virtual double start_with(std::size_t i, double force) = 0;

  /// How many event functions element i has (0 for laws without memory).
  virtual int events(std::size_t i) const = 0;
  /// Event functions of element i at deflection p, its rate dp and velocity w, positive as long as the memory stays as it
  /// is. `noise` is the velocity below which a reversal means nothing.
  virtual void event_functions(std::size_t i, double p, double dp, double w, double noise, double* g) const = 0;
  /// Changes the memory of element i as its event `which` demands. The force is the same before and after.
  virtual void switch_memory(std::size_t i, int which, double p, double w) = 0;
  /// The deflection jumps from p to p + jump at one instant (an end is moved by a step): the memory follows. Returns the
  /// energy that this turns into heat.
  virtual double jump(std::size_t i, double p, double jump) = 0;
  /// Makes the memory fit a motion at velocity w that begins in `direction` (-1, 1, or 0 for rest); true if that changed
  /// it.
  virtual bool set_direction(std::size_t i, double p, double w, int direction) = 0;
  /// True if the memory fits a motion at velocity w (0: rest): set_direction would not change it.
  virtual bool fits(std::size_t i, double w) const = 0;
  /// Both directions drive the velocity back to 0: the branch stands still while its force follows from its neighbours
  /// (a sliding mode in the sense of Filippov). Its velocity is then 0 in place of p' + creep, until an event or
  /// `set_direction`. False if the law does not know this. A slider beside it that is at its bound, in the direction
  /// `lean` (0: there is none), sticks again as soon as the branch would as well rest: an event.
  virtual bool hold(std::size_t i, double p, int lean) = 0;
  virtual bool holds(std::size_t i) const = 0;
  /// The direction that its memory stands for: -1, 1, or 0 for rest and laws that know none.
  virtual int direction(std::size_t i) const = 0;
  /// Element i can be held still at all.
  virtual bool can_hold(std::size_t i) const = 0;
  /// While it is held: the rates p' that motion to either side would begin with, or rest where a slider leaves it one side
  /// only; the true one lies between them.
  virtual void hold_rates(std::size_t i, const Dual& p, Dual& forward, Dual& backward) const = 0;

  /// Slope df/dp with which a motion in `direction` begins at deflection p; 0 for rest.
  virtual double slope(std::size_t i, double p, int direction) const = 0;
  /// At its bound, where a deflection that grows no more lets the force leave it: the slope with which it does; else 0.
  virtual double release_slope(std::size_t i, double p) const = 0;
  /// Force after the deflection has gone from p to p + step along the law, and its slope there. The memory stays.
  virtual double force_along(std::size_t i, double p, double step, double& slope) const = 0;
  /// The force does not depend on the deflection until an event: friction that has come to its bound.
  virtual bool constant(std::size_t i) const = 0;

  /// The force under which element i moves steadily, that is at a constant velocity w with a force that no longer changes:
  /// rest sgn w + slope w, but not beyond +-bound; at w = 0 anything within +-rest. Without steady motion (a spring) `rest`
  /// is infinite.
  struct Steady { double rest, slope, bound; };
  virtual Steady steady(std::size_t i) const = 0;
  /// Gives element i such a force and the memory that goes with it, in `direction` (-1, 1, or 0 for rest). Its deflection
  /// was p; returns that from then on.
  virtual double settle(std::size_t i, double p, double f, int direction) = 0;

  virtual double stored_energy(std::size_t i, double p) const = 0;
  /// Power turned into heat at deflection p, its rate dp and velocity w; never negative but for a law with a delay, which
  /// may give back what it has not stored.
  virtual double dissipated_power(std::size_t i, double p, double dp, double w) const = 0;
  /// Where the law knows it as a function of its deflection: what has turned into heat since the memory changed last [J].
  /// No quadrature of a power that jumps is then needed.
  virtual bool knows_heat() const { return false; }
  virtual double heat(std::size_t, double) const { return 0; }
  /// Counts the deflection of element i, p at present, from here on if its law begins a new branch here (a reversal): it becomes 0.
  /// Returns by how much it has become less; 0 if it stays. Friction that has slid far and turns would have the rounding of
  /// the whole way in its force.
  virtual double recentre(std::size_t, double) { return 0; }
};

/// f = coefficient abs(w)^exponent sgn(w) for large velocities w.
struct Growth { double coefficient, exponent; };

/// All elements of one rate law.
class RateBatch {
 public:
  virtual ~RateBatch() = default;
  virtual std::size_t size() const = 0;
  /// Element i is solved for its force (w = rate(f)) instead of f = force(w). At first: if its slope df/dw is infinite at
  /// rest.
  virtual bool by_force(std::size_t i) const = 0;
  virtual void set_by_force(std::size_t i, bool by_force) = 0;
  /// Up to the velocity `w` element i is taken as linear where its slope would be infinite or 0 at rest. A mass that it brings
  /// to rest could not be followed otherwise.
  virtual void soften(std::size_t i, double w) = 0;
  /// How the force of element i grows with a velocity beyond all bounds.
  virtual Growth growth(std::size_t i) const = 0;
  /// Impulse that a displacement step of 1 at infinite rate needs: the damping of a linear dashpot, infinite or 0 for
  /// others.
  double impulse(std::size_t i) const {
    const Growth g = growth(i);
    return g.exponent == 1 ? g.coefficient : g.exponent < 1 ? 0 : std::numeric_limits<double>::infinity();
  }
  /// in[i] is w (by_force: f), out[i] is f (by_force: w).
  virtual void evaluate(const double* in, double* out) const = 0;
  virtual void linearise(const double* in, double* out, double* derivative) const = 0;
  /// Force of element i at velocity w, and its velocity at force f, whichever way it is solved.
  virtual double force_at(std::size_t i, double w) const = 0;
  virtual double velocity_at(std::size_t i, double f) const = 0;
};

/// A law of the role `slip`: w = 0 with abs(f) <= breakaway, or f = coulomb sgn w.
struct Slip {
  double coulomb;    ///< N
  double breakaway;  ///< N, not less than coulomb
};

/// A law of the role `block`. With u the sum of the inputs (or the signal that it generates), it puts out
///
///     z, where z' = gain u - leak z and z = initial at first   if it has a state
///     u(t - delay), before that `initial`                      if it has a delay
///     gain u, but not beyond `lower` and `upper`               else
struct BlockLaw {
  double gain = 1;     ///< [unit of the output / unit of the inputs], of a state that per second
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  bool state = false;
  double leak = 0;     ///< [1/s]
  double delay = 0;    ///< [s]
  double initial = 0;  ///< [unit of the output]

  bool limits() const { return upper < std::numeric_limits<double>::infinity() || lower > -std::numeric_limits<double>::infinity(); }
};

/// A deflection law f = stiffness (d - rest).
struct LinearSpring {
  double stiffness;     ///< N/m
  double rest;          ///< m
  double force;         ///< at the start [N]; takes the place of `rest`; not_given
  double displacement;  ///< at the start [m]; not_given
};

/// A law at a limit of its parameters is another law.
struct Limit {
  std::string when = {};     ///< "damping = inf", for the reference
  std::string becomes = {};  ///< a component's type; "" for nothing (no force at all)
  std::function<bool(std::span<const double>)> applies = {};
  std::function<std::vector<double>(std::span<const double>)> values = {};  ///< parameters of the law that it becomes
};

/// How a type is drawn: paths in a box of 1 x 1, y downwards, in SVG's notation with absolute coordinates (M, L, H, V, C, Q,
/// A, Z). What joins two nodes has them at (0, 0.5) and (1, 0.5), and keeps its proportions; so do the arrow of a motion
/// or force, which leads from (0, 0.5) to (1, 0.5), and a block, which takes its inputs at x = 0 and puts out at (1, 0.5).
/// The box of a mass is stretched to what is written in it, and over all that it carries.
struct Symbol {
  std::string outline = {};  ///< closed: hides what is behind it
  std::string lines = {};
  std::string thin = {};     ///< hatching and shading
  std::string solid = {};    ///< filled

  bool empty() const { return outline.empty() && lines.empty() && thin.empty() && solid.empty(); }
};

using Values = std::vector<std::span<const double>>;  ///< for each element of a batch its declared parameters

/// Everything that the simulator knows of an element type. One file in components/ makes one, and registers it.
struct Component {
  Declaration declaration = {};
  Role role = Role::deflection;
  std::vector<Limit> limits = {};  ///< tried in order; the first that applies replaces the element
  std::function<std::unique_ptr<DeflectionBatch>(const Values&)> deflection = {};  ///< for Role::deflection
  std::function<std::unique_ptr<RateBatch>(const Values&)> rate = {};              ///< for Role::rate
  std::function<Slip(std::span<const double>)> slip = {};                                          ///< for Role::slip
  std::function<BlockLaw(std::span<const double>)> block = {};       ///< for Role::block
  std::function<LinearSpring(std::span<const double>)> spring = {};  ///< for a deflection law that is one
  Symbol drawing = {};             ///< a plain box if it is empty
  Symbol rotational_drawing = {};  ///< in a rotational scene, if that is another one
  std::function<std::string(const Signal&)> signal_drawing = {};  ///< lines besides these, of the shape of its signal

  const Symbol& drawn_in(Domain domain) const {
    return domain == Domain::rotation && !rotational_drawing.empty() ? rotational_drawing : drawing;
  }
};

/// The components in alphabetical order of their types.
const std::vector<const Component*>& components();
/// Their declarations, in the same order (an element's `declaration` is an index into both).
Declarations declarations();
/// nullptr if there is none.
const Component* find_component(const std::string& type);

/// Put one at namespace scope in each file of components/.
struct RegisterComponent {
  explicit RegisterComponent(Component component);
};

}  // namespace rheonet
