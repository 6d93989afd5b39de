#include "core/solve/tolerances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/rate_law.hpp"

namespace rheonet {

Tolerances::Tolerances(const Network& network, double relative) : network_(network), relative_(relative), dense_(relative), bundle_corners_(network), block_gains_(network) {
  const std::size_t nodes = network.nodes(), deflections = network.deflections.size();
  seen_ = {std::vector<double>(nodes, 0), std::vector<double>(deflections, 0), std::vector<double>(network.rates.size(), 0),
           std::vector<double>{}, std::vector<double>(network.blocks.blocks.size(), 0)};
  sensed_.assign(nodes, 0);
  for (const Blocks::Sensor& sensor : network.blocks.sensors) {
    if (sensor.what == Blocks::Sensor::What::position) sensed_[at(sensor.index)] = 1;
  }
  if (!network.blocks.sensors.empty()) {
    block_rounding_.assign(nodes, 0);
  }
  block_output_seen_.assign(network.blocks.blocks.size(), 0);
  block_force_seen_.assign(network.forces.size(), 0);
  rested_.assign(network.sliders.size(), 0);
  slid_.assign(network.sliders.size(), 0);
  foreseen_ = seen_;
  force_seen_.assign(deflections, 0);
  hop_ = flow_seen_ = force_seen_;
  slide_seen_.assign(network.sliders.size(), 0);
  held_seen_ = slide_seen_;
  dashpot_seen_.assign(network.rates.size(), 0);
  carried_seen_ = dashpot_seen_;
  relative_seen_.assign(nodes, 0);
  least_slide_.assign(nodes, std::numeric_limits<double>::infinity());
  slip_noise_ = slider_noise_ = slide_rounding_ = slide_seen_;
  difference_rounding_ = force_seen_;
}

void Tolerances::attach(Dae& dae) {
  dae_ = &dae;
  const Structure& structure = dae.structure();
  const std::size_t n = at(dae.size());
  quantity_.assign(n, {Sort::velocity, 0});
  const auto known = [&](const Branch& b) {
    return b.a == b.b || (structure.of_time[at(b.a)] && structure.of_time[at(b.b)]);
  };
  const auto stands_for = [&](int unknown, Sort sort, std::size_t index) {
    if (unknown >= 0) quantity_[at(unknown)] = {sort, static_cast<unsigned>(index)};
  };
  given_.clear();
  slider_given_.clear();
  for (std::size_t j = 0; j < network_.deflections.size(); ++j) {
    given_.push_back(known(structure.deflections[j]));
    stands_for(dae.deflection_unknown(static_cast<int>(j)), Sort::deflection, j);
  }
  for (const Branch& b : structure.sliders) slider_given_.push_back(known(b));
  any_solved_ = false;
  dashpot_rounding_.assign(network_.rates.size(), 0);
  for (std::size_t r = 0; r < network_.rates.size(); ++r) {
    any_solved_ = any_solved_ || dae.force_unknown(static_cast<int>(r)) >= 0;
    stands_for(dae.force_unknown(static_cast<int>(r)), Sort::force, r);
  }
  for (std::size_t k = 0; k < structure.kind.size(); ++k) {
    stands_for(dae.velocity_unknown(static_cast<NodeId>(k)), Sort::velocity, k);
    stands_for(dae.position_unknown(static_cast<NodeId>(k)), Sort::position, k);
  }
  for (std::size_t k = 0; k < dae.inputs().blocks().states(); ++k) stands_for(dae.block_unknown(k), Sort::block, k);
  if (!dae.integrated_positions().empty()) see_positions();
  balanced_.assign(network_.deflections.size(), -1);
  any_balanced_ = any_solved_;
  for (const Structure::Group& group : structure.groups) {
    if (group.tree_branch < 0) continue;
    balanced_[at(group.tree_branch)] = group.node;
    any_balanced_ = true;
  }
  tolerance_.assign(n, relative_);
  grain_.assign(n, 0);
  size_.assign(n, 0);
  rounding_.assign(n, 0);
  drift_.assign(n, {});
  stop_chains_ = dae.rough() ? find_stop_chains(network_, structure) : std::vector<StopChain>{};
  find_parts();
  find_jitter();
  find_gaps();
  balance_rounding_.attach(network_, structure);
  find_held();
}

/// Only here, because most networks have no position among their unknowns in any mode.
void Tolerances::see_positions() {
  constexpr auto position = static_cast<std::size_t>(Sort::position);
  for (std::vector<double>* seen : {&seen_[position], &foreseen_[position], &gap_seen_, &place_seen_, &way_seen_}) {
    seen->resize(network_.nodes(), 0);
  }
}

/// Finds the nodes that sticking sliders hold together, up to known nodes.
void Tolerances::find_held() {
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

void Tolerances::find_gaps() {
  std::vector<char> positioned(dae_->structure().kind.size(), 0);
  for (std::size_t n = 0; n < positioned.size(); ++n) positioned[n] = dae_->structure().of_time[n];
  for (const NodeId node : dae_->positioned()) positioned[at(node)] = 1;
  gaps_.clear();
  has_gap_.assign(positioned.size(), 0);
  const auto add = [&](const Branch& b) {
    if (!positioned[at(b.a)] || !positioned[at(b.b)]) return;
    for (const NodeId node : {b.a, b.b}) {
      if (dae_->position_unknown(node) < 0) continue;
      gaps_.push_back({node, b});
      has_gap_[at(node)] = 1;
    }
  };
  for (const Branch& b : network_.rates) add(b);
  for (const Network::Slider& s : network_.sliders) add(s.branch);
}

void Tolerances::see(const std::vector<double>& y, const Dae::View& view) {
  if (!trusted_) return;
  for (std::size_t i = 0; i < y.size(); ++i) seen(quantity_[i]) = std::max(seen(quantity_[i]), std::abs(y[i]));
  const Structure& structure = dae_->structure();
  const auto meet = [&](const Branch& b, double w) {
    for (const NodeId node : {b.a, b.b}) relative_seen_[at(node)] = std::max(relative_seen_[at(node)], std::abs(w));
  };
  for (std::size_t j = 0; j < force_seen_.size(); ++j) {
    force_seen_[j] = std::max(force_seen_[j], std::abs(view.f[j]));
    flow_seen_[j] = std::max(flow_seen_[j], std::abs(view.flow[j]));
    meet(structure.deflections[j], view.flow[j]);
  }
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    dashpot_seen_[r] = std::max(dashpot_seen_[r], std::abs(view.rate_force[r]));
    meet(structure.rates[r], view.rate_velocity[r]);
  }
  std::fill(least_slide_.begin(), least_slide_.end(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < slide_seen_.size(); ++k) {
    slide_seen_[k] = std::max(slide_seen_[k], std::abs(view.slider_velocity[k]));
    held_seen_[k] = std::max(held_seen_[k], std::abs(view.slider_force[k]));
    // The bounds of losses have the round-off of the force of their train.
    if (const int train = network_.sliders[k].train; train >= 0) held_seen_[k] = std::max(held_seen_[k], std::abs(view.train_force[at(train)]));
    meet(structure.sliders[k], view.slider_velocity[k]);
    see_rest(k, view.slider_velocity[k]);
    if (!(slide_seen_[k] > 0)) continue;
    for (const NodeId node : {structure.sliders[k].a, structure.sliders[k].b}) {
      least_slide_[at(node)] = std::min(least_slide_[at(node)], slide_seen_[k]);
    }
  }
  for (const Gap& gap : gaps_) {
    double& seen = gap_seen_[at(gap.node)];
    seen = std::max(seen, std::abs(view.position[at(gap.branch.a)] - view.position[at(gap.branch.b)]));
  }
  for (const NodeId node : dae_->integrated_positions()) {
    const double x = std::abs(view.position[at(node)]), beside = std::abs(view.position[at(dae_->integrated_beside(node))]);
    place_seen_[at(node)] = std::max(place_seen_[at(node)], x);
    way_seen_[at(node)] = std::max({way_seen_[at(node)], x, beside});
  }
  for (const Network::Motion& m : network_.motions) {
    known_velocity_ = std::max(known_velocity_, std::abs(view.velocity[at(m.node)]));
  }
  for (double f : view.applied) applied_force_ = std::max(applied_force_, std::abs(f));
}

double Tolerances::largest_relative_velocity() const {
  return std::max(largest_velocity_, *std::max_element(relative_seen_.begin(), relative_seen_.end()));  // ground is always there
}

bool Tolerances::blind() const {
  std::array<bool, sorts> there{}, known{};
  for (const Quantity& q : quantity_) {
    there[static_cast<std::size_t>(q.sort)] = true;
    if (seen(q) > 0) known[static_cast<std::size_t>(q.sort)] = true;
    if (q.sort == Sort::block && seen(q) == 0) return true;
  }
  return there != known;
}

void Tolerances::foresee(double t, double ahead, const std::vector<double>& y, const std::vector<double>& yp,
                         const std::vector<double>& coming_size) {
  if (std::isnan(begin_)) begin_ = reached_ = t;
  restarted_ = t;
  // Estimates made before a recent event still hold.
  if (t > forget_) forget();
  if (ahead > 0) {
    forget_ = t + numerics::scale_memory * ahead;
    ahead_ = ahead;
    for (std::size_t i = 0; i < y.size(); ++i) {
      double& foreseen = foreseen_of(quantity_[i]);
      foreseen = std::max(foreseen, coming_size[i]);
    }
  }
  const Dae::View& view = dae_->view(t, y.data(), yp.data());
  see(y, view);
  see_hops(view, true);
  for (std::size_t i = 0; i < y.size(); ++i) size_[i] = std::max(std::abs(y[i]), ahead > 0 ? coming_size[i] : 0.0);
  find_slider_shares();
  if (!network_.blocks.blocks.empty()) block_gains_.follow(dae_->inputs().blocks());
  drift_found_ = t;
  find_rounding(view);
  find_difference_rounding(view);
  find_stopping(view);
  find_balances();
  step_ = 0;
  update(t, yp, view);
}

void Tolerances::forget() {
  ahead_ = 0;
  for (std::vector<double>& sort : foreseen_) std::fill(sort.begin(), sort.end(), 0.0);
}

double Tolerances::local() const { return bundle_corners_.dense() ? dense_ : relative_; }

void Tolerances::follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view) {
  if (t > forget_) forget();
  see(y, view);
  see_hops(view, false);
  for (std::size_t i = 0; i < y.size(); ++i) size_[i] = std::max(size_[i], std::abs(y[i]));
  find_difference_rounding(view);
  // Forces of blocks may begin long after a restart.
  if (!network_.blocks.sensors.empty()) {
    find_slider_shares();
    find_block_rounding();
  }
  // A step may lead from one reversal of a motion to the next, where its velocity is 0.
  known_velocity_ = std::max(known_velocity_, dae_->inputs().largest_velocity(reached_, t));
  step_ = t - reached_;
  reached_ = t;
  find_drift_again(t, view);
  find_dashpot_rounding(view);
  if (dae_->rough()) {
    find_force_rounding(view);
    find_rounding_now(view);
  }
  bundle_corners_.follow(*dae_, view);
  find_stopping(view);
  update(t, yp, view);
}

/// Scales of the kinds of unknowns that are still 0, even to second order in time: the effect of the inputs within `time`
/// [s]. They count for the first steps only.
Tolerances::Scales Tolerances::scales_to_come(double time, const Scales& largest) const {
  Scales scales = largest;
  const auto of = [&](Sort sort) -> double& { return scales[static_cast<std::size_t>(sort)]; };
  Inputs::Reach reach = coming_reach(dae_->inputs(), {of(Sort::velocity)});
  for (const double m : dae_->structure().mass) {
    if (of(Sort::velocity) == 0 && m > 0) reach.velocity = std::max(reach.velocity, reach.force * time / m);
  }
  double force = 0;
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) force = std::max(force, coming_force(*laws.batch, i, reach));
  }
  const Scales coming{reach.velocity, reach.velocity * time, force, reach.velocity * time};
  for (std::size_t k = 0; k < sorts; ++k) {
    // If the inputs are 0 too, nothing ever moves: any scale is right, but it must not be 0.
    if (scales[k] == 0) scales[k] = coming[k] > 0 ? coming[k] : 1;
  }
  return scales;
}

/// The largest magnitude of each sort, seen or foreseen; for forces including those of all elements and the applied forces.
Tolerances::Scales Tolerances::find_largest(const std::vector<double>& slope) {
  Scales largest{};
  largest[static_cast<std::size_t>(Sort::velocity)] = known_velocity_;
  double force = applied_force_;
  for (double f : force_seen_) force = std::max(force, f);
  for (const Quantity& q : quantity_) {
    double& l = largest[static_cast<std::size_t>(q.sort)];
    l = std::max({l, seen(q), foreseen_of(q)});
    if (q.sort == Sort::force) force = std::max(force, seen(q));
    if (q.sort == Sort::deflection) force = std::max(force, std::abs(slope[q.index]) * foreseen_of(q));
  }
  largest[static_cast<std::size_t>(Sort::force)] = force;
  return largest;
}

/// The scale of an unknown; 0 if it has been 0 so far.
double Tolerances::scale_of(const Quantity& q, const Scales& largest, const LeastShares& least, const std::vector<double>& slope) {
  double scale = seen(q);
  const auto resolve = [&](double beside, double share) {
    if (beside > 0) scale = std::min(scale, std::max(share * scale, beside));
  };
  if (q.sort == Sort::position) {
    if (has_gap_[q.index]) resolve(gap_seen_[q.index], least.position);
    resolve(place_seen_[q.index], least.position);
    scale = std::max(scale, least.way * way_seen_[q.index]);
  }
  if (q.sort == Sort::velocity) resolve(std::min(relative_seen_[q.index], least_slide_[q.index]), least.velocity);
  scale = std::max(scale, foreseen_of(q));
  if (!network_.blocks.blocks.empty()) scale = std::min(scale, block_scale_[static_cast<std::size_t>(q.sort)][q.index]);
  if (q.sort == Sort::block && !least_state_.empty()) scale = std::max(scale, least_state_[q.index]);
  if (!stands_alone(q)) scale = std::max(scale, numerics::scale_floor * largest[static_cast<std::size_t>(q.sort)]);
  if (q.sort != Sort::deflection) return scale;
  // Limited by the scale of the force: near a reversal a nanometre may matter, in sliding a metre does not.
  const double stiffness = std::abs(slope[q.index]);
  const double own = std::max(force_seen_[q.index], stiffness * foreseen_of(q));
  const double by_force = std::max(own, numerics::scale_floor * largest[static_cast<std::size_t>(Sort::force)]);
  if (by_force > 0 && stiffness > 0) scale = std::min(scale, by_force / stiffness);
  return hop_[q.index] > 0 ? hop_share(q.index) * scale : scale;
}

/// Velocities at a train follow from each other: the slowest is known to the round-off of the fastest.
void Tolerances::find_tied_rounding(const Dae::View& view) {
  tied_rounding_.assign(network_.trains.empty() ? 0 : network_.nodes(), 0);
  for (const Structure::Tied& tied : dae_->structure().tied) {
    double sum = std::abs(view.velocity[at(tied.pivot)]);
    for (const auto& [node, factor] : tied.terms) sum += std::abs(factor * view.velocity[at(node)]);
    sum *= numerics::sum_ulps * std::numeric_limits<double>::epsilon();
    const auto round = [&](NodeId node, double factor) { tied_rounding_[at(node)] = std::max(tied_rounding_[at(node)], sum / std::abs(factor)); };
    round(tied.pivot, 1);
    for (const auto& [node, factor] : tied.terms) round(node, factor);
  }
}

/// Raises the tolerance of unknown i to its round-off. `jitter`: change of the unknown within the round-off of time.
void Tolerances::bear_noise(std::size_t i, double t, double jitter, double largest_velocity) {
  const Quantity& q = quantity_[i];
  double& tolerance = tolerance_[i];
  tolerance = std::max({tolerance, jitters_[i] ? jitter : 0.0, rounding_[i]});
  if (q.sort == Sort::deflection) {
    grain_[i] = balance_rounding_.of(static_cast<int>(q.index));
    tolerance = std::max({tolerance, numerics::sum_ulps * std::numeric_limits<double>::epsilon() * size_[i],
                          step_ * difference_rounding_[q.index], numerics::deflection_balance_ratio * grain_[i]});
  }
  if (q.sort == Sort::velocity && !block_rounding_.empty()) {
    grain_[i] = block_rounding_[q.index];
    tolerance = std::max(tolerance, grain_[i]);
  }
  if (q.sort == Sort::velocity && !network_.trains.empty()) {
    grain_[i] = std::max(block_rounding_.empty() ? 0 : grain_[i], tied_rounding(q.index));
    tolerance = std::max(tolerance, grain_[i]);
  }
  if (q.sort == Sort::velocity && dae_->structure().inertia[q.index] == 0) tolerance = std::max(tolerance, rounding_now_[at(part_[q.index])]);
  if (q.sort == Sort::velocity && dae_->rough()) tolerance = std::min(tolerance, std::max(stopping_[q.index], jitter));
  if (q.sort == Sort::position) {
    // A stop far from 0 may deflect by less than the round-off of its position.
    tolerance = std::max(tolerance, numerics::sum_ulps * std::numeric_limits<double>::epsilon() * size_[i]);
    tolerance = std::max(tolerance, way_rounding_[at(part_[at(dae_->structure().rigid[q.index])])]);
  }
  Drift drift = q.sort == Sort::position ? Drift{rounding_now_[at(part_[q.index])]} : drift_[i];
  if (!tied_rounding_.empty()) {
    if (q.sort == Sort::position) drift.velocity = std::max(drift.velocity, tied_rounding(q.index));
    if (q.sort == Sort::deflection) drift.velocity = std::max(drift.velocity, tied_rounding(dae_->structure().deflections[q.index]));
  }
  // An error test compares a step with those since the restart: earlier round-off does not enter.
  const double adds_up = t - (q.sort == Sort::position ? begin_ : restarted_);
  const double drifted = drift.velocity * std::min(adds_up, drift.lasting);
  if (drifted > tolerance) {
    tolerance = drifted;
    drift_dominates_ = drift_dominates_ || q.sort == Sort::deflection;
  }
  // A displacement has the error of its velocity over the time for which scales are foreseen.
  if (q.sort == Sort::deflection || q.sort == Sort::position) tolerance = std::max(tolerance, relative_ * largest_velocity * ahead_);
}

void Tolerances::update(double t, const std::vector<double>& yp, const Dae::View& view) {
  const std::vector<double>& slope = dae_->slopes();
  if (!balance_rounding_.none()) balance_rounding_.find(view, slope);
  const bool positions = !dae_->integrated_positions().empty();
  if (positions) find_way_rounding();
  find_tied_rounding(view);
  // Time is known to half an ulp: changes within that cannot be resolved.
  const double grain = numerics::time_change_ulps * std::numeric_limits<double>::epsilon() * std::abs(t);
  const Scales largest = find_largest(slope);
  largest_velocity_ = largest[static_cast<std::size_t>(Sort::velocity)];
  find_block_scales(largest[static_cast<std::size_t>(Sort::force)], view);
  const auto least_share = [&](double least, double grains) {
    return std::max(least, grains * std::numeric_limits<double>::epsilon() / local());
  };
  const LeastShares least{.velocity = least_share(numerics::relative_motion_share, numerics::relative_velocity_ulps),
                          .position = least_share(numerics::relative_motion_share, numerics::relative_position_ulps),
                          .way = least_share(numerics::distance_share, numerics::distance_ulps)};
  const double relative = local();
  std::optional<Scales> to_come;  // rarely needed
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    double scale = scale_of(quantity_[i], largest, least, slope);
    if (scale == 0) {
      if (!to_come) to_come = scales_to_come(std::max(ahead_, t - begin_), largest);
      scale = (*to_come)[static_cast<std::size_t>(quantity_[i].sort)];
    }
    tolerance_[i] = std::max(relative * slider_share_[i] * scale, numerics::least_step_tolerance * std::min(scale, size_[i]));
    bear_noise(i, t, grain * std::abs(yp[i]), largest_velocity_);
  }
  if (positions) loosen_positions();
  loosen_balanced_forces(slope);
  find_noise(slope);
}

/// A position integrates a velocity, of which Newton's iteration leaves a share of its tolerance as an error.
void Tolerances::loosen_positions() {
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const Quantity& q = quantity_[i];
    if (q.sort != Sort::position || stands_alone(q)) continue;
    const int of = dae_->velocity_unknown(static_cast<NodeId>(q.index));
    const double most = numerics::position_loosening * local() * seen(q);
    if (of >= 0) tolerance_[i] = std::max(tolerance_[i], std::min(most, step_ * tolerance_[at(of)]));
  }
}

}  // namespace rheonet
