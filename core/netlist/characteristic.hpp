#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/netlist/curve.hpp"
#include "core/netlist/polyline.hpp"
#include "core/netlist/switched_function.hpp"

namespace rheonet {

/// The force of an element as a function of its displacement or velocity, x: straight lines between points, a monotone cubic
/// spline through them (curve.hpp), or an expression. Beyond its points it goes on straight, with the slope that it has there.
class Characteristic {
 public:
  /// At least two points; `x` increases.
  Characteristic(std::vector<double> x, std::vector<double> force, bool smooth);
  /// An expression over x divided by `by_x`; its value is multiplied by `by_force`. Its corners are not known, and whether it falls is
  /// known from samples only.
  explicit Characteristic(std::shared_ptr<const SwitchedFunction> expression, double by_x = 1, double by_force = 1);
  /// Where an expression is sampled: from 1e-9 to 1e9 on both sides of 0, and at 0.
  static std::vector<double> samples();

  /// The same with other units: factors above 0 on x and on the force.
  Characteristic scaled(double by_x, double by_force) const;

  /// Force [N | N m] and its slope at x.
  double force(double x, double& slope) const { return force(x, slope, {}); }
  /// The same at held sides of its expression, if it is one.
  double force(double x, double& slope, std::span<const double> sides) const;
  /// Work from 0 to x [J]: the integral of the force.
  double work(double x) const;
  /// The least x >= 0 with this force for a force above 0, the greatest x <= 0 for one below, where the force never falls.
  /// Infinite if there is none.
  double where(double force) const;
  /// Slope in the limit of large x, in the direction of `side` (-1 or 1).
  double last_slope(int side) const;

  /// The straight lines between its corners; nullptr for a spline and an expression.
  const Polyline* lines() const { return lines_ ? &*lines_ : nullptr; }

  /// The points, and nullptr; or none, and the expression, over x divided by `unit`.
  const std::vector<double>& points() const { return x_; }
  const SwitchedFunction* expression() const { return expression_.get(); }
  double unit() const { return by_x_; }

  /// The first point whose force is less than that of the point before it; absent if there is none.
  std::optional<double> falls_at() const { return falls_at_; }

 private:
  double integral(double x) const;

  std::shared_ptr<const SwitchedFunction> expression_;
  double by_x_ = 1, by_force_ = 1;
  std::vector<double> x_, force_;     ///< the points
  bool smooth_ = false;
  std::optional<Polyline> lines_;
  std::optional<Curve> curve_;
  std::optional<double> falls_at_;
};

}  // namespace rheonet
