#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/characteristic.hpp"
#include "core/netlist/context.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/table_points.hpp"

namespace rheonet {

/// A characteristic as given by the file: points, the name of a CSV file with points, or an expression over `d` or `w`. Its
/// numbers are evaluated in an environment.
class CharacteristicTemplate {
 public:
  /// `smooth` and `columns` are the entries of these names beside it in the element, nullptr if there are none. `quantity` is that of
  /// its values.
  CharacteristicTemplate(const TomlValue& source, const TomlEntry* smooth, const TomlEntry* columns, const Parameter& parameter, Quantity quantity,
                         Context& context);

  /// Whether a value may be a function over the speed: points, the name of a CSV file, or an expression over `w`.
  static bool may_be(const TomlValue& value, const Parameter& parameter);
  /// Whether a value is an array of values, each of which may be points; points are an array too.
  static bool are_several(const TomlValue& value);

  /// nullptr, with a mistake, if anything in it is wrong.
  std::shared_ptr<const Characteristic> evaluate(const Environment& environment, Context& context) const;

 private:
  struct Numbers { std::vector<double> x, force; };

  const std::string& name() const { return parameter_->second_of.empty() ? parameter_->name : parameter_->second_of; }
  std::string argument() const { return parameter_->may_be_curve ? "speed" : parameter_->over == Quantity::velocity ? "velocity" : "displacement"; }
  void read_columns(const TomlEntry& columns, Context& context);
  void read_table(const TomlValue& source, Context& context);
  void read_points(const TomlValue& source, Context& context);
  std::optional<Numbers> numbers(const Environment& environment, Context& context) const;
  std::optional<Numbers> numbers_of_file(Context& context) const;
  bool check(const Numbers& numbers, Context& context) const;
  std::string outside(double value) const;
  std::shared_ptr<const Characteristic> of_expression(const Environment& environment, Context& context) const;
  Spot spot_of(std::size_t point) const;

  const TomlValue* source_;
  const Parameter* parameter_;
  Quantity quantity_;
  bool sound_ = true, smooth_ = false;
  TablePoints points_;
  bool expression_ = false;
  std::optional<TomlValue> file_name_;
  std::vector<TomlValue> columns_;
  mutable std::shared_ptr<const Characteristic> made_;
};

}  // namespace rheonet
