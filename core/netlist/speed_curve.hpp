#pragma once

#include <cstddef>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/characteristic.hpp"
#include "core/netlist/switched_function.hpp"

namespace rheonet {

/// Friction as a function of the velocity w, the same for w and -w: the second of the three variables d, w and t. A curve through
/// points goes on straight beyond them, or holds its last value if an upper bound confines it (an efficiency).
///
/// Switches stand at the corners of the curve, and at the *marks* of a smooth one: speeds at which it begins to bend. Without them a
/// step from far outside could pass over the curve, where friction is nearly constant, and not notice it.
class SpeedCurve final : public SwitchedFunction {
 public:
  /// `curve` must outlive it. Values below the lower one of these bounds of a parameter count as that bound.
  SpeedCurve(const Characteristic& curve, const Parameter& bounds);

  std::size_t variables() const override { return 3; }
  std::size_t switches() const override;
  bool uses(std::size_t variable) const override { return variable == 1; }
  std::string text() const override { return "curve over the speed"; }

  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides = {}) const override;
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const override;
  bool complete_sides(std::span<const double> arguments, std::span<double> sides) const override;
  bool cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const override;
  bool switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const override;

  /// Speeds at which it switches, in order.
  const std::vector<double>& marks() const { return marks_; }

 private:
  void mark_end();
  double speed(double w) const;
  std::size_t number_at(double x, std::span<const double> sides) const;
  std::span<const double> own(std::span<const double> sides) const { return sides.empty() ? sides : sides.subspan(own_); }
  double along(double w, std::span<const double> sides, double& slope) const;

  const Characteristic& curve_;
  double least_;
  bool holds_;  ///< its last value beyond its points
  std::vector<double> marks_;
  std::size_t own_ = 0;  ///< number of the first switch that the expression of the curve has of its own
};

}  // namespace rheonet
