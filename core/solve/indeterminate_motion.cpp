#include "core/solve/indeterminate_motion.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/format_list.hpp"
#include "core/base/numerics.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

std::vector<std::string> check_ties(const Dae& dae, double t, const std::function<void()>& overloaded) {
  const Network& network = dae.network();
  std::vector<std::string> notes;
  for (const Structure::Tie& tie : dae.structure().ties) {
    const Dae::Balance balance = dae.balance(tie);
    if (std::abs(balance.sum) > numerics::constant_balance_roundoff * balance.magnitude || dae.load_changes(tie)) {
      overloaded();
      report_overload(network, t, tie.nodes, tie.elements);
    }
    std::vector<std::string> names;
    for (int e : tie.elements) names.push_back(network.scene->elements[static_cast<std::size_t>(e)].name);
    notes.push_back(fmt::format("{} slip under equal forces with nothing else between them: how they share the motion is "
                                "left open, and the velocities of least norm are taken",
                                format_list(names)));
  }
  return notes;
}

}  // namespace rheonet
