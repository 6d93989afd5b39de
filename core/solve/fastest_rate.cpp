#include "core/solve/fastest_rate.hpp"

#include "core/network/error.hpp"

namespace rheonet {

double fastest_rate(const Dae& dae, Consistency& consistency, double t, double horizon, const Motion& motion, double ahead) {
  if (!dae.rough()) return consistency.fastest_rate(t, horizon, motion.y, motion.yp);
  std::vector<double> y = motion.y, yp(y.size());
  // Where the drive starts from rest nothing has changed yet to first order.
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += ahead * (motion.yp[i] + ahead / 2 * motion.ypp[i]);
  try {
    consistency.project(t + ahead, y);
    consistency.derivative(t + ahead, y, yp);
    return consistency.fastest_rate(t + ahead, horizon, y, yp);
  } catch (const SimulationError&) {  // no state of the network: it was a guess
    return consistency.fastest_rate(t, horizon, motion.y, motion.yp);
  }
}

}  // namespace rheonet
