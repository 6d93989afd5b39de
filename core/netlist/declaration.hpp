#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/dimension.hpp"
#include "core/netlist/effect.hpp"

namespace rheonet {

/// What an element's parameter is, as data: parsing, checking, error texts, the printed reference and the JSON Schema
/// are all made from this.
struct Parameter {
  enum class Kind {
    value,    ///< a number with a dimension
    signal,   ///< a function of time
    initial,  ///< an initial value (`f0`, `d0`): optional, absent means "not given"
  };

  /// What its unit is: of a block's parameters it may go with what the block is connected to.
  enum class Unit {
    quantity,  ///< that of `quantity`
    own,       ///< any; a factor of the unit of the block's output
    input,     ///< that of the block's inputs
    output,    ///< that of the block's output
  };

  std::string name = {};
  Quantity quantity = Quantity::number;
  Unit unit = Unit::quantity;
  Kind kind = Kind::value;
  std::optional<double> fallback = {};  ///< absent: the user must give it (an `initial` is always optional)
  double lower = 0;                ///< inclusive, unless lower_open
  bool lower_open = true;
  double upper = std::numeric_limits<double>::infinity();  ///< inclusive if finite; values are finite in any case ...
  bool may_be_infinite = false;                            ///< ... unless the law has a limit there: "inf" is accepted
  std::string flow_index = {};        ///< for damping: the parameter whose value is the n in N*(s/m)^n; "" means n = 1
  std::string same_as = {};           ///< if not given: the value of this other parameter (`breakaway` = `coulomb`)
  bool opposite = false;              ///< if not given: that value with the other sign (`lower` = -`upper`)
  bool from_block = false;            ///< of a signal: the output of a block may be given in its place
  std::string rotational_name = {};   ///< its name in a rotational scene, if another (`inertia` for `mass`)
  std::string symbol = {};            ///< as in the law
  std::string description = {};

  const std::string& name_in(Domain domain) const {
    return domain == Domain::rotation && !rotational_name.empty() ? rotational_name : name;
  }
  /// It makes a node move: a signal that says the node's position, or its velocity.
  bool prescribes(Quantity motion) const { return kind == Kind::signal && quantity == motion; }
  bool prescribes_motion() const { return prescribes(Quantity::position) || prescribes(Quantity::velocity); }
};

/// What is wrong with values that are each within their bounds.
struct Misfit {
  std::string parameter;  ///< the one to blame
  std::string what;       ///< after its name: "is less than ..."
};

/// An effect that an element brings while `parameter` is finite and above 0, and the value of that in its absence; without
/// one the element cannot do without it while it has all its others.
struct Brought {
  Effect effect;
  std::string parameter;
  std::optional<double> absent = {};
};

/// Values of further parameters where all of these effects are left out, or those of them that the element brings.
struct Absence {
  std::vector<Effect> effects;
  std::vector<std::pair<std::string, double>> values;
};

/// What an element type is, as data. Values given by a netlist are stored in the order of `parameters`.
struct Declaration {
  enum class Ports {
    between,
    at,
    at_or_between,
    block,  ///< no node: a block, which makes a signal of its inputs
  };
  /// What a block takes in, all in one unit; the unit of its output is that, times those of its own parameters, times s if
  /// it integrates.
  struct Inputs {
    std::size_t least = 1, most = 1;
    bool integrates = false;
  };

  std::string type = {};
  std::string rotational_type = {};  ///< an alias in rotational scenes (`inertia`, `torque`); "" if none
  Ports ports = Ports::between;
  Inputs inputs = {};  ///< of a block
  std::vector<Parameter> parameters = {};
  std::vector<std::string> one_of = {};  ///< exactly one of these parameters must be given (`position` or `velocity`)
  std::function<std::optional<Misfit>(std::span<const double>)> check = {};  ///< of the values of an element
  std::vector<Brought> effects = {};   ///< those that can be left out of a scene
  std::vector<Absence> absences = {};  ///< tried in order, after the values of each effect by itself
  std::string summary = {};  ///< one line
  std::string law = {};      ///< as a textbook prints it
  std::string equation = {};  ///< the law as TeX sets it
  std::string source = {};   ///< citation
  std::string notes = {};    ///< sign, range of validity, what is stored and what is dissipated

  bool prescribes_motion() const {
    return std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.prescribes_motion(); });
  }
};

using Declarations = std::span<const Declaration* const>;

}  // namespace rheonet
