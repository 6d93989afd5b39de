#include "core/solve/failure_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/dae/unknown_names.hpp"

namespace rheonet {

namespace {

/// The unknown with the largest error estimate; if there is no estimate yet, the one that changes fastest. -1 if there is no
/// unknown.
int at_fault(const System& system, const std::vector<double>& tolerance) {
  if (const int worst = system.integrator.worst_unknown(); worst >= 0) return worst;
  int fastest = -1;
  double most = -1;
  for (int i = 0; i < system.dae.unknowns(); ++i) {
    const double rate = std::abs(system.integrator.yp()[at(i)]) / tolerance[at(i)];
    if (!(rate > most || std::isnan(rate))) continue;
    fastest = i;
    most = std::isnan(rate) ? std::numeric_limits<double>::infinity() : rate;
  }
  return fastest;
}

/// The names of all elements, for a network whose whole motion is prescribed.
std::string all_of(const Network& network) {
  std::vector<std::string> names;
  for (const SceneElement& e : network.scene->elements) names.push_back(e.name);
  return format_list(names);
}

}  // namespace

void report_failure(const System& system, const std::vector<double>& tolerance, Integrator::Outcome outcome) {
  const Network& network = system.dae.network();
  const int unknown = at_fault(system, tolerance);
  const Spot where = unknown < 0 ? network.spot_of(0) : UnknownNames(system.dae).spot_of(unknown);
  throw SimulationError(where, fmt::format(
      "{} {} {}; check the values of {}, or ask for a looser accuracy", at_time(*network.scene, system.integrator.time()),
      unknown < 0 ? "what the motions make of " + all_of(network) : UnknownNames(system.dae).describe(unknown),
      outcome == Integrator::Outcome::singular ? "is not determined by the forces around it"
                                               : "changes faster than double precision can follow at this accuracy",
      unknown < 0 ? "these" : UnknownNames(system.dae).around(unknown)));
}

}  // namespace rheonet
