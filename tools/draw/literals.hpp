#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/units.hpp"

namespace rheonet::draw {

/// A number with its unit, as it stands in a netlist: "2 in*ozf".
struct Literal {
  double value;
  std::string unit;  ///< "" for a plain number
};

/// Absent if the value is an expression, or no number at all.
std::optional<Literal> literal_of(const TomlValue& value);

/// The quantities that the files of a scene give, so that a value can be said as its file says it.
class Typed {
 public:
  Typed() = default;
  explicit Typed(const Sources& sources);

  struct Said {
    double value;
    std::string unit;
  };
  /// A value [SI; `unit` as a user would type it] in the unit in which a file gives it; where it follows from others, in that
  /// in which the files give such values. Absent if no file gives any, or if some multiple of a unit of SI says it as well.
  std::optional<Said> say(double value, const std::string& unit) const;

 private:
  struct Quantity {
    Literal literal;
    Unit unit;
    double value;  ///< SI
  };
  void gather(const TomlValue& value);
  void add(const std::optional<Literal>& literal);

  std::vector<Quantity> quantities_;
};

}  // namespace rheonet::draw
