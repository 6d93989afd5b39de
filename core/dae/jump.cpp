#include <fmt/format.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/dae/convex.hpp"
#include "core/dae/instant.hpp"

namespace rheonet {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Forces that balance but for this share of their magnitudes balance.
constexpr double balance_rounding = 1e-12;

}  // namespace

/// Within an instant a linear dashpot turns a step into the impulse B dx; masses stay where they are; massless nodes
/// between dashpots go where the impulses balance, sum B (dx_a - dx_b) = 0. Laws that know no impulse do not resist.
void Instant::position_steps(double t, std::vector<double>& dx, State& state, std::vector<std::string>& notes) const {
  const Network& network = network_;
  const Structure& structure = structure_;
  bool any = false;
  for (std::size_t m = 0; m < network.motions.size(); ++m) {
    dx[at(network.motions[m].node)] = drive_.steps()[m];
    any = any || drive_.steps()[m] != 0;
  }
  if (!any || network.rates.empty()) return;

  std::vector<double> damping(network.rates.size());
  double largest = 0;
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      damping[at(laws.first) + i] = laws.batch->impulse(i);
      if (std::isfinite(laws.batch->impulse(i))) largest = std::max(largest, laws.batch->impulse(i));
    }
  }
  if (largest == 0) largest = 1;
  for (double& b : damping) {  // shear thickening is rigid to a step, shear thinning no resistance
    if (!std::isfinite(b)) b = 1e9 * largest;
    if (b == 0) b = 1e-9 * largest;
  }

  std::vector<int> unknown(structure.kind.size(), -1);
  int n = 0;
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    if (structure.kind[k] == Kind::viscous) unknown[k] = n++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n);
  for (std::size_t r = 0; r < network.rates.size(); ++r) {
    const Branch& b = network.rates[r];
    const double B = damping[r];
    for (const auto& [node, other] : {std::pair{b.a, b.b}, std::pair{b.b, b.a}}) {
      const int row = unknown[at(node)];
      if (row < 0) continue;
      entries.emplace_back(row, row, B);
      if (unknown[at(other)] >= 0) {
        entries.emplace_back(row, unknown[at(other)], -B);
      } else {
        rhs[row] += B * dx[at(other)];
      }
    }
  }
  if (n > 0) {
    Eigen::SparseMatrix<double> laplacian(n, n);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(laplacian).solve(rhs);
    for (std::size_t k = 0; k < unknown.size(); ++k) {
      if (unknown[k] >= 0) dx[k] = x[unknown[k]];
    }
  }
  for (std::size_t r = 0; r < network.rates.size(); ++r) {
    const Branch& b = network.rates[r];
    const double step = dx[at(b.a)] - dx[at(b.b)];
    if (std::abs(step) <= 1e-12 * (std::abs(dx[at(b.a)]) + std::abs(dx[at(b.b)]))) continue;
    if (structure.kind[at(b.a)] == Kind::massive) state.velocity[at(b.a)] -= damping[r] * step / structure.mass[at(b.a)];
    if (structure.kind[at(b.b)] == Kind::massive) state.velocity[at(b.b)] += damping[r] * step / structure.mass[at(b.b)];
    notes.push_back(fmt::format(
        "{} a step in position moves dashpot `{}` by {:.6g} in no time: its force there is an impulse, which "
        "no row shows and the energy account leaves out",
        at_time(*network.scene, t), network.name_of(b), step));
  }
}

// Within an instant forces stay finite: masses keep their places, dashpots with them, and what has neither goes where the
// forces balance, along the laws' own curves and against the friction of the sliders.
bool Instant::jump(double t, bool stepped, const std::vector<double>& dx, State& state, std::vector<double>& force,
                   Change& change) {
  const std::size_t nodes = structure_.kind.size();
  drive_.evaluate(t);
  // The nodes of a group move as one: its dashpots take no impulse.
  const auto node_of = [&](NodeId node) {
    const int g = structure_.group[at(node)];
    return g < 0 ? node : structure_.groups[at(g)].nodes.front();
  };
  const Nodal now = nodal(state, force, false);
  std::vector<double> sum(nodes, 0), magnitude(nodes, 0);
  for (std::size_t n = 0; n < nodes; ++n) {
    sum[at(node_of(static_cast<NodeId>(n)))] += now.sum[n];
    magnitude[at(node_of(static_cast<NodeId>(n)))] += now.magnitude[n];
  }
  bool needed = std::any_of(dx.begin(), dx.end(), [](double d) { return d != 0; });
  ConvexNetwork problem(static_cast<int>(nodes));
  for (std::size_t n = 0; n < nodes; ++n) {
    if (structure_.group[n] < 0) {
      problem.fix(slot(static_cast<NodeId>(n)), dx[n]);
    } else if (node_of(static_cast<NodeId>(n)) != static_cast<NodeId>(n)) {
      problem.fix(slot(static_cast<NodeId>(n)), 0);  // spoken for by its group's first
    } else if (std::abs(sum[n]) > balance_rounding * magnitude[n]) {
      problem.load(slot(static_cast<NodeId>(n)), -sum[n]);
      needed = true;
    }
  }
  const auto light = [&](const Branch& b) { return structure_.group[at(b.a)] >= 0 || structure_.group[at(b.b)] >= 0; };
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    needed = needed || (light(b) && std::abs(force[k]) > bound(k) * (1 + balance_rounding));
  }
  if (!needed) return false;

  std::vector<double> f(state.p.size()), c(f);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &c[at(laws.first)]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const NodeId a = node_of(network_.deflections[j].a), b = node_of(network_.deflections[j].b);
      if (a == b || (structure_.group[at(a)] < 0 && structure_.group[at(b)] < 0)) continue;
      const DeflectionBatch& batch = *laws.batch;
      const double p = state.p[j], f0 = f[j];
      problem.add(slot(a), slot(b), {.backward = batch.slope(i, p, -1), .forward = batch.slope(i, p, 1), .rounding = std::abs(f0),
                         .beyond = [&batch, i, p, f0](double step, double& slope) {
                           return batch.force_along(i, p, step, slope) - f0;
                         }});
    }
  }
  std::vector<int> slider_branch(network_.sliders.size(), -1);
  for (std::size_t k = 0; k < slider_branch.size(); ++k) {
    const NodeId a = node_of(network_.sliders[k].branch.a), b = node_of(network_.sliders[k].branch.b);
    if (a == b || (structure_.group[at(a)] < 0 && structure_.group[at(b)] < 0)) continue;
    slider_branch[k] = problem.add(slot(a), slot(b), {.low = -bound(k) - force[k], .high = bound(k) - force[k]});
  }
  if (const ConvexNetwork::Outcome outcome = problem.solve(); outcome != ConvexNetwork::Outcome::solved) {
    if (outcome == ConvexNetwork::Outcome::unbounded) report_runaway(t, problem.runaways());
    throw SimulationError(at_time(*network_.scene, t) + " the forces at the massless nodes cannot be balanced");
  }

  const auto moved = [&](NodeId node) { return problem.value(slot(node_of(node))); };
  double stored = 0, work = 0, heat = 0;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double step = moved(network_.deflections[j].a) - moved(network_.deflections[j].b);
      if (step == 0) continue;
      stored -= laws.batch->stored_energy(i, state.p[j]);
      heat += laws.batch->jump(i, state.p[j], step);
      state.p[j] += step;
      stored += laws.batch->stored_energy(i, state.p[j]);
    }
  }
  for (std::size_t k = 0; k < slider_branch.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double step = moved(b.a) - moved(b.b);
    heat += network_.sliders[k].law.coulomb * std::abs(step);
    if (slider_branch[k] < 0) continue;
    if (step != 0) broken_[k] = 1;
    force[k] += problem.force(slider_branch[k]);
  }
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& load = network_.forces[k];
    work += drive_.force[k] * (moved(load.a) - (load.b < 0 ? 0 : moved(load.b)));
  }
  // A step of the drive does what work it takes; without one, what is lost becomes heat.
  change.heat += stepped ? heat : std::max(0.0, work - stored);
  for (std::size_t n = 0; n < nodes; ++n) state.position[n] += moved(static_cast<NodeId>(n));
  return true;
}

}  // namespace rheonet
