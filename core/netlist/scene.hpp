#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/dimension.hpp"
#include "core/netlist/effect.hpp"
#include "core/netlist/shared.hpp"
#include "core/netlist/signal.hpp"

namespace rheonet {

class Characteristic;

/// Functions that an element has in place of values, by the number of their parameter.
using Characteristics = std::map<std::size_t, std::shared_ptr<const Characteristic>>;

/// Index into Scene::nodes. Ground is always node 0.
using NodeId = int;
inline constexpr NodeId ground = 0;

/// Marks an initial value or parameter that the user did not give.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Whether two lists of values are equal; two values not_given count as equal.
bool same_values(std::span<const double> one, std::span<const double> other);

/// Times closer than this fraction of an output interval count as equal: round-off may put a row beyond the stop, or an
/// event next to a row.
inline constexpr double time_rounding = 1e-9;

struct SceneNode {
  std::string name;             ///< Its path: `drum`, `pivot.mid`, `bingham.node1`.
  double position = not_given;  ///< m | rad.
  double velocity = not_given;  ///< m/s | rad/s.
  Spot spot;                    ///< Where it is first named, or its `[nodes]` entry if it has one.
  std::optional<Domain> domain = {};  ///< If not that of the scene: see domain_of.
  double scale = 1;             ///< Its velocity is multiplied by this: core/network/transmission.hpp.
};

struct SceneElement {
  /// An element that a law of the netlist brings along: one of its states, or a part that is neither recorded nor drawn.
  enum class Part : char { none, state, inner };

  std::string name;    ///< Its path: `k1`, `pivot.k1`, `chain.17`.
  int declaration = 0; ///< Index into the declarations that the scene was read with.
  NodeId a = ground;
  NodeId b = ground;   ///< Ground for an element `at` one node.
  NodeId support = ground;  ///< For a transmission: the node against which it turns.
  Spot spot;           ///< Of its name.
  bool at = false;     ///< Written with `at`.
  Part part = Part::none;
  std::optional<Domain> domain = {};  ///< The domain of its first node, if the scene has another: see domain_of.
  Shared<double> values;        ///< SI, one for each declared parameter; not_given for signals and absent optional values.
  std::bitset<32> given;        ///< For each declared parameter: the value is given by the netlist, not a default.
  Shared<Signal> signals;       ///< Signals of the parameters in signal_parameters, in order of declaration.
  Shared<int> signal_parameters;  ///< Indices into Declaration::parameters.
  std::shared_ptr<const Characteristics> characteristics;  ///< nullptr if it has none.
  double scale = 1;    ///< Its velocity is multiplied by this: core/network/transmission.hpp.
  /// For a transmission that is an equation of its own: these factors times the velocities of a, b and support sum to 0. All are 0
  /// for any other element: core/network/transmission.hpp
  std::array<double, 3> row{};

  bool has_row() const { return row[0] != 0; }
  /// The function that a parameter has in place of a value; nullptr if it has none.
  std::shared_ptr<const Characteristic> characteristic(std::size_t parameter) const {
    const auto found = characteristics ? characteristics->find(parameter) : Characteristics::const_iterator();
    return characteristics && found != characteristics->end() ? found->second : nullptr;
  }
};

/// Calls visit(node) for each node of an element.
template <class Visit>
void for_each_node(const SceneElement& element, Visit visit) {
  visit(element.a);
  if (!element.at) visit(element.b);
  if (element.support != ground) visit(element.support);
}

/// A composed element (series, parallel, repeat, an instance of a model with two ports). Its force is the signed sum of the
/// forces of its elements that end at its first node.
struct SceneAssembly {
  /// With `at_support`, the force of a transmission at its support.
  struct Term { int element; double sign; bool at_support = false; };
  std::string name;
  NodeId a = ground;
  NodeId b = ground;
  std::vector<Term> force;
  Spot spot;
};

/// Unit of a block's output. If nothing determines the unit it is `open`: the output is then taken as SI for any quantity.
struct BlockUnit {
  Dimension dimension;
  double radian = 0;  ///< Exponent of rad, for messages.
  bool open = true;
};

class SwitchedFunction;

/// An element that computes a signal from others; name, declaration and values are stored in the element.
struct SceneBlock {
  struct Input {
    bool from_block;  ///< The output of another block; else a quantity of the network.
    int index;        ///< Into Scene::blocks or Scene::sensed.
    double sign;
  };
  int element = 0;
  std::vector<Input> inputs;
  BlockUnit unit;
  std::shared_ptr<const SwitchedFunction> function = {};  ///< A function of the inputs, and of the time in the scene as last; nullptr: none.
  std::vector<std::vector<double>> coefficients = {};     ///< Coefficients of its parameters of that kind: highest power first, SI.
  bool of_stop_when = false;  ///< Stands in no file: made for `simulate.stop_when`.
};

/// The signal of `element` for one of its parameters is the output of `block`, times `sign`.
struct SceneFeed { int element, parameter, block; double sign; };

struct Record {
  enum class Subject { node, element, assembly, block, expression };
  enum class Channel {
    position, velocity, displacement, force,
    acceleration,  ///< For a node.
    power,         ///< For an element: its force times its velocity [W].
    dissipated,    ///< For an element: the part of its power that becomes heat [W].
    energy,        ///< For an element: stored in it [J].
    out,           ///< For a block.
    value,         ///< For an expression.
  };
  std::string path;  ///< As in the header row: `k1.force`.
  Subject subject = Subject::node;
  int index = 0;     ///< Into nodes, elements, assemblies, blocks or expressions.
  Channel channel = Channel::position;
  double factor = 1;  ///< Factor of the quantity of the network: in common units (core/network/transmission.hpp) not always 1.
};

/// A record that is computed from others: an entry `{ name, value }` of `simulate.record`, or the sum of a quantity over the
/// elements of an assembly.
struct SceneExpression {
  std::string name;              ///< Path of its record.
  std::vector<Record> operands;  ///< There is no expression among them.
  std::function<double(std::span<const double>)> value = {};  ///< From the values of the operands [SI]; NaN if it has none.
  BlockUnit unit;
};

/// A claim of `[expect]`: bounds on a figure of a record's course through the run. A measure is a claim without bounds:
/// only the figure itself is reported.
struct Claim {
  enum class Figure { at, final, max, min, mean, rms, crossing, time_of_max, time_of_min };
  Figure figure = Figure::final;
  int record = 0;              ///< Into Scene::claimed.
  int per = -1;                ///< Into Scene::claimed: the figure is divided by the same figure of this record.
  double time = not_given;     ///< Time of Figure::at [s].
  double level = not_given;    ///< Level of Figure::crossing, in the record's unit.
  double from = 0, to = 0;     ///< Part of the run that is evaluated [s].
  double least = 0, most = 0;  ///< Bounds, SI; for a crossing, of its time [s].
  double within = not_given;   ///< Tolerance on both sides; if not given, the accuracy of the run, as a fraction.
  bool fraction = false;       ///< `within` is relative: to the record's largest magnitude in the run, to the run's length
                               ///< (crossing), or to the claimed ratio.
  Spot spot;                   ///< Place of the claimed value.
};

/// Whether the figure is a time.
bool is_time(Claim::Figure figure);

/// Closed form of a record, from `[exact]`.
struct ExactRecord {
  int record = 0;                               ///< Into Scene::records.
  std::function<double(double t)> value = {};  ///< SI, at a time of the scene; NaN if the form has no finite value.
  Spot spot;
};

/// A netlist, checked and flattened: values are in SI, references resolved; models, series, parallel and repeat expanded.
struct Scene {
  std::string title;
  Domain domain = Domain::translation;   ///< Domain of nodes and elements that name no other.
  std::vector<SceneNode> nodes;          ///< [0] is ground.
  std::vector<SceneElement> elements;    ///< In the order of the file.
  std::vector<SceneAssembly> assemblies;
  std::vector<SceneBlock> blocks;        ///< In the order of the file.
  std::vector<Record> sensed;            ///< Quantities of the network that blocks use as inputs.
  std::vector<SceneFeed> feeds;
  std::vector<SceneExpression> expressions;
  std::vector<Record> records;           ///< In the order asked for; if not asked for: all, in the order of the file.

  std::vector<Record> claimed;  ///< Records that claims refer to, each once.
  std::vector<Claim> claims;    ///< Claims of `[expect]`, in the order of the file.

  std::vector<ExactRecord> exact;

  std::vector<EffectLeftOut> without;  ///< Effects that are left out.
  std::vector<std::string> keep;       ///< Names of reductions that are not applied: core/network/reductions.hpp.

  /// How the time between two events is crossed.
  enum class Method {
    automatic,  ///< By exact arcs where laws and inputs are linear between events, else by IDA.
    ida,
    exact,
  };
  Method method = Method::automatic;
  Spot method_spot;
  enum class StartFrom {
    given,   ///< The start values of nodes and elements.
    rest,    ///< At rest, all forces balanced.
    steady,  ///< In steady motion under the inputs at the start.
  };
  StartFrom start_from = StartFrom::given;
  bool common_units = false;  ///< Made by in_common_units: core/network/transmission.hpp.
  double start = 0;         ///< s
  double stop = 0;          ///< s, > start.
  int stop_when = -1;       ///< Block whose output ends the run as soon as it is not 0; -1: none.
  double accuracy = 1e-6;   ///< Relative, 1e-12 .. 0.1.
  double output_every = 0;  ///< s: rows at start + k output_every, k = 0 .. output_intervals.
  std::int64_t output_intervals = 0;
  bool output_events = false;  ///< Also a pair of rows at every event.
};

/// Calls visit(record) for the record itself, or for each operand of an expression.
template <class Visit>
void for_each_operand(const Scene& scene, const Record& record, Visit visit) {
  if (record.subject != Record::Subject::expression) {
    visit(record);
    return;
  }
  for (const Record& operand : scene.expressions[static_cast<std::size_t>(record.index)].operands) visit(operand);
}

/// A block in messages: "block `lag`"; for a part of an element by a law that element, "`rubbing`".
std::string block_in_words(const SceneElement& block);

/// The domain of a node, of an element (by its first node), and of the node or element that a record belongs to.
Domain domain_of(const Scene& scene, const SceneNode& node);
Domain domain_of(const Scene& scene, const SceneElement& element);
Domain domain_of(const Scene& scene, const Record& record);
/// Whether some node belongs to another domain than the others.
bool in_both_domains(const Scene& scene);
/// Whether an element or assembly between these nodes joins the two domains: it has no displacement and no velocity.
bool joins_domains(const Scene& scene, NodeId a, NodeId b);

/// Quantity of a parameter of an element: a number where it is a coefficient of another one that is given.
Quantity quantity_of(const Declaration& declaration, const SceneElement& element, std::size_t parameter);

/// The unit and quantity of a record, and its SI unit as a user would type it ("1" for a number). The output of a block may
/// be a quantity without a name here, or one of unknown unit.
BlockUnit unit_of(const Scene& scene, const Record& record);
std::optional<Quantity> quantity_of(const Scene& scene, const Record& record);
std::string unit_text(const Scene& scene, const Record& record);

}  // namespace rheonet
