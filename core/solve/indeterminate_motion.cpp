#include "core/solve/indeterminate_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

namespace {

/// Sum of the forces at the nodes of such groups [N], and of the magnitudes of the external ones.
struct GroupBalance { double sum, magnitude; };
GroupBalance balance_of(const Dae& dae, const Structure::IndeterminateGroups& groups) {
  const Dae::View& view = dae.viewed();
  const Network& network = dae.network();
  GroupBalance result{0, 0};
  for (NodeId node : groups.nodes) {
    result.sum += view.nodal[at(node)] - view.applied[at(node)];
    result.magnitude += std::abs(view.applied[at(node)]);
  }
  const auto add = [&](const Branch& b, double f) {
    if (std::find(groups.elements.begin(), groups.elements.end(), b.element) != groups.elements.end()) result.magnitude += std::abs(f);
  };
  for (std::size_t k = 0; k < network.sliders.size(); ++k) add(network.sliders[k].branch, view.slider_force[k]);
  for (std::size_t j = 0; j < network.deflections.size(); ++j) add(network.deflections[j], view.f[j]);
  return result;
}

/// Whether a force applied to such groups changes with time at present.
bool load_changes(const Dae& dae, const Structure::IndeterminateGroups& groups) {
  const auto within = [&](NodeId node) { return std::find(groups.nodes.begin(), groups.nodes.end(), node) != groups.nodes.end(); };
  for (std::size_t k = 0; k < dae.network().forces.size(); ++k) {
    const Network::Force& f = dae.network().forces[k];
    const bool changes = dae.inputs().force_rate[k] != 0 || (f.block >= 0 && dae.inputs().blocks().slopes().couples(f.block));
    if (changes && within(f.a) != within(f.b)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> check_indeterminate_groups(const Dae& dae, double t, const std::function<void()>& overloaded) {
  const Network& network = dae.network();
  std::vector<std::string> notes;
  for (const Structure::IndeterminateGroups& groups : dae.structure().indeterminate) {
    const GroupBalance balance = balance_of(dae, groups);
    if (std::abs(balance.sum) > numerics::constant_balance_roundoff * balance.magnitude || load_changes(dae, groups)) {
      overloaded();
      report_overload(network, t, groups.nodes, groups.elements);
    }
    std::vector<std::string> names;
    for (int e : groups.elements) names.push_back(network.scene->elements[static_cast<std::size_t>(e)].name);
    notes.push_back(fmt::format("{} slip under equal forces with nothing else between them: how they share the motion is "
                                "left open, and the velocities of least norm are taken",
                                format_list(names)));
  }
  return notes;
}

}  // namespace rheonet
