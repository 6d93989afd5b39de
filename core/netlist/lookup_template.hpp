#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/switched_function.hpp"
#include "core/netlist/table_points.hpp"

namespace rheonet {

/// A lookup table with the units of its inputs and outputs: 1 in the unit, plain if they have none.
struct Lookup {
  std::shared_ptr<const SwitchedFunction> table;
  Number input, output;
};

/// The table of a block as given by the file: points `[input, output]`, or the name of a CSV file, of whose columns `columns`
/// names two; `smooth = true` for a monotone cubic spline through the points.
class LookupTemplate {
 public:
  static const char* const example;

  /// `smooth` and `columns` may be nullptr.
  LookupTemplate(const TomlValue& table, const TomlEntry* smooth, const TomlEntry* columns, Context& context);

  const TomlValue& source() const { return *source_; }
  /// The table in `environment`; absent, with a mistake, if something in it is wrong.
  std::optional<Lookup> evaluate(const Environment& environment, Context& context) const;

 private:

  const TomlValue* source_;
  TablePoints points_;  ///< empty: from a file
  std::vector<TomlValue> columns_;
  bool smooth_ = false, sound_ = true;
};

}  // namespace rheonet
