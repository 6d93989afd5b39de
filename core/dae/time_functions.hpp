#pragma once

#include <Eigen/Core>
#include <vector>

namespace rheonet {

/// The functions of time of which inputs are sums: tau^k/k! up to a degree, then the sine and the cosine of each angular frequency.
/// Coefficients are columns of a matrix, in this order.
struct TimeFunctions {
  int degree = 0;
  std::vector<double> omegas;  ///< ascending [rad/s]

  Eigen::Index count() const { return degree + 1 + 2 * static_cast<Eigen::Index>(omegas.size()); }
  double fastest() const { return omegas.empty() ? 0 : omegas.back(); }  ///< rad/s
  bool operator==(const TimeFunctions&) const = default;

  /// For times from 0 to the end of an interval: sines that are slow beside it are polynomials there, as they could not be told from those.
  TimeFunctions within(double interval) const;

  Eigen::VectorXd at(double tau) const;
  /// Coefficients for time counted from `by` on.
  Eigen::MatrixXd shifted(const Eigen::MatrixXd& coefficients, double by) const;
  /// Coefficients of the derivative.
  Eigen::MatrixXd derivative(const Eigen::MatrixXd& coefficients) const;
  /// Coefficients of several quantities from their values: a row for each time, a column for each quantity, fitted by least squares. The first
  /// time is 0. Differences from the values there are fitted, as small ones keep their digits. `misfit`: the largest difference
  /// between values and fit, of each quantity.
  Eigen::MatrixXd fit(const std::vector<double>& times, const Eigen::MatrixXd& values, Eigen::VectorXd& misfit) const;
};

}  // namespace rheonet
