#include <algorithm>
#include <cmath>

#include "core/dae/dae.hpp"
#include "core/dae/state_powers.hpp"

namespace rheonet {

/// Sums the forces at each node by itself: sticking sliders carry the remainder.
void Dae::share_among_joined(double t) {
  std::fill(view_.nodal.begin(), view_.nodal.end(), 0.0);
  std::fill(view_.applied.begin(), view_.applied.end(), 0.0);
  const auto add = [&](const Branch& b, double f) {
    view_.nodal[at(b.a)] += f;
    view_.nodal[at(b.b)] -= f;
  };
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) add(network_->deflections[j], view_.f[j]);
  for (std::size_t r = 0; r < index_.force.size(); ++r) add(network_->rates[r], index_.force[r] >= 0 ? rate_in_[r] : rate_out_[r]);
  for (std::size_t k = 0; k < slip_.force().size(); ++k) {
    if (slip_.force()[k] != 0) add(network_->sliders[k].branch, slip_.force()[k]);
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    view_.applied[at(f.a)] += inputs_->force[k];
    if (f.b >= 0) view_.applied[at(f.b)] -= inputs_->force[k];
  }
  std::vector<double>& left = work_;
  for (std::size_t n = 0; n < left.size(); ++n) {
    left[n] = view_.nodal[n] - view_.applied[n] + structure_->own_mass[n] * view_.acceleration[n];
  }
  for (std::size_t k = 0; k < network_->inerters.size(); ++k) {
    const Branch& b = network_->inerters[k].branch;
    left[at(b.a)] += StatePowers(*this).inerter_force(k);
    left[at(b.b)] -= StatePowers(*this).inerter_force(k);
  }
  for (std::size_t k = 0; k < network_->trains.size(); ++k) {
    const Network::Train& train = network_->trains[k];
    for (std::size_t i = 0; i < train.node.size(); ++i) left[at(train.node[i])] += slip_.train_forces()[k][i] * view_.train_force[k];
  }
  stick_forces_.solve(t, left, view_.slider_force, view_.train_force);
  for (std::size_t k = 0; k < slip_.force().size(); ++k) {
    if (structure_->stuck[k]) add(network_->sliders[k].branch, view_.slider_force[k]);
  }
}

const Dae::View& Dae::view(double t, const double* y, const double* yp) {
  evaluate_forces(t, y);
  if (!loose_dashpots_.none()) balance_loose_dashpots();
  view_velocities(yp);
  for (std::size_t n = 0; n < v_.size(); ++n) {
    view_.acceleration[n] = a_[n];
    if (structure_->kind[n] == Kind::massive) {
      view_.acceleration[n] = (view_.applied[n] - view_.nodal[n]) / structure_->mass[n];
    }
  }
  for (const Network::Motion& m : network_->motions) {
    if (m.block >= 0) view_.acceleration[at(m.node)] = sensors_.acceleration(m.node, a_, v_);
  }
  std::fill(view_.train_force.begin(), view_.train_force.end(), 0.0);
  if (inertia_.coupled()) {
    if (slip_.shares_vary()) inertia_.take_train_forces(slip_.train_forces());
    for (std::size_t n = 0; n < v_.size(); ++n) work_[n] = view_.applied[n] - view_.nodal[n];
    inertia_.accelerate(work_, view_.acceleration, view_.train_force);
  }
  inputs_->transmit(view_.train_force);
  if (!stick_forces_.empty()) {
    for (std::size_t n = 0; n < v_.size(); ++n) {
      const std::size_t leader = at(structure_->rigid[n]);
      view_.acceleration[n] = view_.acceleration[leader];
      view_.velocity[n] = view_.velocity[leader];
    }
    share_among_joined(t);
    inputs_->transmit(view_.train_force);
  }
  for (std::size_t k = 0; k < slip_.force().size(); ++k) {
    const Branch& b = structure_->sliders[k];
    view_.slider_velocity[k] = structure_->stuck[k] ? 0 : view_.velocity[at(b.a)] - view_.velocity[at(b.b)];
    if (structure_->stuck[k]) continue;
    view_.slider_force[k] = slip_.force(k, view_.train_force);
  }
  for (std::size_t r = 0; r < index_.force.size(); ++r) {
    view_.rate_velocity[r] = index_.force[r] >= 0 ? rate_out_[r] : rate_in_[r];
    view_.rate_force[r] = index_.force[r] >= 0 ? rate_in_[r] : rate_out_[r];
  }
  places_.evaluate(view_.p, y, view_.position);
  viewed_ = {t, y, yp};
  return view_;
}

void Dae::view_velocities(const double* yp) {
  view_.velocity = v_;
  const auto flow = [&](int j) { return sliding_modes_.moving()[at(j)] * (yp[index_.deflection[at(j)]] + view_.creep[at(j)]); };
  for (const Structure::Group& group : structure_->groups) {
    double base = 0;
    if (group.indeterminate >= 0) {
      const Structure::Loop& sum = structure_->indeterminate[at(group.indeterminate)].velocity;
      for (const Structure::Term& x : sum.flows) base -= x.sign * flow(x.index);
      for (const Structure::Term& x : sum.velocities) base -= x.sign * v_[at(x.index)];
    } else {
      base = view_.velocity[at(group.parent)] - v_[at(group.node)] + group.sign * flow(group.tree_branch);
    }
    for (NodeId node : group.nodes) view_.velocity[at(node)] = base + v_[at(node)];
  }
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    const Branch& b = structure_->deflections[j];
    const bool floating = structure_->group[at(b.a)] >= 0 || structure_->group[at(b.b)] >= 0;
    // The difference of two velocities loses digits where both move fast; the deflection's own rate does not.
    view_.flow[j] = b.a == b.b ? 0 : floating ? flow(static_cast<int>(j)) : v_[at(b.a)] - v_[at(b.b)];
    view_.dp[j] = index_.deflection[j] >= 0 ? yp[index_.deflection[j]] : view_.flow[j];
  }
  for (const DelayHistory::Delayed& d : inputs_->history().delayed()) {
    const Branch& b = structure_->deflections[at(d.branch)];
    view_.flow[at(d.branch)] = view_.velocity[at(b.a)] - view_.velocity[at(b.b)];
  }
}

const std::vector<double>& Dae::slopes() {
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&view_.p[k], &view_.f[k], &df_[k], &view_.creep[k], &dc_[k]);
  }
  return df_;
}

void Dae::balance_loose_dashpots() {
  std::vector<double>& magnitude = work_;
  std::fill(magnitude.begin(), magnitude.end(), 0.0);
  const auto add = [&](const Branch& b, double f) {
    if (b.a == b.b) return;
    magnitude[at(b.a)] += std::abs(f);
    magnitude[at(b.b)] += std::abs(f);
  };
  for (std::size_t j = 0; j < view_.f.size(); ++j) add(structure_->deflections[j], view_.f[j]);
  for (std::size_t r = 0; r < rate_in_.size(); ++r) add(structure_->rates[r], index_.force[r] >= 0 ? rate_in_[r] : rate_out_[r]);
  for (std::size_t k = 0; k < slip_.force().size(); ++k) add(structure_->sliders[k], slip_.force()[k]);
  loose_dashpots_.balance({magnitude, view_.applied, v_}, rate_out_, view_.nodal);
}

}  // namespace rheonet
