#include "core/solve/leapt_law.hpp"

#include <cmath>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/network/error.hpp"

namespace rheonet {

namespace {

bool leaps(System& system, const Tolerances& tolerances) {
  const Integrator& integrator = system.integrator;
  Dae& dae = system.dae;
  const double end = integrator.time(), length = end - integrator.previous_time();
  if (!dae.inputs().blocks().has_functions() || integrator.exact() || !(length > time_roundoff(end))) return false;
  std::vector<double> y, yp, rates;
  bool differ = false;
  for (int part = 2; part <= numerics::leapt_parts && !differ; part *= 2) {
    const double t = end - length / part;
    integrator.interpolate(t, 0, y);
    integrator.interpolate(t, 1, yp);
    try {
      system.consistency.derivative(t, y, rates);
    } catch (const SimulationError&) {  // the polynomial leaves the domain of a law there: nothing can be said
      break;
    }
    for (std::size_t i = 0; i < rates.size(); ++i) {
      differ = differ || (dae.differential(static_cast<int>(i)) && std::abs(rates[i] - yp[i]) * length > numerics::leapt_change * tolerances.values()[i]);
    }
  }
  dae.view(end, integrator.y().data(), integrator.yp().data());
  return differ;
}

}  // namespace

bool LeapsOverLaws::repeat(System& system, const Tolerances& tolerances) {
  if (repeats_ == numerics::leapt_repeats || !leaps(system, tolerances)) return false;
  ++repeats_;
  until_ = system.integrator.time();
  return true;
}

bool LeapsOverLaws::passed(double t, bool event) {
  if (repeats_ == 0 || !(event || t > until_)) return false;
  repeats_ = 0;
  return true;
}

}  // namespace rheonet
