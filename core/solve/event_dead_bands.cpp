#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

double Tolerances::force_noise(int rate) const {
  const double dead_band = numerics::reversal_dead_band * relative_ * seen_[static_cast<std::size_t>(Sort::force)][at(rate)];
  return std::max(dead_band, std::numeric_limits<double>::min());
}

/// Dead band of the relative velocity of a branch [m/s]: relative to the network's largest while the branch has hardly moved.
double Tolerances::noise_of(bool given, double flow, const Branch& b, double of_difference) const {
  const Structure& structure = dae_->structure();
  // Round-off of forces causes a velocity, through dashpots, only at nodes without mass.
  const auto heavy = [&](NodeId node) { return structure.kind[at(node)] == Kind::known || structure.inertia[at(node)] > 0; };
  const double of_rounding = heavy(b.a) && heavy(b.b) ? 0 : rounding_at_rest_[at(part_of(b))];
  const double unresolved =
      given ? numerics::given_velocity_roundoff * flow
            : std::max({numerics::reversal_dead_band * relative_ * std::max(flow, numerics::scale_floor * largest_velocity_), of_rounding, of_difference});
  // Above 0: an event function that begins at 0 would never be seen to fall through it.
  return std::max(unresolved, std::numeric_limits<double>::min());
}

double Tolerances::dead_band(int branch) const {
  const std::size_t j = at(branch);
  return noise_of(given_[j] != 0, flow_seen_[j], dae_->structure().deflections[j], difference_rounding_[j]);
}

void Tolerances::find_noise(const std::vector<double>& slope) {
  const Structure& structure = dae_->structure();
  find_force_errors(slope);
  for (std::size_t k = 0; k < slider_noise_.size(); ++k) {
    const Branch& b = structure.sliders[k];
    slider_noise_[k] = noise_of(slider_given_[k] != 0, slide_seen_[k], b, std::max(slide_rounding_[k], tied_rounding(b)));
  }
  find_slip_noise(slope);
}

/// Errors of forces due to steps and round-off. Near rest, a dilatant law turns a small force into a large velocity.
void Tolerances::find_force_errors(const std::vector<double>& slope) {
  force_error_.clear();
  if (!dae_->rough()) return;
  force_error_ = force_rounding_;
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->deflection_unknown(static_cast<int>(j));
    if (unknown < 0) continue;
    double& most = force_error_[at(part_of(structure.deflections[j]))];
    most = std::max(most, std::abs(slope[j]) * tolerance_[at(unknown)]);
  }
}

double Tolerances::unfelt_dilatant(int rate) const {
  if (force_error_.empty()) return 0;
  std::size_t i = 0;
  const RateBatch& law = network_.rate_of(rate, i);
  return law.velocity_at(i, force_error_[at(part_of(dae_->structure().rates[at(rate)]))]);
}

/// A slider that has just stopped carries its full sliding force, and from there on less by an amount of second order in
/// time. The error of the first step is of that order too, and would let the slider slip.
void Tolerances::find_slip_noise(const std::vector<double>& slope) {
  if (slip_noise_.empty()) return;
  const Structure& structure = dae_->structure();
  if (std::none_of(structure.stuck.begin(), structure.stuck.end(), [](char stuck) { return stuck != 0; })) {
    std::fill(slip_noise_.begin(), slip_noise_.end(), 0.0);
    return;
  }
  held_noise_.assign(structure.kind.size(), 0);
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->deflection_unknown(static_cast<int>(j));
    if (unknown < 0 || structure.deflections[j].a == structure.deflections[j].b) continue;
    const double dead_band = std::abs(slope[j]) * tolerance_[at(unknown)];
    for (const NodeId node : {network_.deflections[j].a, network_.deflections[j].b}) held_noise_[at(held_[at(node)])] += dead_band;
  }
  // A prescribed motion balances any force.
  const auto noise_at = [&](NodeId node) { return structure.kind[at(node)] == Kind::known ? 0 : held_noise_[at(held_[at(node)])]; };
  for (std::size_t k = 0; k < slip_noise_.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double bound = largest_force(static_cast<int>(k));
    const double dead_band = structure.stuck[k] ? std::max(noise_at(b.a), noise_at(b.b)) : 0;
    slip_noise_[k] = bound > 0 ? std::min(dead_band, numerics::stick_dead_band * local() * bound) : dead_band;
  }
}

}  // namespace rheonet
