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
#include "core/netlist/table_points.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

/// A signal as given by the file: its shape is known; its numbers are evaluated in an environment.
class SignalTemplate {
 public:
  /// `name` is used in messages: "velocity". Without a quantity any unit is accepted, but all values must share it.
  SignalTemplate(const TomlValue& source, const std::string& name, std::optional<Quantity> quantity, Context& context);

  /// The signal in `environment`; absent if anything in it is a mistake.
  std::optional<Signal> evaluate(const Environment& environment, Context& context) const;

  /// Unit of the signal at the last evaluation.
  const BlockUnit& unit() const { return unit_; }

  /// `step`, `ramp`, ...
  static const std::vector<std::string>& shape_names();

 private:
  enum class Shape { step, ramp, sine, cosine, square, triangle, chirp, pulse, noise, table, constant };
  enum Key { amplitude, frequency, end_frequency, duration, width, phase, time, offset, interval, seed, key_count };

  static const std::array<std::string, key_count>& key_names();
  /// The entry that determines the shape; nullptr, with a mistake, unless exactly one does.
  const TomlEntry* find_shape(const TomlValue& source, DiagnosticList& diagnostics) const;
  void read_table_signal(const TomlValue& source, Context& context);
  void read_points(const TomlValue& source, Context& context);
  /// `formula` times the amplitude, in SI; for a ramp its unit is that of the quantity per second.
  std::optional<double> scaled(const Formula& formula, const Environment& environment, Context& context) const;
  /// A remedy if both `formula` and the amplitude have a unit, else `hint`.
  std::string hint_for(const Formula& formula, const Environment& environment, Context& context,
                       std::string hint) const;
  /// Whether the main value is an expression of the time, which is a mistake.
  bool is_of_time(const Environment& environment, Context& context) const;
  /// Whether the main value is a single unknown name; it may be meant for a block, which is a mistake.
  bool is_unknown_name(const Environment& environment, Context& context) const;
  const TableFile* table_file(Context& context) const;
  std::optional<Number> times_amplitude(Number number, const Environment& environment, Context& context) const;
  std::optional<double> value_of(Key key, const Environment& environment, Context& context, double otherwise) const;
  /// The value of a signal in SI; absent, with a mistake, if its unit is not the required one.
  std::optional<double> in_unit(const Number& number, const Formula& formula, const Environment& environment,
                                Context& context) const;
  std::optional<Signal> make(const Environment& environment, Context& context) const;
  std::optional<Signal> make_table(const Environment& environment, Context& context, double time, double offset) const;

  std::string name_;
  std::optional<Quantity> quantity_;
  Shape shape_ = Shape::constant;
  bool sound_ = true;
  bool constant_ = true;  ///< contains no names: one evaluation serves all elements
  Formula main_;
  std::array<Formula, key_count> keys_;
  TablePoints points_;
  std::optional<TomlValue> file_name_;  ///< of a CSV file with the points
  bool smooth_ = false;                 ///< a spline through the points
  std::vector<TomlValue> columns_;      ///< names of the columns of times and values; empty: the file has two columns
  /// Contents of the file, nullptr if it has a mistake. Read when first needed, because an override may replace the file.
  mutable std::optional<std::shared_ptr<const TableFile>> file_;
  mutable std::optional<Signal> made_;
  mutable Domain made_in_ = Domain::translation;  ///< the domain in which made_ was evaluated
  mutable BlockUnit unit_;
};

}  // namespace rheonet
