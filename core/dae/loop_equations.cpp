#include "core/dae/loop_equations.hpp"

#include <cmath>

#include "core/base/index.hpp"

namespace rheonet {

LoopEquations::LoopEquations(const Network& network, const Structure& structure, const Positions& positions, const Inputs& inputs,
                             const UnknownIndices& index, const std::vector<double>& moving)
    : network_(network), structure_(structure), inputs_(inputs), index_(index), moving_(moving), felt_terms_(inputs.history().delayed().size()) {
  rows_.reserve(structure.closing.size() + positions.integrated.size());
  for (const int branch : structure.closing) add_row(index.deflection[at(branch)], false, closed_loop(network, structure, branch));
  for (const NodeId node : positions.integrated) {
    add_row(index.position[at(node)], true, minus_velocity(structure, node, positions.of[at(node)].parent));
  }
}

LoopEquations::Terms LoopEquations::add_terms(const Structure::Loop& loop) {
  Terms terms{.flow_begin = static_cast<int>(flows_.size()), .flow_end = 0,
              .velocity_begin = static_cast<int>(velocities_.size()), .velocity_end = 0};
  for (const auto& [branch, sign] : loop.flows) flows_.push_back({branch, index_.deflection[at(branch)], sign});
  for (const Structure::Term& term : loop.velocities) {
    // The reference of a group has no velocity of its own.
    if (structure_.kind[at(term.index)] == Kind::known || index_.velocity[at(term.index)] >= 0) velocities_.push_back(term);
  }
  terms.flow_end = static_cast<int>(flows_.size());
  terms.velocity_end = static_cast<int>(velocities_.size());
  return terms;
}

void LoopEquations::add_row(int row, bool position, const Structure::Loop& loop) {
  const Row r{.row = row, .position = position, .terms = add_terms(loop),
              .delayed = position ? -1 : inputs_.history().index_of(loop.branch)};
  if (r.delayed >= 0) {
    const DelayHistory::Delayed& delayed = inputs_.history().delayed()[at(r.delayed)];
    const Branch& b = structure_.deflections[at(loop.branch)];
    Structure::Loop now{.branch = -1, .flows = {}, .velocities = {}};
    if (delayed.free_a) now.velocities.push_back({b.a, -1});
    if (delayed.free_b) now.velocities.push_back({b.b, 1});
    felt_terms_[at(r.delayed)] = add_terms(now);
  }
  rows_.push_back(r);
}

void LoopEquations::reserve(JacobianEntries& jacobian) {
  for (const Row& row : rows_) {
    if (row.position) jacobian.put_mass(row.row, row.row, 1);
    for (int k = row.terms.flow_begin; k < row.terms.flow_end; ++k) {
      const auto [j, unknown, sign] = flows_[at(k)];
      flow_entries_.push_back({jacobian.builder().ticket(row.row, unknown), j, sign});
      std::size_t i = 0;
      if (network_.batch_of(j, i).creeps(i)) creep_entries_.push_back({jacobian.builder().ticket(row.row, unknown), j, sign});
    }
    for (int k = row.terms.velocity_begin; k < row.terms.velocity_end; ++k) {
      jacobian.put(row.row, index_.velocity[at(velocities_[at(k)].index)], velocities_[at(k)].sign);
    }
    if (row.delayed < 0) continue;
    const Terms& now = felt_terms_[at(row.delayed)];
    for (int k = now.velocity_begin; k < now.velocity_end; ++k) {
      const auto [node, sign] = velocities_[at(k)];
      if (index_.velocity[at(node)] >= 0) felt_entries_.push_back({jacobian.builder().ticket(row.row, index_.velocity[at(node)]), row.delayed, sign});
    }
  }
}

void LoopEquations::take(const std::vector<int>& entry) {
  const auto take = [&](auto& list) {
    for (auto& item : list) item.entry = entry[at(item.entry)];
    list = std::vector(list.begin(), list.end());  // without spare capacity
  };
  take(flow_entries_);
  take(creep_entries_);
  take(felt_entries_);
}

double LoopEquations::sum_of(const Terms& terms, const double* v, const double* creep, const double* yp) const {
  double sum = 0;
  for (int k = terms.flow_begin; k < terms.flow_end; ++k) {
    const Flow& flow = flows_[at(k)];
    sum += flow.sign * moving_[at(flow.branch)] * (yp[flow.unknown] + creep[flow.branch]);
  }
  for (const auto& [node, sign] : velocities(terms)) sum += sign * v[node];
  return sum;
}

void LoopEquations::residual(const std::vector<double>& v, const std::vector<double>& creep, const double* yp, double* r) const {
  for (const Row& row : rows_) {
    r[row.row] = sum_of(row.terms, v.data(), creep.data(), yp);
    if (row.position) r[row.row] += yp[row.row];
    if (row.delayed < 0) continue;
    const double now = inputs_.felt_now[at(row.delayed)];
    r[row.row] += (now == 0 ? 0 : now * sum_of(felt_terms_[at(row.delayed)], v.data(), creep.data(), yp)) - inputs_.felt[at(row.delayed)];
  }
}

void LoopEquations::add_magnitudes(const std::vector<double>& v, double* r) const {
  for_each_velocity([&](int row, NodeId node, double sign) { r[row] += std::abs(sign * v[at(node)]); });
}

void LoopEquations::add_jacobian(const std::vector<double>& creep_slope, double* values) const {
  for (const FlowEntry& f : creep_entries_) values[f.entry] += f.sign * moving_[at(f.branch)] * creep_slope[at(f.branch)];
  for (const FeltEntry& f : felt_entries_) values[f.entry] += f.sign * inputs_.felt_now[at(f.delayed)];
}

void LoopEquations::add_time_derivative(const std::vector<double>& a, const std::vector<char>& differential, double* r) const {
  for_each_velocity([&](int row, NodeId node, double sign) {
    if (!differential[at(row)]) r[row] += sign * a[at(node)];
  });
}

}  // namespace rheonet
