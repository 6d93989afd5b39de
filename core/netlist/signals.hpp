#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/scene.hpp"
#include "core/netlist/signal.hpp"
#include "core/netlist/table_file.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

/// A signal as the file gives it: its shape is known, its numbers are evaluated where their names are known.
class SignalPlan {
 public:
  /// `name` is what messages call it: "velocity". Without a quantity any unit will do, as long as there is only one.
  SignalPlan(const TomlValue& source, const std::string& name, std::optional<Quantity> quantity, Context& context);

  /// The signal where `environment` holds; absent if anything in it is a mistake.
  std::optional<Signal> evaluate(const Environment& environment, Context& context) const;

  /// In which unit it was at the last evaluation.
  const BlockUnit& unit() const { return unit_; }

  /// `step`, `ramp`, ...
  static const std::vector<std::string>& shape_names();

 private:
  enum class Shape { step, ramp, sine, cosine, square, triangle, chirp, pulse, table, constant };
  enum Key { amplitude, frequency, end_frequency, duration, width, phase, time, offset, key_count };
  struct Point {
    Formula time;
    Formula value;
  };

  static const std::array<std::string, key_count>& key_names();
  /// The entry that says the shape; nullptr, with a message, if not one does.
  const TomlEntry* find_shape(const TomlValue& source, Mistakes& mistakes) const;
  void read_table_signal(const TomlValue& source, Context& context);
  void read_points(const TomlValue& source, Context& context);
  void read_columns(const TomlEntry& columns, Mistakes& mistakes);
  /// `formula` times the amplitude, in SI; for a ramp its unit is that of the quantity per second.
  std::optional<double> scaled(const Formula& formula, const Environment& environment, Context& context) const;
  /// `hint`, or what mends a unit that `formula` and the amplitude have both.
  std::string hint_for(const Formula& formula, const Environment& environment, Context& context,
                       std::string hint) const;
  /// Whether the main value is an expression of the time, which is a mistake.
  bool is_of_time(const Environment& environment, Context& context) const;
  /// Whether it is a name alone, and that of no parameter: it may be meant for a block, which is a mistake.
  bool is_unknown_name(const Environment& environment, Context& context) const;
  const TableFile* table_file(Context& context) const;
  std::optional<Number> times_amplitude(Number number, const Environment& environment, Context& context) const;
  std::optional<double> value_of(Key key, const Environment& environment, Context& context, double otherwise) const;
  /// The value of a signal, in SI, if its unit is the one that it has to have.
  std::optional<double> in_unit(const Number& number, const Formula& formula, const Environment& environment,
                                Context& context) const;
  std::optional<Signal> make(const Environment& environment, Context& context) const;
  std::optional<Signal> make_table(const Environment& environment, Context& context, double time, double offset) const;

  std::string name_;
  std::optional<Quantity> quantity_;
  Shape shape_ = Shape::constant;
  bool sound_ = true;
  bool constant_ = true;  ///< no name in it: one evaluation serves all elements
  Formula main_;
  std::array<Formula, key_count> keys_;
  std::vector<Point> points_;
  std::optional<TomlValue> file_name_;  ///< of a CSV file with the points
  std::vector<TomlValue> columns_;      ///< names of those of the times and the values; empty: the file has two
  /// What is in it, nullptr if it is mistaken. Read when it is needed: an override may take its place.
  mutable std::optional<std::shared_ptr<const TableFile>> file_;
  mutable std::optional<Signal> made_;
  mutable BlockUnit unit_;
};

}  // namespace rheonet
