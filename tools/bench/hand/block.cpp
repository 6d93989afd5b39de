// A block on a slider, pulled through a spring whose far end moves steadily: two unknowns, position and velocity of the block;
// a root where it breaks away and where it stops, and a restart at each.

#include <cmath>

#include "tools/bench/hand/ida.hpp"

namespace rheonet::hand {
namespace {

struct Motion {
  const Block& is;
  double friction = 0;  ///< 1 and -1: it slips in that direction; 0: it sticks, or nothing rubs

  double spring(double t, double x) const { return is.stiffness * (is.speed * t - x); }
  double pull(double t, double x) const { return spring(t, x) + (is.force != 0 ? is.force * std::sin(is.omega * t) : 0); }
  bool moves() const { return friction != 0 || is.coulomb == 0; }
};

const Motion& of(void* motion) { return *static_cast<Motion*>(motion); }

int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* data) {
  const Motion& m = of(data);
  NV_Ith_S(r, 0) = NV_Ith_S(yp, 0) - NV_Ith_S(y, 1);
  NV_Ith_S(r, 1) = m.moves() ? m.is.mass * NV_Ith_S(yp, 1) + m.friction * m.is.coulomb - m.pull(t, NV_Ith_S(y, 0)) : NV_Ith_S(yp, 1);
  return 0;
}

int jacobian(double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
  const Motion& m = of(data);
  SM_ELEMENT_D(J, 0, 0) = cj;
  SM_ELEMENT_D(J, 0, 1) = -1;
  SM_ELEMENT_D(J, 1, 0) = m.moves() ? m.is.stiffness : 0;
  SM_ELEMENT_D(J, 1, 1) = m.moves() ? m.is.mass * cj : cj;
  return 0;
}

int root(double t, N_Vector y, N_Vector, double* g, void* data) {
  const Motion& m = of(data);
  g[0] = m.moves() ? NV_Ith_S(y, 1) : std::abs(m.pull(t, NV_Ith_S(y, 0))) - m.is.breakaway;
  return 0;
}

/// At a root, or at rest at the start: what it does from there on.
void begin(Ida& ida, Motion& m) {
  const double force = m.pull(ida.t, ida.Y()[0]);
  const bool stuck = ida.t > 0 && m.friction == 0;  // a root was the end of that
  const bool slips = stuck || std::abs(force) > m.is.breakaway;
  m.friction = slips && m.is.coulomb > 0 ? std::copysign(1, force) : 0;
  if (m.friction == 0) ida.Y()[1] = 0;
  ida.P()[0] = ida.Y()[1];
  ida.P()[1] = m.moves() ? (force - m.friction * m.is.coulomb) / m.is.mass : 0;
  Ida::check(IDAReInit(ida.memory, ida.t, ida.y, ida.yp), "IDAReInit");
}

}  // namespace

Run block(const Block& scene, double tolerance, const std::vector<double>& times) {
  Motion motion{scene};
  Ida ida(2, 0, residual, jacobian, tolerance, 1e-2 * tolerance);
  Ida::check(IDASetUserData(ida.memory, &motion), "IDASetUserData");
  if (scene.coulomb > 0) Ida::check(IDARootInit(ida.memory, 1, root), "IDARootInit");
  ida.Y()[0] = scene.position;
  begin(ida, motion);
  const auto row = [&](double t, const double* y) { return std::vector{y[0], y[1], motion.spring(t, y[0])}; };
  return follow(ida, times, row, [&] { begin(ida, motion); });
}

Run stick_slip(double tolerance, const std::vector<double>& times) {
  return block({.mass = 1, .stiffness = 10, .speed = 0.1, .coulomb = 1, .breakaway = 1.5}, tolerance, times);
}

}  // namespace rheonet::hand
