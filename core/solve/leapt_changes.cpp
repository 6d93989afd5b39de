#include "core/solve/leapt_changes.hpp"

#include <cmath>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/network/error.hpp"

namespace rheonet {

namespace {

/// Whether the equations have other rates at one of these times than the last step.
bool leaps(System& system, const Tolerances& tolerances, const std::vector<double>& times) {
  const Integrator& integrator = system.integrator;
  Dae& dae = system.dae;
  const double end = integrator.time(), length = end - integrator.previous_time();
  std::vector<double> y, yp, rates;
  bool differ = false;
  for (std::size_t k = 0; k < times.size() && !differ; ++k) {
    integrator.interpolate(times[k], 0, y);
    integrator.interpolate(times[k], 1, yp);
    try {
      system.consistency.derivative(times[k], y, rates);
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

bool LeapsOverChanges::repeat(System& system, const Tolerances& tolerances, const std::vector<double>& times) {
  if (times.empty() || repeats_ == numerics::leapt_repeats || !leaps(system, tolerances, times)) return false;
  ++repeats_;
  until_ = system.integrator.time();
  return true;
}

bool LeapsOverChanges::repeat_to_event(System& system, const Tolerances& tolerances) {
  const double end = system.integrator.time(), length = end - system.integrator.previous_time();
  if (!system.dae.inputs().blocks().has_functions() || system.integrator.exact() || !(length > time_roundoff(end))) return false;
  std::vector<double> times;
  for (int part = 2; part <= numerics::leapt_parts; part *= 2) times.push_back(end - length / part);
  return repeat(system, tolerances, times);
}

bool LeapsOverChanges::passed(double t, bool event) {
  if (repeats_ == 0 || !(event || t > until_)) return false;
  repeats_ = 0;
  return true;
}

}  // namespace rheonet
