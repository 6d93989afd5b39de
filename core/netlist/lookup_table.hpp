#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/netlist/curve.hpp"
#include "core/netlist/polyline.hpp"
#include "core/netlist/switched_function.hpp"

namespace rheonet {

/// A function of the first of its variables, given by points: straight lines between them, or a monotone cubic spline
/// (curve.hpp); constant beyond the first and the last point. Its only switch has a side for each piece: where the slope or
/// the value jumps, one piece ends. Two points at one argument are a jump, whose value is the second one.
class LookupTable final : public SwitchedFunction {
 public:
  /// At least one point; arguments do not decrease, and increase if the table is `smooth`.
  LookupTable(std::vector<double> arguments, std::vector<double> values, bool smooth, std::size_t variables);

  std::size_t variables() const override { return variables_; }
  std::size_t switches() const override { return lines_.ends().empty() ? 0 : 1; }
  bool uses(std::size_t variable) const override { return variable == 0; }
  bool linear() const override { return !curve_ && variables_ > 1; }  // a single variable is the time
  std::string text() const override;
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides = {}) const override;
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const override;
  bool complete_sides(std::span<const double> arguments, std::span<double> sides) const override;
  bool cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const override;
  bool switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const override;

 private:
  std::size_t number_at(double u, std::span<const double> sides) const;
  bool curved(std::size_t number) const { return curve_ && number == 1; }

  Polyline lines_;              ///< if there is a curve, it takes the place of the second line
  std::optional<Curve> curve_;
  std::size_t variables_, points_;
};

}  // namespace rheonet
