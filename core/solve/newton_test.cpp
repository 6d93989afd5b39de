#include "core/solve/newton_test.hpp"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rheonet {

namespace {

double* data(N_Vector v) { return N_VGetArrayPointer(v); }

}  // namespace

NewtonTest::NewtonTest(const std::vector<double>& y, const std::vector<double>& grain, bool rough)
    : y_(y), grain_(grain), rough_(rough), last_change_(rough ? y.size() : 0, 0) {}

int NewtonTest::attach(SUNNonlinearSolver newton) {
  const auto* content = static_cast<SUNNonlinearSolverContent_Newton>(newton->content);
  ida_test_ = content->CTest;
  ida_data_ = content->ctest_data;
  const auto test = [](SUNNonlinearSolver solver, N_Vector sum, N_Vector change, realtype tolerance, N_Vector weight, void* self) {
    auto& t = *static_cast<NewtonTest*>(self);
    return t.rough_ ? t.rough(solver, change, tolerance, weight) : t.smooth(solver, sum, change, tolerance, weight);
  };
  return SUNNonlinSolSetConvTestFn(newton, test, this);
}

/// IDA takes an iteration that has come to the rounding of the unknowns, and gets no further, for one that fails. So it is
/// with one that gets no further where it would be done by IDA's default.
int NewtonTest::smooth(SUNNonlinearSolver newton, N_Vector sum, N_Vector change, double tolerance, N_Vector weight) const {
  constexpr double no_farther = 0.1;
  const int flag = ida_test_(newton, sum, change, tolerance, weight, ida_data_);
  if (flag != SUN_NLS_CONV_RECVR) return flag;
  return N_VWrmsNorm(change, weight) <= std::max(rounding(weight), no_farther) ? SUN_NLS_SUCCESS : flag;
}

/// IDA's own test takes one small first change for enough where the iteration converged fast in the step before. A power law
/// is so steep near rest that with a Jacobian from there any change is small: the second one has to show.
int NewtonTest::rough(SUNNonlinearSolver newton, N_Vector change, double tolerance, N_Vector weight) {
  constexpr double nothing_to_change = 1e-4, slowest_rate = 0.9;  // as in IDA
  constexpr double certain = 0.1;  // of what is allowed: whether the next change is smaller or not
  int iteration = 0;
  SUNNonlinSolGetCurIter(newton, &iteration);
  const double size = N_VWrmsNorm(change, weight);
  const bool back = iteration > 0 && turns_back(change, weight);
  std::copy_n(data(change), last_change_.size(), last_change_.begin());
  if (iteration == 0) {
    first_change_ = size;
    return size <= nothing_to_change * tolerance ? SUN_NLS_SUCCESS : SUN_NLS_CONTINUE;
  }
  if (size <= rounding(weight)) return SUN_NLS_SUCCESS;
  // To and fro over the solution, in the rounding of differences of velocities, say: about as far from it as this.
  if (back && size <= certain * tolerance) return SUN_NLS_SUCCESS;
  const double rate = std::pow(size / first_change_, 1.0 / iteration);
  if (rate > slowest_rate) return size <= certain * tolerance ? SUN_NLS_CONTINUE : SUN_NLS_CONV_RECVR;
  return rate / (1 - rate) * size <= tolerance ? SUN_NLS_SUCCESS : SUN_NLS_CONTINUE;
}

bool NewtonTest::turns_back(N_Vector change, N_Vector weight) const {
  double sum = 0;
  for (std::size_t i = 0; i < last_change_.size(); ++i) {
    const double w = data(weight)[i];
    sum += (w * data(change)[i]) * (w * last_change_[i]);
  }
  return sum < 0;
}

/// What rounding leaves of the unknowns, as the norm of a change. (IDA holds the iterate in the vector that it returns.)
double NewtonTest::rounding(N_Vector weight) const {
  // A change comes out of a residual and two triangular solutions, sums of some tens of rounded terms.
  constexpr double grains = 64 * std::numeric_limits<double>::epsilon();
  double sum = 0;
  for (std::size_t i = 0; i < grain_.size(); ++i) {
    const double least = data(weight)[i] * std::max(grains * std::abs(y_[i]), grain_[i]);
    sum += least * least;
  }
  return std::sqrt(sum / static_cast<double>(grain_.size()));
}

}  // namespace rheonet
