#include "core/solve/newton.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

Newton::Newton(Dae& dae, bool sparse, const std::vector<double>& tolerance, const std::vector<double>& grain)
    : dae_(dae),
      grain_(grain),
      linear_(dae.pattern(), sparse, tolerance),
      change_(at(dae.size()), 0),
      last_change_(dae.rough() ? change_.size() : 0, 0) {}

void Newton::restart() {
  singular_ = false;
  jacobian_cj_ = last_cj_ = 0;
  counts_ = {};
}

bool Newton::stale(double cj) const {
  constexpr double least = (1 - numerics::jacobian_change) / (1 + numerics::jacobian_change);
  const double ratio = cj / jacobian_cj_;
  return jacobian_cj_ == 0 || ratio < least || ratio > 1 / least;
}

/// Evaluates the negative residual with this correction. False where the correction is out of a law's range.
bool Newton::evaluate(const Step& step, const double* correction) {
  ++counts_.residuals;
  for (std::size_t i = 0; i < change_.size(); ++i) {
    step.y[i] = step.predicted_y[i] + correction[i];
    step.yp[i] = step.predicted_yp[i] + step.cj * correction[i];
  }
  dae_.residual(step.t, step.y, step.yp, change_.data());
  bool finite = true;
  for (double& r : change_) {
    finite = finite && std::isfinite(r);
    r = -r;
  }
  return finite;
}

bool Newton::renew(const Step& step) {
  ++counts_.jacobians;
  dae_.jacobian(step.t, step.cj, step.y, step.yp, linear_.entries());
  jacobian_cj_ = step.cj;
  foreseen_ = numerics::newton_error_new_jacobian;
  singular_ = !linear_.factorise();
  if (singular_) jacobian_cj_ = 0;
  return !singular_;
}

bool Newton::solve(const Step& step, double* correction, const double* weight, double enough) {
  if (step.cj != last_cj_) foreseen_ = numerics::newton_error_old_jacobian;
  last_cj_ = step.cj;
  for (bool anew = stale(step.cj);; anew = true) {
    std::fill_n(correction, change_.size(), 0.0);
    const bool ready = evaluate(step, correction) && (!anew || renew(step));
    if (ready && iterate(step, correction, weight, enough) == Verdict::converged) return true;
    ++counts_.failures;
    if (anew || !ready) break;
  }
  return false;
}

/// Iterates, starting from the residual of the correction.
Newton::Verdict Newton::iterate(const Step& step, double* correction, const double* weight, double enough) {
  // A Jacobian of another cj gives changes too large or too small: half of that is corrected (as in IDA).
  const double scale = 2 / (1 + step.cj / jacobian_cj_);
  for (int iteration = 0; iteration < numerics::newton_iterations; ++iteration) {
    if (iteration > 0 && !evaluate(step, correction)) break;
    linear_.solve(change_.data());
    for (std::size_t i = 0; i < change_.size(); ++i) correction[i] += change_[i] *= scale;
    const Verdict verdict = judge(step, iteration, weight, enough);
    if (verdict != Verdict::go_on) return verdict;
  }
  return Verdict::hopeless;
}

Newton::Verdict Newton::judge(const Step& step, int iteration, const double* weight, double enough) {
  const double size = norm(weight);
  if (iteration == 0) first_change_ = size;
  return dae_.rough() ? rough(step, iteration, size, weight, enough) : smooth(step, iteration, size, weight, enough);
}

/// IDA's test, with two exceptions: an iteration that stalls has converged if it is within the round-off of the unknowns, or
/// if it would satisfy IDA's default tolerance.
Newton::Verdict Newton::smooth(const Step& step, int iteration, double size, const double* weight, double enough) {
  if (iteration == 0) {
    if (size <= numerics::newton_no_change * enough) return Verdict::converged;
  } else {
    const double rate = iteration == 1 ? size / first_change_ : std::pow(size / first_change_, 1.0 / iteration);
    if (rate > numerics::newton_slowest_rate) return size <= std::max(rounding(step, weight), numerics::newton_stalled_change) ? Verdict::converged : Verdict::hopeless;
    foreseen_ = rate / (1 - rate);
  }
  return foreseen_ * size <= enough ? Verdict::converged : Verdict::go_on;
}

/// For power laws. IDA's own test accepts one small first change if the iteration converged fast in the step before. But a
/// power law is so steep near rest that with a Jacobian from there any change is small: a second change is required.
Newton::Verdict Newton::rough(const Step& step, int iteration, double size, const double* weight, double enough) {
  const bool back = iteration > 0 && turns_back(weight);
  last_change_ = change_;
  if (iteration == 0) return size <= numerics::newton_no_change_rough * enough ? Verdict::converged : Verdict::go_on;
  if (size <= rounding(step, weight)) return Verdict::converged;
  // Changes that alternate in sign, as in the round-off of velocity differences, are about as large as the error.
  if (back && size <= numerics::newton_certain_change * enough) return Verdict::converged;
  const double rate = std::pow(size / first_change_, 1.0 / iteration);
  if (rate > numerics::newton_slowest_rate) return size <= numerics::newton_certain_change * enough ? Verdict::go_on : Verdict::hopeless;
  return rate / (1 - rate) * size <= enough ? Verdict::converged : Verdict::go_on;
}

double Newton::norm(const double* weight) const {
  const auto size = static_cast<Eigen::Index>(change_.size());
  using Values = Eigen::Map<const Eigen::ArrayXd>;
  return std::sqrt((Values(change_.data(), size) * Values(weight, size)).square().sum() / static_cast<double>(size));
}

bool Newton::turns_back(const double* weight) const {
  double sum = 0;
  for (std::size_t i = 0; i < last_change_.size(); ++i) sum += (weight[i] * change_[i]) * (weight[i] * last_change_[i]);
  return sum < 0;
}

/// The round-off of the unknowns, as the norm of a change.
double Newton::rounding(const Step& step, const double* weight) const {
  constexpr double grains = numerics::newton_change_ulps * std::numeric_limits<double>::epsilon();
  double sum = 0;
  for (std::size_t i = 0; i < grain_.size(); ++i) {
    const double least = weight[i] * std::max(grains * std::abs(step.y[i]), grain_[i]);
    sum += least * least;
  }
  return std::sqrt(sum / static_cast<double>(grain_.size()));
}

}  // namespace rheonet
