#include <algorithm>
#include <cmath>

#include "core/base/numerics.hpp"
#include "core/dae/dae.hpp"
#include "core/dae/rate_law.hpp"

namespace rheonet {

namespace {

/// Largest force of the laws that are held at rest between these ends [N].
double held_force(const Structure& structure, const std::vector<double>& moving, const std::vector<double>& f, const Branch& ends) {
  double largest = 0;
  for (std::size_t j = 0; j < moving.size(); ++j) {
    const Branch& b = structure.deflections[j];
    if (moving[j] == 0 && std::minmax(b.a, b.b) == std::minmax(ends.a, ends.b)) largest = std::max(largest, std::abs(f[j]));
  }
  return largest;
}

}  // namespace

/// Gathers velocities, deflections, and the arguments of the rate laws.
void Dae::gather(double t, const double* y) {
  viewed_ = {};
  inputs_->evaluate(t);
  for (std::size_t n = 0; n < v_.size(); ++n) {
    if (index_.velocity[n] >= 0) v_[n] = y[index_.velocity[n]];
  }
  if (inputs_->moves_by_blocks()) sensors_.move_nodes(y);
  for (std::size_t m = 0; m < network_->motions.size(); ++m) {
    const std::size_t node = at(network_->motions[m].node);
    v_[node] = inputs_->velocity[m];
    a_[node] = inputs_->acceleration[m];
  }
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    view_.p[j] = index_.deflection[j] >= 0 ? y[index_.deflection[j]] : driven_.deflection(j, t);
  }
  for (std::size_t r = 0; r < index_.force.size(); ++r) {
    const Branch& b = structure_->rates[r];
    rate_in_[r] = index_.force[r] >= 0 ? y[index_.force[r]] : v_[at(b.a)] - v_[at(b.b)];
  }
  if (inputs_->blocks().any()) sensors_.feel(y, {v_, view_.p, rate_in_});
  slip_.follow();
}

/// Sums the forces of the branches and the applied forces, at the nodes that represent joined ones.
void Dae::sum_forces() {
  std::fill(view_.nodal.begin(), view_.nodal.end(), 0.0);
  std::fill(view_.applied.begin(), view_.applied.end(), 0.0);
  const auto add = [&](const Branch& b, double f) {
    if (b.a == b.b) return;
    view_.nodal[at(b.a)] += f;
    view_.nodal[at(b.b)] -= f;
  };
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) add(structure_->deflections[j], view_.f[j]);
  for (std::size_t r = 0; r < index_.force.size(); ++r) add(structure_->rates[r], index_.force[r] >= 0 ? rate_in_[r] : rate_out_[r]);
  for (std::size_t k = 0; k < slip_.force().size(); ++k) {
    if (slip_.force()[k] != 0) add(structure_->sliders[k], slip_.force()[k]);
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    view_.applied[at(structure_->rigid[at(f.a)])] += inputs_->force[k];
    if (f.b >= 0) view_.applied[at(structure_->rigid[at(f.b)])] -= inputs_->force[k];
  }
}

void Dae::evaluate_forces(double t, const double* y) {
  gather(t, y);
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->evaluate(&view_.p[k], &view_.f[k], &view_.creep[k]);
  }
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->evaluate(&rate_in_[k], &rate_out_[k]);
  }
  sum_forces();
}

/// The balance of forces in the row of each velocity.
void Dae::balances(const double* yp, double* r) const {
  for (std::size_t n = 0; n < index_.velocity.size(); ++n) {
    if (index_.velocity[n] >= 0) r[index_.velocity[n]] = view_.nodal[n] - view_.applied[n] + structure_->mass[n] * yp[index_.velocity[n]];
  }
  for (std::size_t k = 0; k < structure_->inerters.size(); ++k) {
    const Branch& b = structure_->inerters[k];
    if (b.a == b.b) continue;
    const auto acceleration = [&](NodeId node) { return index_.velocity[at(node)] >= 0 ? yp[index_.velocity[at(node)]] : sensors_.acceleration(node, a_, v_); };
    const double f = network_->inerters[k].inertance * (acceleration(b.a) - acceleration(b.b));
    if (index_.velocity[at(b.a)] >= 0) r[index_.velocity[at(b.a)]] += f;
    if (index_.velocity[at(b.b)] >= 0) r[index_.velocity[at(b.b)]] -= f;
  }
}

void Dae::residual(double t, const double* y, const double* yp, double* r) {
  evaluate_forces(t, y);

  if (idle()) r[0] = yp[0];
  balances(yp, r);
  for (const Structure::Group& group : structure_->groups) {
    double sum = 0;
    for (NodeId node : group.nodes) sum += view_.nodal[at(node)] - view_.applied[at(node)];
    if (const int row = index_.group_balance[at(group.nodes.front())]; row >= 0) r[row] = sum;
  }
  for (std::size_t k = 0; k < index_.force.size(); ++k) {
    const Branch& b = structure_->rates[k];
    if (index_.force[k] >= 0) r[index_.force[k]] = v_[at(b.a)] - v_[at(b.b)] - rate_out_[k];
  }
  loops_.residual(v_, view_.creep, yp, r);
  for (std::size_t k = 0; k < index_.block.size(); ++k) r[index_.block[k]] = yp[index_.block[k]] - inputs_->blocks().rate(k);
  for (const Structure::TrainEquation& equation : slip_.equations()) {
    double& row = r[index_.velocity[at(equation.pivot)]];
    double sum = v_[at(equation.pivot)];
    for (const auto& [node, factor] : equation.terms) sum += factor * v_[at(node)];
    for (const auto& [node, share] : equation.shares) r[index_.velocity[at(node)]] -= share * row;
    row = sum;
  }
  sliding_modes_.residual(view_.p, yp, r);
}

void Dae::magnitudes(double* r) const {
  std::fill(r, r + size(), 0.0);
  const auto add = [&](NodeId node, double x) {
    for (int row : {index_.velocity[at(node)], index_.group_balance[at(node)]}) {
      if (row >= 0) r[row] += std::abs(x);
    }
  };
  // A branch whose ends are joined is in no balance: its terms, which may be far larger, would hide imbalances.
  const auto add_branch = [&](const Branch& b, double f) {
    if (b.a == b.b) return;
    add(b.a, f);
    add(b.b, f);
  };
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    // Friction that has slid far and reversed has a small force at a large deflection.
    add_branch(structure_->deflections[j], std::max(std::abs(view_.f[j]), numerics::deflection_force_share * std::abs(df_[j] * view_.p[j])));
  }
  for (std::size_t k = 0; k < index_.force.size(); ++k) {
    const Branch& b = structure_->rates[k];
    // The difference of two velocities has the round-off of each.
    const double speed = std::abs(v_[at(b.a)]) + std::abs(v_[at(b.b)]);
    add_branch(b, index_.force[k] >= 0 ? rate_in_[k] : std::abs(rate_out_[k]) + rate_d_[k] * speed);
    if (index_.force[k] >= 0) r[index_.force[k]] = std::abs(v_[at(b.a)]) + std::abs(v_[at(b.b)]) + std::abs(rate_out_[k]);
  }
  for (std::size_t k = 0; k < slip_.force().size(); ++k) add_branch(structure_->sliders[k], slip_.force()[k]);
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    add(structure_->rigid[at(f.a)], inputs_->force[k]);
    if (f.b >= 0) add(structure_->rigid[at(f.b)], inputs_->force[k]);
  }
  // The round-off of a force changes a velocity. Near f = 0 the velocity of a dilatant law changes without bound, the velocity
  // of a pseudoplastic law by a large share of itself.
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t k = at(laws.first) + i;
      if (index_.force[k] < 0) continue;
      const Branch& b = structure_->rates[k];
      double forces = 0;
      for (const NodeId n : {b.a, b.b}) {
        for (int row : {index_.velocity[at(n)], index_.group_balance[at(n)]}) {
          if (row >= 0) forces = std::max(forces, r[row]);
        }
      }
      const double f = std::abs(rate_in_[k]), lost = numerics::equation_roundoff * forces;
      r[index_.force[k]] += (laws.batch->velocity_at(i, f + lost) - laws.batch->velocity_at(i, f)) / numerics::equation_roundoff;
    }
  }
  loops_.add_magnitudes(v_, r);
  for (const Structure::TrainEquation& equation : structure_->train_equations) {
    double& row = r[index_.velocity[at(equation.pivot)]];
    row = std::abs(v_[at(equation.pivot)]);
    for (const auto& [node, factor] : equation.terms) row += std::abs(factor * v_[at(node)]);
  }
}

void Dae::jacobian(double t, double cj, const double* y, const double* yp, double* values) {
  gather(t, y);
  slopes();
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&rate_in_[k], &rate_out_[k], &rate_d_[k]);
  }
  stiffen_resting_laws();
  std::fill_n(values, pattern().entries(), 0.0);
  jacobian_.add_constants(values);
  for_each_mass([&](int entry, double mass) { values[entry] += cj * mass; });
  jacobian_.add_slopes(df_, rate_d_, values);
  loops_.add_jacobian(dc_, values);
  blocks_.add({df_, rate_d_}, values);
  pivots_.tie(values);
  if (yp && blocks_.any_shares()) {
    sum_forces();
    std::vector<double> balance(at(size()));
    balances(yp, balance.data());
    blocks_.add_shares({df_, rate_d_}, balance, values);
  }
  sliding_modes_.jacobian(cj, view_.p, yp, values, false);
}

/// A power law other than Newton's has slope 0 at rest, where its equation has no solution to first order. A secant up to the
/// forces now acting takes its place: with it Newton's iteration leaves rest. The same holds for a law that is solved for its force beside
/// one that is held at rest, as nothing else determines that force. Its secant goes up to the round-off of the held force.
void Dae::stiffen_resting_laws() {
  double scale = -1;
  Inputs::Reach reach;
  const std::vector<double>& moving = sliding_modes_.moving();
  const bool any_held = std::find(moving.begin(), moving.end(), 0.0) != moving.end();
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      if (secants_ && rate_in_[r] != 0) rate_d_[r] = std::max(rate_d_[r], rate_out_[r] / rate_in_[r]);
      if (any_held && index_.force[r] >= 0 && rate_in_[r] != 0) {
        const double lost = numerics::equation_roundoff * held_force(*structure_, moving, view_.f, structure_->rates[r]);
        if (std::abs(rate_in_[r]) < lost) rate_d_[r] = std::max(rate_d_[r], laws.batch->velocity_at(i, lost) / lost);
      }
      if (rate_d_[r] != 0) continue;
      // A force that has reached its limit: its own secant will do.
      if (rate_in_[r] != 0 && rate_out_[r] != 0) rate_d_[r] = rate_out_[r] / rate_in_[r];
      if (rate_d_[r] != 0) continue;
      if (scale < 0) {
        sum_forces();
        for (std::size_t n = 1; n < v_.size(); ++n) {
          scale = std::max({scale, std::abs(view_.nodal[n]), std::abs(view_.applied[n])});
        }
        reach = coming_reach(*inputs_, v_);
      }
      const double f = scale > 0 ? scale : coming_force(*laws.batch, i, reach), w = laws.batch->velocity_at(i, f);
      rate_d_[r] = index_.force[r] >= 0 ? w / f : f / w;
    }
  }
}

void Dae::guess_forces(double t, double* y) {
  gather(t, y);
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const Branch& b = structure_->rates[r];
      if (index_.force[r] >= 0) y[index_.force[r]] = laws.batch->force_at(i, v_[at(b.a)] - v_[at(b.b)]);
    }
  }
}

void Dae::consistency_matrix(double t, const double* y, double* values) {
  jacobian(t, 0, y, nullptr, values);
  for (std::size_t e = 0; e < pattern().row.size(); ++e) {
    if (differential_[at(pattern().row[e])]) values[e] = 0;
  }
  for_each_mass([&](int entry, double mass) { values[entry] += mass; });
  sliding_modes_.jacobian(0, view_.p, nullptr, values, true);
}

void Dae::time_derivative(double* r) const {
  std::fill(r, r + size(), 0.0);
  const auto add = [&](NodeId node, double x) {
    if (node < 0) return;
    node = structure_->rigid[at(node)];
    if (index_.velocity[at(node)] >= 0 && !differential_[at(index_.velocity[at(node)])]) r[index_.velocity[at(node)]] += x;
    if (const int row = index_.group_balance[at(node)]; row >= 0) r[row] += x;
  };
  for (std::size_t k = 0; k < index_.force.size(); ++k) {
    const Branch& b = structure_->rates[k];
    const double dw = a_[at(b.a)] - a_[at(b.b)];
    if (index_.force[k] >= 0) {
      r[index_.force[k]] += dw;
    } else if (dw != 0) {
      add(b.a, rate_d_[k] * dw);
      add(b.b, -rate_d_[k] * dw);
    }
  }
  loops_.add_time_derivative(a_, differential_, r);
  for (const std::size_t k : slip_.varying()) {
    const double rate = slip_.side(k) * inputs_->box(k).at(slip_.side(k)).sliding.derivative;
    add(structure_->sliders[k].a, rate);
    add(structure_->sliders[k].b, -rate);
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    add(network_->forces[k].a, -inputs_->force_rate[k]);
    add(network_->forces[k].b, inputs_->force_rate[k]);
  }
  for (const Structure::TrainEquation& equation : structure_->train_equations) {
    double& row = r[index_.velocity[at(equation.pivot)]];
    row = 0;
    for (const auto& [node, factor] : equation.terms) row += factor * a_[at(node)];
  }
}

}  // namespace rheonet
