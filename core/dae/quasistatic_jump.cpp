#include "core/dae/quasistatic_jump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/nodal_forces.hpp"
#include "core/dae/overload.hpp"
#include "core/network/adjacent_elements.hpp"

namespace rheonet {

namespace {

[[noreturn]] void report_unbalanced_jump(const EventNetwork& net, double t) {
  std::vector<NodeId> nodes;
  std::vector<std::string> names;
  for (NodeId n = 0; at(n) < net.structure.kind.size(); ++n) {
    if (net.structure.group[at(n)] < 0) continue;
    nodes.push_back(n);
    names.push_back(net.network.node_name(n));
  }
  throw SimulationError(net.network.spot_of_node(nodes.front()), fmt::format(
      "{} the forces at massless node{} {} cannot be balanced: the values of {} may lie too far apart for double precision; check "
      "them, or give the node{} a mass or a dashpot",
      at_time(*net.network.scene, t), names.size() > 1 ? "s" : "", format_list(names), format_list(elements_at(net.network, nodes)),
      names.size() > 1 ? "s" : ""));
}

}  // namespace

std::optional<QuasistaticJumps::Jump> QuasistaticJumps::find(const std::vector<double>& dx, const State& state,
                                                              const std::vector<double>& force, bool along) const {
  bool needed = std::any_of(dx.begin(), dx.end(), [](double d) { return d != 0; });
  if (!needed && structure_.groups.empty()) return std::nullopt;
  const std::size_t nodes = structure_.kind.size();
  const NodalForces now = together(net_, nodal_forces(net_, state, force, false));
  std::vector<double> slack(nodes, 0);
  for (std::size_t n = 0; n < nodes; ++n) slack[at(net_.speaker(static_cast<NodeId>(n)))] += errors_.accepted()[n];
  ConvexNetwork problem(static_cast<int>(nodes));
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto node = static_cast<NodeId>(n);
    if (structure_.group[n] < 0) {
      problem.fix(net_.slot(node), dx[n]);
    } else if (net_.speaker(node) != node) {
      problem.fix(net_.slot(node), 0);
    } else if (const double lacking = now.lacking(n, slack[n]); lacking != 0) {
      problem.load(net_.slot(node), lacking);
      needed = true;
    }
  }
  const auto light = [&](const Branch& b) { return structure_.group[at(b.a)] >= 0 || structure_.group[at(b.b)] >= 0; };
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    needed = needed || (light(b) && std::abs(force[k]) > bounds_.bound(k, force[k] > 0 ? 1 : -1) * (1 + numerics::balance_roundoff));
  }
  if (!needed) return std::nullopt;

  std::vector<double> f(state.p.size()), c(f);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &c[at(laws.first)]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const NodeId a = net_.speaker(network_.deflections[j].a), b = net_.speaker(network_.deflections[j].b);
      if (net_.keep_distance(a, b) || laws.batch->delay(i) > 0) continue;
      const DeflectionBatch& batch = *laws.batch;
      const double p = state.p[j], f0 = f[j];
      if (along) {
        const double slope = batch.slope(i, p, batch.direction(i));
        problem.add(net_.slot(a), net_.slot(b), {.backward = slope, .forward = slope, .rounding = std::max(std::abs(f0), force_of_deflection(batch, i, p))});
        continue;
      }
      problem.add(net_.slot(a), net_.slot(b), {.backward = batch.slope(i, p, -1), .forward = batch.slope(i, p, 1),
                         .rounding = std::max(std::abs(f0), force_of_deflection(batch, i, p)),
                         .beyond = [&batch, i, p, f0](double step, double& slope) {
                           return batch.force_along(i, p, step, slope) - f0;
                         }});
    }
  }
  std::vector<int> slider_branch(network_.sliders.size(), -1);
  for (std::size_t k = 0; k < slider_branch.size(); ++k) {
    const NodeId a = net_.speaker(network_.sliders[k].branch.a), b = net_.speaker(network_.sliders[k].branch.b);
    if (net_.keep_distance(a, b)) continue;
    slider_branch[k] = problem.add(net_.slot(a), net_.slot(b), {.low = -bounds_.bound(k, -1) - force[k], .high = bounds_.bound(k, 1) - force[k]});
  }
  const ConvexNetwork::Outcome outcome = problem.solve();
  return Jump{std::move(problem), outcome, std::move(slider_branch)};
}

double QuasistaticJumps::farthest(const Jump& jump) const {
  double most = 0;
  for (const Branch& b : network_.deflections) {
    most = std::max(most, std::abs(moved(jump, b.a) - moved(jump, b.b)));
  }
  return most;
}

/// True if each deflection changes by no more than a share of itself that may be an error of steps. Laws at their bounds do not count: their
/// forces stay, however far they move.
bool QuasistaticJumps::hardly_moves(const Jump& jump, const State& state) const {
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double step = moved(jump, network_.deflections[j].a) - moved(jump, network_.deflections[j].b);
      if (!laws.batch->constant(i) && std::abs(step) > numerics::step_error_of_balance * std::abs(state.p[j])) return false;
    }
  }
  return true;
}

void QuasistaticJumps::displace(double t, const Jump& jump, State& state) const {
  std::vector<double> distance(state.position.size());
  for (std::size_t n = 0; n < distance.size(); ++n) state.position[n] += distance[n] = moved(jump, static_cast<NodeId>(n));
  inputs_.history().moved(t, distance);
}

/// The share of a jump of massless nodes that leads to the first contact.
double QuasistaticJumps::share_to_contact(const Jump& jump, const State& state) const {
  double share = 1;
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double step = moved(jump, b.a) - moved(jump, b.b);
    const bool goes = network_.sliders[k].contact && step != 0 && network_.contact_of(network_.sliders[k]) * step <= 0 && !inputs_.box(k).rigid();
    if (goes) share = std::min(share, way_to_contact(network_, network_.sliders[k], step, state) / std::abs(step));
  }
  return share;
}

bool QuasistaticJumps::settle_errors(double t, State& state, std::vector<double>& force) const {
  if (structure_.groups.empty()) return false;
  const NodalForces now = together(net_, nodal_forces(net_, state, force, false));
  for (std::size_t n = 0; n < now.sum.size(); ++n) {
    if (structure_.group[n] >= 0 && std::abs(now.sum[n]) > numerics::step_error_of_balance * now.magnitude[n]) return false;
  }
  const std::vector<double> still(structure_.kind.size(), 0);
  const std::optional<Jump> back = find(still, state, force), along = find(still, state, force, true);
  if (!along || along->outcome != ConvexNetwork::Outcome::solved || back->outcome != ConvexNetwork::Outcome::solved) return false;
  if (farthest(*along) > numerics::distant_balance * farthest(*back) && !hardly_moves(*along, state)) return false;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      if (!(laws.batch->delay(i) > 0)) state.p[j] += moved(*along, network_.deflections[j].a) - moved(*along, network_.deflections[j].b);
    }
  }
  for (std::size_t k = 0; k < force.size(); ++k) {
    if (along->slider_branch[k] >= 0) force[k] += along->problem.force(along->slider_branch[k]);
  }
  displace(t, *along, state);
  return true;
}

std::optional<double> QuasistaticJumps::jump(double t, bool stepped, std::vector<double>& dx, State& state, std::vector<double>& force) {
  std::optional<Jump> found = find(dx, state, force);
  if (!found) return std::nullopt;
  const auto& [problem, outcome, slider_branch, share] = *found;
  if (outcome == ConvexNetwork::Outcome::unbounded) report_runaway(net_, bounds_, t, problem.runaways(), state);
  if (outcome != ConvexNetwork::Outcome::solved) report_unbalanced_jump(net_, t);

  found->share = share_to_contact(*found, state);
  for (double& d : dx) d *= 1 - share;
  const auto moved = [&](NodeId node) { return this->moved(*found, node); };
  double stored = 0, work = 0, heat = 0, delayed = 0, slope;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double step = moved(network_.deflections[j].a) - moved(network_.deflections[j].b);
      if (step == 0) continue;
      if (laws.batch->delay(i) > 0) {
        delayed += laws.batch->force_along(i, state.p[j], 0, slope) * step;  // the law does not know of the step yet
        continue;
      }
      stored -= laws.batch->stored_energy(i, state.p[j]);
      heat += laws.batch->jump(i, state.p[j], step);
      state.p[j] += step;
      stored += laws.batch->stored_energy(i, state.p[j]);
    }
  }
  for (std::size_t k = 0; k < slider_branch.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double step = moved(b.a) - moved(b.b);
    if (step != 0 && !network_.sliders[k].contact) heat += inputs_.box(k).at(step > 0 ? 1 : -1).sliding.value * std::abs(step);
    if (slider_branch[k] < 0) continue;
    if (step != 0) bounds_.break_away(k);
    force[k] += share * problem.force(slider_branch[k]);
  }
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& load = network_.forces[k];
    work += inputs_.force[k] * (moved(load.a) - (load.b < 0 ? 0 : moved(load.b)));
  }
  displace(t, *found, state);
  // A step of the inputs does the work that it takes; without a step, lost energy becomes heat.
  return delayed + (stepped ? heat : std::max(0.0, work - stored - delayed));
}

void QuasistaticJumps::refuse_overload(double t, const State& state, const std::vector<double>& force) const {
  const std::optional<Jump> jump = find(std::vector<double>(structure_.kind.size(), 0), state, force);
  if (jump && jump->outcome == ConvexNetwork::Outcome::unbounded) report_runaway(net_, bounds_, t, jump->problem.runaways(), state);
}

}  // namespace rheonet
