// A spring in series with a dashpot, one end driven at sin(2 pi t): one unknown, the force, with f'/k + f/c = v.

#include <cmath>
#include <numbers>

#include "tools/bench/hand/ida.hpp"

namespace rheonet::hand {
namespace {

constexpr double k = 1000, c = 50;

int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void*) {
  const double f = NV_Ith_S(y, 0);
  NV_Ith_S(r, 0) = NV_Ith_S(yp, 0) + k / c * f - k * std::sin(2 * std::numbers::pi * t);
  return 0;
}

int jacobian(double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void*, N_Vector, N_Vector, N_Vector) {
  SM_ELEMENT_D(J, 0, 0) = cj + k / c;
  return 0;
}

}  // namespace

Run maxwell(double tolerance, const std::vector<double>& times) {
  Ida ida(1, 0, residual, jacobian, tolerance, 1e-2 * tolerance);
  Ida::check(IDASetInitStep(ida.memory, 1e-6), "IDASetInitStep");
  return follow(ida, times, [](double, const double* y) { return std::vector{y[0]}; });
}

}  // namespace rheonet::hand
