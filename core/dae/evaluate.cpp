#include <algorithm>
#include <cmath>

#include "core/dae/dae.hpp"
#include "core/dae/rate_law.hpp"

namespace rheonet {

double Dae::known_position(NodeId node) const {
  const int motion = structure_->motion[at(node)];
  return motion < 0 ? 0 : drive_->position[at(motion)];
}

/// Velocities, deflections, and what the rate laws are evaluated with.
void Dae::gather(double t, const double* y) {
  drive_->evaluate(t);
  for (std::size_t n = 0; n < v_.size(); ++n) {
    if (iv_[n] >= 0) v_[n] = y[iv_[n]];
  }
  for (std::size_t m = 0; m < network_->motions.size(); ++m) {
    const std::size_t node = at(network_->motions[m].node);
    v_[node] = drive_->velocity[m];
    a_[node] = drive_->acceleration[m];
  }
  for (std::size_t j = 0; j < ip_.size(); ++j) {
    const Branch& b = structure_->deflections[j];
    view_.p[j] = ip_[j] >= 0 ? y[ip_[j]] : known_position(b.a) - known_position(b.b) - drive_offset_[j];
  }
  for (std::size_t r = 0; r < if_.size(); ++r) {
    const Branch& b = structure_->rates[r];
    rate_in_[r] = if_[r] >= 0 ? y[if_[r]] : v_[at(b.a)] - v_[at(b.b)];
  }
}

/// Sums, at the nodes that stand for others, of the forces of the branches and of the applied forces.
void Dae::sum_forces() {
  std::fill(view_.nodal.begin(), view_.nodal.end(), 0.0);
  std::fill(view_.applied.begin(), view_.applied.end(), 0.0);
  const auto add = [&](const Branch& b, double f) {
    if (b.a == b.b) return;
    view_.nodal[at(b.a)] += f;
    view_.nodal[at(b.b)] -= f;
  };
  for (std::size_t j = 0; j < ip_.size(); ++j) add(structure_->deflections[j], view_.f[j]);
  for (std::size_t r = 0; r < if_.size(); ++r) add(structure_->rates[r], if_[r] >= 0 ? rate_in_[r] : rate_out_[r]);
  for (std::size_t k = 0; k < slip_force_.size(); ++k) {
    if (slip_force_[k] != 0) add(structure_->sliders[k], slip_force_[k]);
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    view_.applied[at(structure_->rigid[at(f.a)])] += drive_->force[k];
    if (f.b >= 0) view_.applied[at(structure_->rigid[at(f.b)])] -= drive_->force[k];
  }
}

/// The same at each node for itself: what sticks carries what is left.
void Dae::share_among_joined() {
  std::fill(view_.nodal.begin(), view_.nodal.end(), 0.0);
  std::fill(view_.applied.begin(), view_.applied.end(), 0.0);
  const auto add = [&](const Branch& b, double f) {
    view_.nodal[at(b.a)] += f;
    view_.nodal[at(b.b)] -= f;
  };
  for (std::size_t j = 0; j < ip_.size(); ++j) add(network_->deflections[j], view_.f[j]);
  for (std::size_t r = 0; r < if_.size(); ++r) add(network_->rates[r], if_[r] >= 0 ? rate_in_[r] : rate_out_[r]);
  for (std::size_t k = 0; k < slip_force_.size(); ++k) {
    if (slip_force_[k] != 0) add(network_->sliders[k].branch, slip_force_[k]);
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    view_.applied[at(f.a)] += drive_->force[k];
    if (f.b >= 0) view_.applied[at(f.b)] -= drive_->force[k];
  }
  std::vector<double>& left = work_;
  for (std::size_t n = 0; n < left.size(); ++n) {
    left[n] = view_.nodal[n] - view_.applied[n] + structure_->own_mass[n] * view_.acceleration[n];
  }
  bonds_.solve(left, view_.slider_force);
  for (std::size_t k = 0; k < slip_force_.size(); ++k) {
    if (structure_->stuck[k]) add(network_->sliders[k].branch, view_.slider_force[k]);
  }
}

void Dae::residual(double t, const double* y, const double* yp, double* r) {
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

  if (idle_) r[0] = yp[0];
  for (std::size_t n = 0; n < iv_.size(); ++n) {
    if (iv_[n] >= 0) r[iv_[n]] = view_.nodal[n] - view_.applied[n] + structure_->mass[n] * yp[iv_[n]];
  }
  for (std::size_t g = 0; g < group_row_.size(); ++g) {
    double sum = 0;
    for (NodeId node : structure_->groups[g].nodes) sum += view_.nodal[at(node)] - view_.applied[at(node)];
    if (group_row_[g] >= 0) r[group_row_[g]] = sum;
  }
  for (std::size_t k = 0; k < if_.size(); ++k) {
    const Branch& b = structure_->rates[k];
    if (if_[k] >= 0) r[if_[k]] = v_[at(b.a)] - v_[at(b.b)] - rate_out_[k];
  }
  for (const Row& row : rows_) {
    double sum = (row.position ? yp[row.row] : 0) - (row.delayed < 0 ? 0 : drive_->felt[at(row.delayed)]);
    for (int k = row.flow_begin; k < row.flow_end; ++k) {
      const auto [j, sign] = flows_[at(k)];
      sum += sign * moving_[at(j)] * (yp[ip_[at(j)]] + view_.creep[at(j)]);
    }
    for (int k = row.velocity_begin; k < row.velocity_end; ++k) {
      sum += velocities_[at(k)].sign * v_[at(velocities_[at(k)].index)];
    }
    r[row.row] = sum;
  }
  for (const Follower& f : followers_) {
    if (f.active) r[f.row] = yp[f.row] - share(f, yp[ip_[at(f.leader)]]).rate;
  }
}

void Dae::magnitudes(double* r) const {
  std::fill(r, r + size_, 0.0);
  const auto add = [&](NodeId node, double x) {
    if (iv_[at(node)] >= 0) r[iv_[at(node)]] += std::abs(x);
    if (const int g = structure_->group[at(node)]; g >= 0 && group_row_[at(g)] >= 0) r[group_row_[at(g)]] += std::abs(x);
  };
  const auto add_branch = [&](const Branch& b, double f) {
    add(b.a, f);
    add(b.b, f);
  };
  for (std::size_t j = 0; j < ip_.size(); ++j) add_branch(structure_->deflections[j], view_.f[j]);
  for (std::size_t k = 0; k < if_.size(); ++k) {
    const Branch& b = structure_->rates[k];
    // The difference of two velocities is known to the last digit of each.
    const double speed = std::abs(v_[at(b.a)]) + std::abs(v_[at(b.b)]);
    add_branch(b, if_[k] >= 0 ? rate_in_[k] : std::abs(rate_out_[k]) + rate_d_[k] * speed);
    if (if_[k] >= 0) r[if_[k]] = std::abs(v_[at(b.a)]) + std::abs(v_[at(b.b)]) + std::abs(rate_out_[k]);
  }
  for (std::size_t k = 0; k < slip_force_.size(); ++k) add_branch(structure_->sliders[k], slip_force_[k]);
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    add(structure_->rigid[at(f.a)], drive_->force[k]);
    if (f.b >= 0) add(structure_->rigid[at(f.b)], drive_->force[k]);
  }
  for (const Row& row : rows_) {
    for (int k = row.velocity_begin; k < row.velocity_end; ++k) {
      r[row.row] += std::abs(velocities_[at(k)].sign * v_[at(velocities_[at(k)].index)]);
    }
  }
}

void Dae::jacobian(double t, double cj, const double* y, const double* yp, double* values) {
  gather(t, y);
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&view_.p[k], &view_.f[k], &df_[k], &view_.creep[k], &dc_[k]);
  }
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&rate_in_[k], &rate_out_[k], &rate_d_[k]);
  }
  stiffen_resting_laws();
  for (std::size_t e = 0; e < constant_.size(); ++e) values[e] = constant_[e] + cj * mass_[e];
  for (const Scatter& s : scatter_) {
    const std::vector<double>& d = s.source == Source::force ? df_ : s.source == Source::creep ? dc_ : rate_d_;
    const double weight = s.source == Source::creep ? s.sign * moving_[at(s.index)] : s.sign;
    values[s.entry] += weight * d[at(s.index)];
  }
  share_jacobian(cj, yp, values, false);
}

/// A power law other than Newton's has slope 0 at rest, and its equation no solution there to first order. A secant up to
/// the forces now at work takes its place: Newton's iteration gets away from rest with it.
void Dae::stiffen_resting_laws() {
  double scale = -1;
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      if (secants_ && rate_in_[r] != 0) rate_d_[r] = std::max(rate_d_[r], rate_out_[r] / rate_in_[r]);
      if (rate_d_[r] != 0) continue;
      if (scale < 0) {
        sum_forces();
        for (std::size_t n = 1; n < v_.size(); ++n) {
          scale = std::max({scale, std::abs(view_.nodal[n]), std::abs(view_.applied[n])});
        }
      }
      const double f = scale > 0 ? scale : coming_force(*laws.batch, i, *drive_, v_), w = laws.batch->velocity_at(i, f);
      rate_d_[r] = if_[r] >= 0 ? w / f : f / w;
    }
  }
}

void Dae::guess_forces(double t, double* y) {
  gather(t, y);
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const Branch& b = structure_->rates[r];
      if (if_[r] >= 0) y[if_[r]] = laws.batch->force_at(i, v_[at(b.a)] - v_[at(b.b)]);
    }
  }
}

void Dae::consistency_matrix(double t, const double* y, double* values) {
  jacobian(t, 0, y, nullptr, values);
  for (std::size_t e = 0; e < constant_.size(); ++e) {
    if (differential_[at(pattern_.row[e])]) values[e] = mass_[e];
  }
  share_jacobian(0, nullptr, values, true);
}

void Dae::time_derivative(double* r) const {
  std::fill(r, r + size_, 0.0);
  const auto add = [&](NodeId node, double x) {
    if (node < 0) return;
    node = structure_->rigid[at(node)];
    if (iv_[at(node)] >= 0 && !differential_[at(iv_[at(node)])]) r[iv_[at(node)]] += x;
    if (const int g = structure_->group[at(node)]; g >= 0 && group_row_[at(g)] >= 0) r[group_row_[at(g)]] += x;
  };
  for (std::size_t k = 0; k < if_.size(); ++k) {
    const Branch& b = structure_->rates[k];
    const double dw = a_[at(b.a)] - a_[at(b.b)];
    if (if_[k] >= 0) {
      r[if_[k]] += dw;
    } else if (dw != 0) {
      add(b.a, rate_d_[k] * dw);
      add(b.b, -rate_d_[k] * dw);
    }
  }
  for (const Row& row : rows_) {  // loops through branches that are held still, all of them
    if (differential_[at(row.row)]) continue;
    for (int k = row.velocity_begin; k < row.velocity_end; ++k) {
      r[row.row] += velocities_[at(k)].sign * a_[at(velocities_[at(k)].index)];
    }
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    add(network_->forces[k].a, -drive_->force_rate[k]);
    add(network_->forces[k].b, drive_->force_rate[k]);
  }
}

const Dae::View& Dae::view(double t, const double* y, const double* yp) {
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
  view_velocities(yp);
  for (std::size_t n = 0; n < v_.size(); ++n) {
    view_.acceleration[n] = a_[n];
    if (structure_->kind[n] == Kind::massive) {
      view_.acceleration[n] = (view_.applied[n] - view_.nodal[n]) / structure_->mass[n];
    }
  }
  if (!bonds_.empty()) {
    for (std::size_t n = 0; n < v_.size(); ++n) {
      const std::size_t leader = at(structure_->rigid[n]);
      view_.acceleration[n] = view_.acceleration[leader];
      view_.velocity[n] = view_.velocity[leader];
    }
    share_among_joined();
  }
  for (std::size_t k = 0; k < slip_force_.size(); ++k) {
    const Branch& b = structure_->sliders[k];
    view_.slider_velocity[k] = structure_->stuck[k] ? 0 : view_.velocity[at(b.a)] - view_.velocity[at(b.b)];
    if (!structure_->stuck[k]) view_.slider_force[k] = slip_force_[k];
  }
  for (std::size_t r = 0; r < if_.size(); ++r) {
    view_.rate_velocity[r] = if_[r] >= 0 ? rate_out_[r] : rate_in_[r];
    view_.rate_force[r] = if_[r] >= 0 ? rate_in_[r] : rate_out_[r];
  }
  for (std::size_t m = 0; m < network_->motions.size(); ++m) {
    view_.position[at(network_->motions[m].node)] = drive_->position[m];
  }
  for (NodeId node : position_order_) {
    const Derived& d = derived_[at(node)];
    if (ix_[at(node)] >= 0) {
      view_.position[at(node)] = y[ix_[at(node)]];
    } else if (d.branch >= 0) {
      view_.position[at(node)] = view_.position[at(d.parent)] + d.sign * (view_.p[at(d.branch)] + offset_[at(d.branch)]);
    } else if (d.slider >= 0) {
      view_.position[at(node)] = view_.position[at(d.parent)] + d.sign * slider_shift_[at(d.slider)];
    }
  }
  return view_;
}

void Dae::view_velocities(const double* yp) {
  view_.velocity = v_;
  const auto flow = [&](int j) { return moving_[at(j)] * (yp[ip_[at(j)]] + view_.creep[at(j)]); };
  for (const Structure::Group& group : structure_->groups) {
    double base = 0;
    if (group.tie >= 0) {
      const Structure::Loop& sum = structure_->ties[at(group.tie)].velocity;
      for (const Structure::Term& x : sum.flows) base -= x.sign * flow(x.index);
      for (const Structure::Term& x : sum.velocities) base -= x.sign * v_[at(x.index)];
    } else {
      base = view_.velocity[at(group.parent)] - v_[at(group.node)] + group.sign * flow(group.tree_branch);
    }
    for (NodeId node : group.nodes) view_.velocity[at(node)] = base + v_[at(node)];
  }
  for (std::size_t j = 0; j < ip_.size(); ++j) {
    const Branch& b = structure_->deflections[j];
    const bool floating = structure_->group[at(b.a)] >= 0 || structure_->group[at(b.b)] >= 0;
    // The difference of two velocities loses digits where both move fast; the deflection's own rate does not.
    view_.flow[j] = b.a == b.b ? 0 : floating ? flow(static_cast<int>(j)) : v_[at(b.a)] - v_[at(b.b)];
    view_.dp[j] = ip_[j] >= 0 ? yp[ip_[j]] : view_.flow[j];
  }
  for (const Past::Delayed& d : drive_->past().delayed()) {
    const Branch& b = structure_->deflections[at(d.branch)];
    view_.flow[at(d.branch)] = view_.velocity[at(b.a)] - view_.velocity[at(b.b)];
  }
}

Dae::Balance Dae::balance(const Structure::Tie& tie) const {
  Balance result{0, 0};
  for (NodeId node : tie.nodes) {
    result.sum += view_.nodal[at(node)] - view_.applied[at(node)];
    result.magnitude += std::abs(view_.nodal[at(node)]) + std::abs(view_.applied[at(node)]);
  }
  return result;
}

bool Dae::load_changes(const Structure::Tie& tie) const {
  const auto within = [&](NodeId node) { return std::find(tie.nodes.begin(), tie.nodes.end(), node) != tie.nodes.end(); };
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    if (drive_->force_rate[k] != 0 && within(f.a) != within(f.b)) return true;
  }
  return false;
}

const std::vector<double>& Dae::slopes() {
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&view_.p[k], &view_.f[k], &df_[k], &view_.creep[k], &dc_[k]);
  }
  return df_;
}

double Dae::reaction(NodeId node) const {
  return view_.nodal[at(node)] - view_.applied[at(node)] + structure_->own_mass[at(node)] * a_[at(node)];
}

double Dae::supplied_power() const {
  double power = 0;
  for (const Network::Motion& m : network_->motions) power += reaction(m.node) * view_.velocity[at(m.node)];
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    power += drive_->force[k] * (view_.velocity[at(f.a)] - (f.b >= 0 ? view_.velocity[at(f.b)] : 0));
  }
  return power;
}

double Dae::dissipated_power() const {
  double power = 0;
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    if (laws.batch->knows_heat()) continue;
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      power += laws.batch->dissipated_power(i, view_.p[j], view_.dp[j], view_.flow[j]);
    }
  }
  for (std::size_t r = 0; r < if_.size(); ++r) power += view_.rate_force[r] * view_.rate_velocity[r];
  for (std::size_t k = 0; k < slip_force_.size(); ++k) power += slip_force_[k] * view_.slider_velocity[k];
  return power;
}

double Dae::heat_of_laws() const {
  double heat = 0;
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    for (std::size_t i = 0; laws.batch->knows_heat() && i < laws.batch->size(); ++i) {
      heat += laws.batch->heat(i, view_.p[at(laws.first) + i]);
    }
  }
  return heat;
}

double Dae::stored_energy() const {
  double energy = 0;
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      energy += laws.batch->stored_energy(i, view_.p[at(laws.first) + i]);
    }
  }
  for (std::size_t n = 0; n < v_.size(); ++n) {
    energy += structure_->own_mass[n] * view_.velocity[n] * view_.velocity[n] / 2;
  }
  return energy;
}

}  // namespace rheonet
