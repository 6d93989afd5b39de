#include "core/solve/initial_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dae/polynomial.hpp"
#include "core/network/error.hpp"

namespace rheonet {

namespace {

// Largest phase of an oscillation per step while sliders stick [rad]: their forces may be functions of time alone, which no
// error test sees.
constexpr double longest_angle = 0.3;
// The same while sliders slip that follow the inputs directly [rad]: such a slider reverses at most once within a step.
constexpr double longest_slip = 1.5;

/// Angle of an oscillation per step [rad] at which the polynomial of a delay history misses a sine by a tenth of the
/// accuracy. The history interpolates prescribed motions too, which no error test sees.
double remembered_angle(double accuracy) {
  constexpr double share = 0.1, at_middle = 0.005;  // error in the middle of six points: (5/2 3/2 1/2)^2/6!
  return std::pow(share * accuracy / at_middle, 1.0 / static_cast<double>(step_points));
}

}  // namespace

std::vector<double> coming_size(const Dae& dae, Consistency& consistency, double t, const Motion& motion, double ahead) {
  const std::size_t n = motion.y.size();
  std::vector<double> size(n);
  for (std::size_t i = 0; i < n; ++i) size[i] = std::abs(motion.y[i]);
  if (dae.rough()) {
    constexpr double about = 0.1;
    std::vector<double> y = motion.y, yp(n, 0);
    try {
      if (consistency.collocate(t + ahead, 1 / ahead, y, yp) <= about) {
        for (std::size_t i = 0; i < n; ++i) size[i] = std::max(size[i], std::abs(y[i]));
        return size;
      }
    } catch (const SimulationError&) {  // the guess is no state of the network
    }
  }
  for (std::size_t i = 0; i < n; ++i) size[i] += ahead * (std::abs(motion.yp[i]) + ahead / 2 * std::abs(motion.ypp[i]));
  return size;
}

double fastest_rate(const Dae& dae, Consistency& consistency, double t, double horizon, const Motion& motion, double ahead) {
  if (!dae.rough()) return consistency.fastest_rate(t, horizon, motion.y, motion.yp);
  std::vector<double> y = motion.y, yp(y.size());
  // Inputs that start from rest have no effect to first order, hence the second order.
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += ahead * (motion.yp[i] + ahead / 2 * motion.ypp[i]);
  try {
    consistency.project(t + ahead, y);
    consistency.derivative(t + ahead, y, yp);
    return consistency.fastest_rate(t + ahead, horizon, y, yp);
  } catch (const SimulationError&) {  // the guess is no state of the network
    return consistency.fastest_rate(t, horizon, motion.y, motion.yp);
  }
}

double first_step(const std::vector<double>& ypp, const std::vector<double>& tolerance) {
  constexpr double error = 0.3;  // weighted root mean square of h^2 y''/2
  double sum = 0;
  for (std::size_t i = 0; i < ypp.size(); ++i) {
    const double e = ypp[i] / 2 / tolerance[i];
    sum += e * e;
  }
  const double curvature = ypp.empty() ? 0 : std::sqrt(sum / static_cast<double>(ypp.size()));
  return curvature > 0 ? std::sqrt(error / curvature) : std::numeric_limits<double>::infinity();
}

bool stay_close(const Motion& a, const Motion& b, double ahead, const std::vector<double>& tolerance) {
  for (std::size_t i = 0; i < a.y.size(); ++i) {
    const double of_rate = std::abs(a.yp[i] - b.yp[i]), of_curvature = std::abs(a.ypp[i] - b.ypp[i]);
    if (!(std::abs(a.y[i] - b.y[i]) + ahead * (of_rate + ahead / 2 * of_curvature) <= tolerance[i])) return false;
  }
  return true;
}

double longest_step(const Inputs& inputs, bool sticks, bool slips_along, double accuracy) {
  double turn = std::numeric_limits<double>::infinity();
  if (const double omega = inputs.fastest(); omega > 0) {
    if (slips_along) turn = longest_slip / omega;
    if (sticks) turn = longest_angle / omega;
    if (std::isfinite(inputs.history().shortest())) turn = std::min(turn, std::min(longest_angle, remembered_angle(accuracy)) / omega);
  }
  return std::min(turn, inputs.history().longest_step());
}

}  // namespace rheonet
