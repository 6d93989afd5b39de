#include "core/netlist/lookup_template.hpp"

#include <fmt/format.h>
#include <cmath>
#include <string>
#include <utility>

#include "core/netlist/counting.hpp"
#include "core/netlist/lookup_table.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/table_file.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

namespace {

/// The numbers of one column, which share a unit.
struct Column {
  std::vector<double> values;
  Number unit = {};  ///< plain until a number has one

  bool add(const Formula& formula, const char* column, const Environment& environment, DiagnosticList& diagnostics) {
    const auto number = formula.evaluate(environment, diagnostics);
    if (!number) return false;
    const Spot spot = formula.source().spot;
    if (!std::isfinite(number->value)) {
      diagnostics.error(spot, formula.name() + " must be finite, but is infinite");
      return false;
    }
    if (unit.plain && !number->plain) unit = *number;
    if (!fits(*number, unit)) {
      diagnostics.error(spot, formula.name() + ": expected " + describe(unit) + ", as the other " + column + ", found " + describe(*number));
      return false;
    }
    values.push_back(number->value);
    return true;
  }
};

}  // namespace

const char* const LookupTemplate::example = "points [input, output], or the name of a CSV file: table = [[\"0 m\", \"0 N\"], [\"1 m\", \"5 N\"]]";

LookupTemplate::LookupTemplate(const TomlValue& table, const TomlEntry* smooth, const TomlEntry* columns, Context& context) : source_(&table) {
  DiagnosticList& diagnostics = context.diagnostics;
  const std::size_t before = diagnostics.errors();
  if (!table.is_string() && expect_array(table, "`table`", diagnostics, example)) {
    if (table.items.empty()) diagnostics.error(table.spot, "`table` has no points", example);
    points_ = read_table_points(table, "input", "output", diagnostics);
  }
  if (columns) columns_ = read_column_names(*columns, table.is_string(), "input", "\"gap\", \"force\"", diagnostics);
  smooth_ = smooth && expect_boolean(smooth->value, "`smooth`", diagnostics, "smooth = true") && smooth->value.boolean;
  sound_ = diagnostics.errors() == before;
}

std::optional<Lookup> LookupTemplate::evaluate(const Environment& environment, Context& context) const {
  if (!sound_) return {};
  DiagnosticList& diagnostics = context.diagnostics;
  Column inputs, outputs;
  std::vector<Spot> spots;
  if (source_->is_string()) {
    const auto file = read_table_file(*source_, columns_, {{}, "input", "a block"}, context);
    if (!file) return {};
    inputs.unit = file->argument;
    outputs.unit = file->unit;
    for (const auto& [input, output] : file->points) {
      inputs.values.push_back(input);
      outputs.values.push_back(multiplied(output, file->unit.value));
    }
  }
  for (const TablePoints::Point& point : points_.points) {
    if (!inputs.add(point.x, "inputs", environment, diagnostics) || !outputs.add(point.y, "outputs", environment, diagnostics)) return {};
    spots.push_back(point.x.source().spot);
  }
  const auto spot_of = [&](std::size_t k) { return spots.empty() ? source_->spot : spots[k]; };
  for (std::size_t k = 1; k < inputs.values.size(); ++k) {
    const double step = inputs.values[k] - inputs.values[k - 1];
    if (step > 0 || (step == 0 && !smooth_)) continue;
    diagnostics.error(spot_of(k), step < 0 ? fmt::format("the inputs of a table must not decrease, but {:.6g} follows {:.6g}", inputs.values[k], inputs.values[k - 1]) : "a smooth table cannot jump, but has two points at one input");
    return {};
  }
  inputs.unit.value = outputs.unit.value = 1;
  constexpr std::size_t variables = 2;  // the input and the time
  return Lookup{std::make_shared<const LookupTable>(std::move(inputs.values), std::move(outputs.values), smooth_, variables), inputs.unit, outputs.unit};
}

}  // namespace rheonet
