#include "core/solve/tolerances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rheonet {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// A quantity this much smaller than the largest of its kind is still resolved to its own last digit.
constexpr double floor_of_kind = 1e-4;
// The largest share of the tolerance that a reversal's velocity may hide in.
constexpr double noise_share = 0.1;
// Roundings of the time that a step may be off by without being rejected.
constexpr double time_grains = 8;
// Rounding of a velocity that is a given function of time.
constexpr double given_noise = 1e-13;

}  // namespace

Tolerances::Tolerances(Dae& dae, double relative) : dae_(dae), relative_(relative) {
  const std::size_t n = at(dae.size());
  const Network& network = dae.network();
  const Structure& structure = dae.structure();
  sort_.assign(n, Sort::velocity);
  branch_.assign(n, -1);
  for (std::size_t j = 0; j < network.deflections.size(); ++j) {
    const Branch& b = network.deflections[j];
    given_.push_back(structure.kind[at(b.a)] == Kind::known && structure.kind[at(b.b)] == Kind::known);
    const int unknown = dae.deflection_unknown(static_cast<int>(j));
    if (unknown < 0) continue;
    sort_[at(unknown)] = Sort::deflection;
    branch_[at(unknown)] = static_cast<int>(j);
  }
  for (std::size_t r = 0; r < network.rates.size(); ++r) {
    const int unknown = dae.force_unknown(static_cast<int>(r));
    if (unknown >= 0) sort_[at(unknown)] = Sort::force;
  }
  for (std::size_t k = 0; k < structure.kind.size(); ++k) {
    const int unknown = dae.position_unknown(static_cast<NodeId>(k));
    if (unknown >= 0) sort_[at(unknown)] = Sort::position;
  }
  seen_.assign(n, 0);
  foreseen_.assign(n, 0);
  tolerance_.assign(n, relative);
  force_seen_.assign(network.deflections.size(), 0);
  flow_seen_ = noise_ = force_seen_;
}

void Tolerances::see(const std::vector<double>& y, const Dae::View& view) {
  for (std::size_t i = 0; i < y.size(); ++i) seen_[i] = std::max(seen_[i], std::abs(y[i]));
  for (std::size_t j = 0; j < force_seen_.size(); ++j) {
    force_seen_[j] = std::max(force_seen_[j], std::abs(view.f[j]));
    flow_seen_[j] = std::max(flow_seen_[j], std::abs(view.flow[j]));
  }
  for (const Network::Motion& m : dae_.network().motions) {
    known_velocity_ = std::max(known_velocity_, std::abs(view.velocity[at(m.node)]));
  }
  for (double f : view.applied) applied_force_ = std::max(applied_force_, std::abs(f));
}

bool Tolerances::blind() const {
  std::array<bool, 4> there{}, known{};
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    there[static_cast<std::size_t>(sort_[i])] = true;
    if (seen_[i] > 0) known[static_cast<std::size_t>(sort_[i])] = true;
  }
  return there != known;
}

void Tolerances::foresee(double t, double ahead, const std::vector<double>& y, const std::vector<double>& yp,
                         const std::vector<double>& ypp) {
  forget_ = t + 10 * ahead;
  for (std::size_t i = 0; i < y.size(); ++i) {
    foreseen_[i] = std::abs(y[i]) + ahead * (std::abs(yp[i]) + ahead / 2 * std::abs(ypp[i]));
  }
  see(y, dae_.view(t, y.data(), yp.data()));
  update(t, yp);
}

void Tolerances::follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view) {
  if (t > forget_) std::fill(foreseen_.begin(), foreseen_.end(), 0.0);
  see(y, view);
  update(t, yp);
}

void Tolerances::update(double t, const std::vector<double>& yp) {
  // Time itself is known to half a unit in the last place; what changes meanwhile cannot be resolved.
  const double grain = time_grains * std::numeric_limits<double>::epsilon() * std::abs(t);
  const std::vector<double>& slope = dae_.slopes();
  std::array<double, 4> largest{};
  largest[static_cast<std::size_t>(Sort::velocity)] = known_velocity_;
  double force = applied_force_;
  for (double f : force_seen_) force = std::max(force, f);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    double& l = largest[static_cast<std::size_t>(sort_[i])];
    l = std::max({l, seen_[i], foreseen_[i]});
    if (sort_[i] == Sort::force) force = std::max(force, seen_[i]);
    if (sort_[i] == Sort::deflection) force = std::max(force, std::abs(slope[at(branch_[i])]) * foreseen_[i]);
  }
  largest[static_cast<std::size_t>(Sort::force)] = force;

  for (std::size_t i = 0; i < seen_.size(); ++i) {
    double scale = std::max({seen_[i], foreseen_[i], floor_of_kind * largest[static_cast<std::size_t>(sort_[i])]});
    if (sort_[i] == Sort::deflection) {
      // What the force allows: near a reversal a nanometre may matter, in sliding a metre does not.
      const std::size_t j = at(branch_[i]);
      const double stiffness = std::abs(slope[j]);
      const double own = std::max(force_seen_[j], stiffness * foreseen_[i]);
      const double by_force = std::max(own, floor_of_kind * force);
      if (by_force > 0 && stiffness > 0) scale = std::min(scale, by_force / stiffness);
    }
    tolerance_[i] = std::max(relative_ * (scale > 0 ? scale : 1), grain * std::abs(yp[i]));
  }
  unresolved_velocity_ = relative_ * largest[static_cast<std::size_t>(Sort::velocity)];
  for (std::size_t j = 0; j < noise_.size(); ++j) {
    // A branch that has hardly moved yet is noise as long as it is slow against the rest of the network.
    const double velocity = unresolved_velocity_ / relative_;
    noise_[j] = given_[j] ? given_noise * flow_seen_[j]
                          : noise_share * relative_ * std::max(flow_seen_[j], floor_of_kind * velocity);
  }
}

}  // namespace rheonet
