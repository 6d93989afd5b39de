#include "core/solve/dead_bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

DeadBands::DeadBands(const Network& network, const SeparatedParts& parts, const Magnitudes& seen, const UnknownRoundoff& roundoff, const StepAccuracy& accuracy)
    : network_(network), parts_(parts), seen_(seen), roundoff_(roundoff), accuracy_(accuracy), slider_(network.sliders.size(), 0), slip_(slider_), gap_(network.deflections.size(), 0) {}

void DeadBands::attach(Dae& dae) {
  dae_ = &dae;
  const Structure& structure = dae.structure();
  const auto known = [&](const Branch& b) {
    return b.a == b.b || (structure.of_time[at(b.a)] && structure.of_time[at(b.b)]);
  };
  given_.clear();
  slider_given_.clear();
  for (const Branch& b : structure.deflections) given_.push_back(known(b));
  for (const Branch& b : structure.sliders) slider_given_.push_back(known(b));
  find_held();
}

/// Finds the nodes that sticking sliders hold together, up to known nodes.
void DeadBands::find_held() {
  const Structure& structure = dae_->structure();
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  DisjointSets held(structure.kind.size());
  for (std::size_t k = 0; k < structure.stuck.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (structure.stuck[k] && !known(b.a) && !known(b.b)) held.join(b.a, b.b);
  }
  held_.clear();
  for (std::size_t n = 0; n < structure.kind.size(); ++n) held_.push_back(held.find(static_cast<NodeId>(n)));
}

void DeadBands::find(const std::vector<double>& tolerance, const std::vector<double>& slope) {
  const Structure& structure = dae_->structure();
  find_force_errors(tolerance, slope);
  for (std::size_t k = 0; k < slider_.size(); ++k) {
    const Branch& b = structure.sliders[k];
    slider_[k] = of_velocity(slider_given_[k] != 0, seen_.slide[k], b, std::max(roundoff_.slide(k), roundoff_.tied(b)));
  }
  find_slips(tolerance, slope);
  find_gaps(tolerance);
}

double DeadBands::force(int rate) const {
  const double dead_band = numerics::reversal_dead_band * accuracy_.relative * of(seen_.unknown, {Unknown::Sort::force, static_cast<unsigned>(rate)});
  return std::max(dead_band, std::numeric_limits<double>::min());
}

/// Dead band of the velocity of a branch [m/s]: relative to the network's largest velocity while the branch has hardly moved.
double DeadBands::of_velocity(bool given, double flow, const Branch& b, double of_difference) const {
  const double of_errors = numerics::reversal_dead_band * accuracy_.relative * std::max(flow, numerics::scale_floor * accuracy_.largest_velocity);
  const double unresolved = given ? numerics::given_velocity_roundoff * flow : std::max({of_errors, roundoff_.at_rest(b), of_difference});
  // Above 0: an event function that begins at 0 would never be seen to fall through it.
  return std::max(unresolved, std::numeric_limits<double>::min());
}

double DeadBands::reversal(int branch) const {
  const std::size_t j = at(branch);
  return of_velocity(given_[j] != 0, seen_.flow[j], dae_->structure().deflections[j], roundoff_.difference(j));
}

double DeadBands::largest_force(int slider) const { return std::max(dae_->inputs().box(at(slider)).largest(), seen_.held[at(slider)]); }

/// Errors of forces due to steps and round-off. Near rest, a dilatant law turns a small force into a large velocity.
void DeadBands::find_force_errors(const std::vector<double>& tolerance, const std::vector<double>& slope) {
  force_error_.clear();
  if (!dae_->rough()) return;
  force_error_ = roundoff_.forces();
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->indices().deflection[j];
    if (unknown < 0) continue;
    double& most = force_error_[at(parts_.of(structure.deflections[j]))];
    most = std::max(most, std::abs(slope[j]) * tolerance[at(unknown)]);
  }
}

double DeadBands::unfelt_dilatant(int rate) const {
  if (force_error_.empty()) return 0;
  std::size_t i = 0;
  const RateBatch& law = network_.rate_of(rate, i);
  return law.velocity_at(i, force_error_[at(parts_.of(dae_->structure().rates[at(rate)]))]);
}

/// A slider that has just stopped carries its full sliding force, and from there on less by an amount of second order in
/// time. The error of the first step is of that order too, and would let the slider slip.
void DeadBands::find_slips(const std::vector<double>& tolerance, const std::vector<double>& slope) {
  if (slip_.empty()) return;
  const Structure& structure = dae_->structure();
  if (std::none_of(structure.stuck.begin(), structure.stuck.end(), [](char stuck) { return stuck != 0; })) {
    std::fill(slip_.begin(), slip_.end(), 0.0);
    return;
  }
  held_error_.assign(structure.kind.size(), 0);
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->indices().deflection[j];
    if (unknown < 0 || structure.deflections[j].a == structure.deflections[j].b) continue;
    const double error = std::abs(slope[j]) * tolerance[at(unknown)];
    for (const NodeId node : {network_.deflections[j].a, network_.deflections[j].b}) held_error_[at(held_[at(node)])] += error;
  }
  // A prescribed motion balances any force.
  const auto error_at = [&](NodeId node) { return structure.kind[at(node)] == Kind::known ? 0 : held_error_[at(held_[at(node)])]; };
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double bound = largest_force(static_cast<int>(k));
    const double error = structure.stuck[k] ? std::max(error_at(b.a), error_at(b.b)) : 0;
    slip_[k] = bound > 0 ? std::min(error, numerics::stick_dead_band * accuracy_.local() * bound) : error;
  }
}

void DeadBands::find_gaps(const std::vector<double>& tolerance) {
  const auto of = [&](int unknown) { return unknown < 0 ? 0 : tolerance[at(unknown)]; };
  for (const Network::Slider& slider : network_.sliders) {
    if (!slider.contact) continue;
    const int own = dae_->indices().deflection[at(slider.gauge)];
    const auto& position = dae_->indices().position;
    gap_[at(slider.gauge)] = own >= 0 ? of(own) : of(position[at(slider.branch.a)]) + of(position[at(slider.branch.b)]);
  }
}

}  // namespace rheonet
