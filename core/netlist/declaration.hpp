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

/// Describes a parameter of an element as data. Parsing, checking, error texts, the printed reference and the JSON Schema
/// are all derived from it.
struct Parameter {
  enum class Kind {
    value,    ///< A number with a dimension.
    signal,   ///< A function of time.
    initial,  ///< An initial value (`f0`, `d0`): optional, absent means "not given".
    characteristic,  ///< A function of the displacement or velocity of the element; its value is 1 if it is given.
    expression,  ///< The output of a block as an expression over its inputs `u1`, `u2`, ... and the time `t`.
    table,       ///< The output of a block by points, [input, output], or a CSV file; goes with `smooth` and `columns`.
    coefficients,  ///< Coefficients of a polynomial in the Laplace variable s, highest power first; any number of them.
  };

  /// How the unit of a parameter is determined. The unit of a block's parameter may depend on what the block is connected
  /// to.
  enum class Unit {
    quantity,  ///< The unit of `quantity`.
    own,       ///< Any unit; a factor of the unit of the block's output.
    divides,   ///< Any unit, by which that of the block's output is divided; without a unit it is a number.
    input,     ///< The unit of the block's inputs.
    output,    ///< The unit of the block's output.
  };

  std::string name = {};
  Quantity quantity = Quantity::number;
  Unit unit = Unit::quantity;
  Kind kind = Kind::value;
  std::optional<double> fallback = {};  ///< Absent: the user must give the value (an `initial` is always optional).
  double lower = 0;                ///< Inclusive, unless lower_open.
  bool lower_open = true;
  double upper = std::numeric_limits<double>::infinity();  ///< Inclusive if finite; values are finite ...
  bool may_be_infinite = false;                            ///< ... unless the law has a limit at infinity: then "inf" is accepted.
  std::string flow_index = {};        ///< For damping: the parameter that holds n in N*(s/m)^n; "" means n = 1.
  Quantity over = Quantity::position;  ///< For a characteristic: the quantity that it is a function of.
  bool resists = false;               ///< For a characteristic: it has the sign of its argument, and is 0 at 0.
  bool may_vary = false;              ///< A signal may be given in place of a value; below `lower` it counts as `lower`.
  bool may_be_curve = false;          ///< A function of `over` may be given in place of a value: friction over the speed.
  bool optional = false;              ///< May be absent, without a default.
  std::string coefficient_with = {};  ///< Where that parameter is given, this one is a number that multiplies it.
  std::string second_of = {};         ///< The second of two values in brackets, that parameter = [x, y]; without brackets both are the same.
  std::string not_with = {};          ///< A parameter that may not be given together with this one.
  std::string same_as = {};           ///< The parameter whose value is used if none is given (`breakaway` = `coulomb`).
  bool opposite = false;              ///< The value of `same_as` is negated (`lower` = -`upper`).
  std::string turned = {};            ///< The parameter whose negative takes its place where the element is turned round (`lower`: `upper`).
  bool from_block = false;            ///< For a signal: the output of a block may be given instead.
  std::string rotational_name = {};   ///< Name in a rotational scene, if different (`inertia` for `mass`).
  std::string symbol = {};            ///< As in the law.
  std::vector<std::string> other_names = {};  ///< Names of the parameter elsewhere, beside its symbol, for messages: `static`.
  std::string description = {};

  const std::string& name_in(Domain domain) const {
    return domain == Domain::rotation && !rotational_name.empty() ? rotational_name : name;
  }
  /// Whether a signal may be given for it.
  bool takes_signal() const { return kind == Kind::signal || may_vary; }
  /// Whether the parameter prescribes a node's motion: a signal for its position or its velocity.
  bool prescribes(Quantity motion) const { return kind == Kind::signal && quantity == motion; }
  bool prescribes_motion() const {
    return prescribes(Quantity::position) || prescribes(Quantity::velocity) || prescribes(Quantity::acceleration);
  }
};

/// A rule violated by values that are each within their bounds.
struct Misfit {
  std::string parameter;  ///< The parameter named in the message.
  std::string what;       ///< Text after its name: "is less than ...".
};

/// An effect that an element has while `parameter` is finite and above 0. `absent` is the value of `parameter` that leaves
/// the effect out; without it, only an Absence can leave the effect out.
struct Brought {
  Effect effect;
  std::string parameter;
  std::optional<double> absent = {};
  bool otherwise = false;  ///< The element has the effect with every value but `absent`.
};

/// Values of further parameters, used when all of `effects` that the element has are left out.
struct Absence {
  std::vector<Effect> effects;
  std::vector<std::pair<std::string, double>> values;
};

/// Describes an element type as data. The values of an element are stored in the order of `parameters`.
struct Declaration {
  enum class Ports {
    between,
    at,
    at_or_between,
    block,  ///< No node: a block computes a signal from its inputs.
  };
  /// The inputs of a block. The output unit is that of the inputs, times the block's `own` units, times s if the block
  /// integrates; or that of its expression.
  struct Inputs {
    std::size_t least = 1, most = 1;
    bool integrates = false;
    bool alike = true;  ///< All in one unit.
  };

  std::string type = {};
  std::vector<std::string> other_names = {};  ///< Names of the type elsewhere, for messages: `damper`.
  std::string rotational_type = {};  ///< An alias that puts its nodes in rotation (`inertia`, `torque`); "" if none.
  Ports ports = Ports::between;
  std::vector<Domain> domains = {};  ///< Domains of its two nodes, if the type determines them (`rack`); else both are in one domain.
  bool supported = false;  ///< For a transmission: `support` may name the node against which it turns, in place of ground.
  std::vector<std::string> three = {};  ///< For a transmission between three nodes: what they are in it; the second one is its support.
  Inputs inputs = {};  ///< For a block.
  std::vector<Parameter> parameters = {};
  std::vector<std::string> one_of = {};  ///< Exactly one of these parameters must be given (`position` or `velocity`).
  std::function<std::optional<Misfit>(std::span<const double>)> check = {};  ///< Checks the values of an element together.
  /// Checks the coefficients of its polynomials together.
  std::function<std::optional<Misfit>(const std::vector<std::vector<double>>&)> check_coefficients = {};
  std::vector<Brought> effects = {};   ///< Effects that a scene can leave out.
  std::vector<Absence> absences = {};  ///< Tried in order, after the `absent` value of each single effect.
  bool resists = false;      ///< Its signal is a force that it resists with, as a spring does: it applies none.
  std::string summary = {};  ///< One line.
  std::string law = {};      ///< As a textbook prints it.
  std::string equation = {};  ///< The law in TeX.
  std::string source = {};   ///< citation
  std::string notes = {};    ///< Sign, range of validity, stored and dissipated energy.

  /// An expression or a table gives its output.
  bool is_function() const {
    return std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.kind == Parameter::Kind::expression || p.kind == Parameter::Kind::table; });
  }
  /// It applies a force or a motion that a signal gives.
  bool is_source() const {
    return !resists && std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.kind == Parameter::Kind::signal; });
  }
  bool prescribes_motion() const {
    return std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.prescribes_motion(); });
  }
};

using Declarations = std::span<const Declaration* const>;

/// The hint for a type that has this name elsewhere: "it is called `dashpot` here" for `damper`; "" if no type has.
std::string called_here(std::string_view name, Declarations declarations);

}  // namespace rheonet
