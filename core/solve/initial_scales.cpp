#include "core/solve/initial_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/polynomial.hpp"
#include "core/network/error.hpp"
#include "core/solve/unknown.hpp"

namespace rheonet {

namespace {

/// Angle of an oscillation per step [rad] at which the polynomial of a delay history misses a sine by a tenth of the
/// accuracy. The history interpolates prescribed motions too, which no error test sees.
double remembered_angle(double accuracy) {
  return std::pow(numerics::history_error_share * accuracy / numerics::history_error_in_middle, 1.0 / static_cast<double>(step_points));
}

}  // namespace

std::vector<double> coming_size(Dae& dae, Consistency& consistency, double t, const Motion& motion, double ahead) {
  const std::size_t n = motion.y.size();
  std::vector<double> size(n);
  for (std::size_t i = 0; i < n; ++i) size[i] = std::abs(motion.y[i]);
  const auto guess = [&] {
    std::vector<double> y = motion.y, yp(n, 0);
    try {
      if (consistency.collocate(t + ahead, 1 / ahead, y, yp) > numerics::guessed_state_change) return false;
    } catch (const SimulationError&) {  // the guess is no state of the network
      return false;
    }
    for (std::size_t i = 0; i < n; ++i) size[i] = std::max(size[i], std::abs(y[i]));
    return true;
  };
  if (dae.rough() && guess()) return size;
  for (std::size_t i = 0; i < n; ++i) size[i] += ahead * (std::abs(motion.yp[i]) + ahead / 2 * std::abs(motion.ypp[i]));
  // A state behind several others grows with a higher power of time.
  const std::vector<Unknown> unknowns = unknowns_of(dae);
  const auto behind = [&](const Unknown& q) { return q.sort == Unknown::Sort::block && size[at(static_cast<int>(&q - unknowns.data()))] == 0; };
  if (!dae.rough() && std::any_of(unknowns.begin(), unknowns.end(), behind)) guess();
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
  double sum = 0;
  for (std::size_t i = 0; i < ypp.size(); ++i) {
    const double e = ypp[i] / 2 / tolerance[i];
    sum += e * e;
  }
  const double curvature = ypp.empty() ? 0 : std::sqrt(sum / static_cast<double>(ypp.size()));
  return curvature > 0 ? std::sqrt(numerics::first_step_error / curvature) : std::numeric_limits<double>::infinity();
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
    if (slips_along) turn = numerics::slip_phase_a_step / omega;
    if (sticks) turn = numerics::phase_a_step / omega;
    if (std::isfinite(inputs.history().shortest())) turn = std::min(turn, std::min(numerics::phase_a_step, remembered_angle(accuracy)) / omega);
  }
  return std::min(turn, inputs.history().longest_step());
}

}  // namespace rheonet
