// A block on a slider, pulled through a spring whose far end moves steadily: two unknowns, position and velocity of the block;
// a root where it breaks away and where it stops, and a restart at each.

#include <cmath>

#include "tools/bench/hand/hand.hpp"
#include "tools/bench/hand/ida.hpp"

namespace rheonet::hand {
namespace {

constexpr double m = 1, k = 10, coulomb = 1, breakaway = 1.5, speed = 0.1;

struct Mode {
  double slipping = 0;  ///< 1 and -1: in that direction; 0: it sticks
};

double pull(double t, double x) { return k * (speed * t - x); }
double slipping(void* mode) { return static_cast<Mode*>(mode)->slipping; }

int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* mode) {
  const double s = slipping(mode);
  NV_Ith_S(r, 0) = NV_Ith_S(yp, 0) - NV_Ith_S(y, 1);
  NV_Ith_S(r, 1) = s == 0 ? NV_Ith_S(yp, 1) : m * NV_Ith_S(yp, 1) + s * coulomb - pull(t, NV_Ith_S(y, 0));
  return 0;
}

int jacobian(double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void* mode, N_Vector, N_Vector, N_Vector) {
  const bool slips = slipping(mode) != 0;
  SM_ELEMENT_D(J, 0, 0) = cj;
  SM_ELEMENT_D(J, 0, 1) = -1;
  SM_ELEMENT_D(J, 1, 0) = slips ? k : 0;
  SM_ELEMENT_D(J, 1, 1) = slips ? m * cj : cj;
  return 0;
}

int root(double t, N_Vector y, N_Vector, double* g, void* mode) {
  g[0] = slipping(mode) != 0 ? NV_Ith_S(y, 1) : std::abs(pull(t, NV_Ith_S(y, 0))) - breakaway;
  return 0;
}

}  // namespace

Run stick_slip(double tolerance, const std::vector<double>& times) {
  Mode mode;
  Ida ida(2, 0, residual, jacobian, tolerance, 1e-2 * tolerance);
  Ida::check(IDASetUserData(ida.memory, &mode), "IDASetUserData");
  Ida::check(IDARootInit(ida.memory, 1, root), "IDARootInit");
  Run run;
  run.values.push_back(0);
  while (ida.t < times.back()) {
    const int flag = ida.step(times.back());
    ida.take(0, times, run.values);
    if (flag != IDA_ROOT_RETURN) continue;
    ++run.events;
    run.steps += ida.steps();
    const double force = pull(ida.t, ida.Y()[0]);
    const bool goes_on = std::abs(force) > breakaway;
    mode.slipping = mode.slipping == 0 || goes_on ? std::copysign(1, force) : 0;
    if (mode.slipping == 0) ida.Y()[1] = 0;
    ida.P()[0] = ida.Y()[1];
    ida.P()[1] = mode.slipping == 0 ? 0 : (force - mode.slipping * coulomb) / m;
    Ida::check(IDAReInit(ida.memory, ida.t, ida.y, ida.yp), "IDAReInit");
  }
  run.steps += ida.steps();
  return run;
}

}  // namespace rheonet::hand
