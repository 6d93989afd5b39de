#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/dimension.hpp"
#include "core/netlist/effect.hpp"
#include "core/netlist/shared.hpp"
#include "core/netlist/signal.hpp"

namespace rheonet {

/// Index into Scene::nodes. Ground is always node 0.
using NodeId = int;
inline constexpr NodeId ground = 0;

/// Marks an initial value or parameter that the user did not give.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// What is not given is the same as what is not given.
bool same_values(std::span<const double> one, std::span<const double> other);

/// Times this close together, as a fraction of an output interval, are one: that far rounding may put a row beyond the
/// stop, or an event beside a row.
inline constexpr double time_rounding = 1e-9;

struct SceneNode {
  std::string name;             ///< its path: `drum`, `pivot.mid`, `bingham.node1`
  double position = not_given;  ///< m | rad
  double velocity = not_given;  ///< m/s | rad/s
  Spot spot;                    ///< where it is first named; of its `[nodes]` entry if it has one
};

struct SceneElement {
  std::string name;    ///< its path: `k1`, `pivot.k1`, `chain.17`
  int declaration = 0; ///< index into the declarations that the scene was read with
  NodeId a = ground;
  NodeId b = ground;   ///< ground for an element `at` one node
  bool at = false;     ///< written with `at`
  Shared<double> values;        ///< SI, one for each declared parameter; not_given for signals and absent initial values
  std::bitset<32> given;        ///< of each declared parameter: the netlist gives it this value, not its default
  Shared<Signal> signals;       ///< the signals, in order of declaration, of the parameters in signal_parameters
  Shared<int> signal_parameters;  ///< indices into Declaration::parameters
  Spot spot;           ///< of its name
};

/// A composed element (series, parallel, repeat, an instance of a model with two ports). Its force is the signed sum of
/// the forces of the elements that touch its first node from inside.
struct SceneAssembly {
  struct Term { int element; int sign; };
  std::string name;
  NodeId a = ground;
  NodeId b = ground;
  std::vector<Term> force;
  Spot spot;
};

/// What a block puts out is in this unit; `open` if nothing says in which one: it is taken in SI whatever it is for.
struct BlockUnit {
  Dimension dimension;
  double radian = 0;  ///< the exponent of rad that came with it, for messages
  bool open = true;
};

/// An element that makes a signal of others: its name, declaration and values are those of the element.
struct SceneBlock {
  struct Input {
    bool from_block;  ///< the output of another block; else a quantity of the network
    int index;        ///< into Scene::blocks or Scene::sensed
    double sign;
  };
  int element = 0;
  std::vector<Input> inputs;
  BlockUnit unit;
};

/// The signal of an element is the output of a block, times `sign`.
struct SceneFeed { int element, block; double sign; };

struct Record {
  enum class Subject { node, element, assembly, block };
  enum class Channel { position, velocity, displacement, force, out };
  std::string path;  ///< as in the header row: `k1.force`
  Subject subject = Subject::node;
  int index = 0;     ///< into nodes, elements, assemblies or blocks
  Channel channel = Channel::position;
};


/// A claim of `[expect]`: a figure of a record's course through the run, and between which values it should lie. A
/// measure is one that claims nothing: only what the figure is is asked for.
struct Claim {
  enum class Figure { at, final, max, min, mean, rms, crossing, time_of_max, time_of_min };
  Figure figure = Figure::final;
  int record = 0;              ///< into Scene::claimed
  int per = -1;                ///< into Scene::claimed: the figure is divided by the same figure of this record
  double time = not_given;     ///< s: when, of Figure::at
  double level = not_given;    ///< that is crossed, in the record's unit
  double from = 0, to = 0;     ///< s: the part of the run that is looked at
  double least = 0, most = 0;  ///< claimed, SI; of a crossing its time [s]
  double within = not_given;   ///< tolerance on both sides; if not given, the accuracy of the run, as a fraction
  bool fraction = false;       ///< `within` is a fraction: of the largest magnitude that the record has in the run; of
                               ///< the run's length for a crossing; of the claimed ratio
  Spot spot;                   ///< of the claimed value
};

/// Whether a figure is the time of something.
bool is_time(Claim::Figure figure);

/// What a record is by a closed form, of `[exact]`.
struct ExactRecord {
  int record = 0;                               ///< into Scene::records
  std::function<double(double t)> value = {};  ///< SI, at a time of the scene; NaN where the form has no finite value
  Spot spot;
};

/// A netlist, checked and flattened: every value in SI, every reference resolved; models, series, parallel, repeat gone.
struct Scene {
  std::string title;
  Domain domain = Domain::translation;
  std::vector<SceneNode> nodes;          ///< [0] is ground
  std::vector<SceneElement> elements;    ///< in the order of the file
  std::vector<SceneAssembly> assemblies;
  std::vector<SceneBlock> blocks;        ///< in the order of the file
  std::vector<Record> sensed;            ///< what blocks take in of the network
  std::vector<SceneFeed> feeds;
  std::vector<Record> records;           ///< in the order asked for; everything, in the order of the file, if not asked

  std::vector<Record> claimed;  ///< what claims are about, each once
  std::vector<Claim> claims;    ///< of `[expect]`, in the order of the file

  std::vector<ExactRecord> exact;

  std::vector<EffectLeftOut> without;  ///< effects that are left out
  std::vector<std::string> keep;       ///< names of reductions that are not made: core/network/reductions.hpp

  enum class StartFrom {
    given,   ///< the start values of nodes and elements
    rest,    ///< at rest, all forces balanced
    steady,  ///< in steady motion under the drives as they are at the start
  };
  StartFrom start_from = StartFrom::given;
  double start = 0;         ///< s
  double stop = 0;          ///< s, > start
  double accuracy = 1e-6;   ///< relative, 1e-12 .. 0.1
  double output_every = 0;  ///< s: rows at start + k output_every, k = 0 .. output_intervals
  std::int64_t output_intervals = 0;
  bool output_events = false;  ///< also a pair of rows at every event
};

/// What a record measures, and the SI unit of it as a user would type it ("1" for a number). A block may put out a quantity
/// that has no name here, or one that nothing is known of.
BlockUnit unit_of(const Scene& scene, const Record& record);
std::optional<Quantity> quantity_of(const Scene& scene, const Record& record);
std::string unit_text(const Scene& scene, const Record& record);

}  // namespace rheonet
