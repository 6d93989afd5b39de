#include "core/solve/tolerances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/rate_law.hpp"

namespace rheonet {

Tolerances::Tolerances(const Network& network, double relative)
    : network_(network),
      accuracy_{relative, relative},
      seen_(network),
      slider_shares_(network),
      block_scales_(network),
      bundle_corners_(network),
      roundoff_(network, parts_),
      balance_followers_(network),
      stopping_(network),
      dead_bands_(network, parts_, seen_, roundoff_, accuracy_) {}

void Tolerances::attach(Dae& dae) {
  dae_ = &dae;
  unknowns_ = unknowns_of(dae);
  tolerance_.assign(unknowns_.size(), accuracy_.relative);
  size_.assign(unknowns_.size(), 0);
  parts_.attach(dae.structure());
  seen_.attach(dae);
  for (std::size_t k = 0; k < Unknown::sorts; ++k) foreseen_[k].resize(seen_.unknown[k].size(), 0);
  roundoff_.attach(dae, unknowns_);
  balance_followers_.attach(dae);
  stopping_.attach(dae);
  dead_bands_.attach(dae);
}

void Tolerances::see(const std::vector<double>& y, const Dae::View& view) {
  if (!trusted_) return;
  seen_.see(unknowns_, y, view);
  slider_shares_.see(view);
}

bool Tolerances::blind() const {
  std::array<bool, Unknown::sorts> there{}, known{};
  for (const Unknown& q : unknowns_) {
    const bool seen = of(seen_.unknown, q) > 0;
    there[static_cast<std::size_t>(q.sort)] = true;
    if (seen) known[static_cast<std::size_t>(q.sort)] = true;
    if (q.sort == Sort::block && !seen) return true;
  }
  return there != known;
}

void Tolerances::foresee_sizes(double t, double ahead, const std::vector<double>& coming_size) {
  // Estimates made before a recent event still hold.
  if (t > forget_) forget();
  if (!(ahead > 0)) return;
  forget_ = t + numerics::scale_memory * ahead;
  ahead_ = ahead;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    double& foreseen = of(foreseen_, unknowns_[i]);
    foreseen = std::max(foreseen, coming_size[i]);
  }
}

void Tolerances::foresee(double t, double ahead, const std::vector<double>& y, const std::vector<double>& yp,
                         const std::vector<double>& coming_size) {
  if (std::isnan(begin_)) begin_ = reached_ = t;
  foresee_sizes(t, ahead, coming_size);
  const Dae::View& view = dae_->view(t, y.data(), yp.data());
  see(y, view);
  seen_.see_hops(view, true);
  for (std::size_t i = 0; i < y.size(); ++i) size_[i] = std::max(std::abs(y[i]), ahead > 0 ? coming_size[i] : 0.0);
  slider_shares_.find(*dae_, unknowns_, parts_, seen_, block_scales_.force_seen());
  block_scales_.follow(*dae_);
  roundoff_.restart(t, view);
  stopping_.find(view, seen_, accuracy_.local());
  balance_followers_.restart();
  step_ = 0;
  update(t, yp, view);
}

void Tolerances::forget() {
  ahead_ = 0;
  for (std::vector<double>& sort : foreseen_) std::fill(sort.begin(), sort.end(), 0.0);
}

void Tolerances::follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view) {
  if (t > forget_) forget();
  see(y, view);
  seen_.see_hops(view, false);
  for (std::size_t i = 0; i < y.size(); ++i) size_[i] = std::max(size_[i], std::abs(y[i]));
  // Forces of blocks may begin long after a restart.
  if (!network_.blocks.sensors.empty()) slider_shares_.find(*dae_, unknowns_, parts_, seen_, block_scales_.force_seen());
  // A step may lead from one reversal of a motion to the next, where its velocity is 0.
  seen_.see_motion(dae_->inputs().largest_velocity(reached_, t));
  step_ = t - reached_;
  reached_ = t;
  roundoff_.follow(t, view);
  bundle_corners_.follow(*dae_, view);
  accuracy_.kinks_are_dense = bundle_corners_.dense();
  stopping_.find(view, seen_, accuracy_.local());
  update(t, yp, view);
}

/// BySort of the kinds of unknowns that are still 0, even to second order in time: the effect of the inputs within `time`
/// [s]. They count for the first steps only.
BySort Tolerances::scales_to_come(double time, const BySort& largest) const {
  BySort scales = largest;
  const auto of = [&](Sort sort) -> double& { return scales[static_cast<std::size_t>(sort)]; };
  Inputs::Reach reach = coming_reach(dae_->inputs(), {of(Sort::velocity)});
  for (const double m : dae_->structure().mass) {
    if (of(Sort::velocity) == 0 && m > 0) reach.velocity = std::max(reach.velocity, reach.force * time / m);
  }
  double force = 0;
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) force = std::max(force, coming_force(*laws.batch, i, reach));
  }
  const BySort coming{reach.velocity, reach.velocity * time, force, reach.velocity * time};
  for (std::size_t k = 0; k < Unknown::sorts; ++k) {
    // If the inputs are 0 too, nothing ever moves: any scale is right, but it must not be 0.
    if (scales[k] == 0) scales[k] = coming[k] > 0 ? coming[k] : 1;
  }
  return scales;
}

/// The largest magnitude of each sort, seen or foreseen; for forces including those of all elements and the applied forces.
BySort Tolerances::find_largest(const std::vector<double>& slope) const {
  BySort largest{};
  largest[static_cast<std::size_t>(Sort::velocity)] = seen_.motion;
  double force = seen_.applied;
  for (double f : seen_.force) force = std::max(force, f);
  for (const Unknown& q : unknowns_) {
    const double seen = of(seen_.unknown, q), foreseen = of(foreseen_, q);
    double& l = largest[static_cast<std::size_t>(q.sort)];
    l = std::max({l, seen, foreseen});
    if (q.sort == Sort::force) force = std::max(force, seen);
    if (q.sort == Sort::deflection) force = std::max(force, std::abs(slope[q.index]) * foreseen);
  }
  largest[static_cast<std::size_t>(Sort::force)] = force;
  return largest;
}

/// The scale of an unknown; 0 if it has been 0 so far.
double Tolerances::scale_of(const Unknown& q, const BySort& largest, const LeastShares& least, const std::vector<double>& slope) const {
  double scale = of(seen_.unknown, q);
  const auto resolve = [&](double beside, double share) {
    if (beside > 0) scale = std::min(scale, std::max(share * scale, beside));
  };
  if (q.sort == Sort::position) {
    if (seen_.has_gap[q.index]) resolve(seen_.gap[q.index], least.position);
    resolve(seen_.place[q.index], least.position);
    scale = std::max(scale, least.way * seen_.way[q.index]);
  }
  if (q.sort == Sort::velocity) resolve(std::min(seen_.relative[q.index], seen_.least_slide[q.index]), least.velocity);
  const double foreseen = of(foreseen_, q);
  scale = std::max(scale, foreseen);
  scale = block_scales_.raise(q, block_scales_.limit(q, scale));
  if (!stands_alone(q)) scale = std::max(scale, numerics::scale_floor * largest[static_cast<std::size_t>(q.sort)]);
  if (q.sort != Sort::deflection) return scale;
  // Limited by the scale of the force: near a reversal a nanometre may matter, in sliding a metre does not.
  const double stiffness = std::abs(slope[q.index]);
  const double own = std::max(seen_.force[q.index], stiffness * foreseen);
  const double by_force = std::max(own, numerics::scale_floor * largest[static_cast<std::size_t>(Sort::force)]);
  if (by_force > 0 && stiffness > 0) scale = std::min(scale, by_force / stiffness);
  return seen_.hops(q.index) ? seen_.hop_share(q.index) * scale : scale;
}

Tolerances::LeastShares Tolerances::least_shares() const {
  const auto share = [&](double least, double grains) {
    return std::max(least, grains * std::numeric_limits<double>::epsilon() / accuracy_.local());
  };
  return {.velocity = share(numerics::relative_motion_share, numerics::relative_velocity_ulps),
          .position = share(numerics::relative_motion_share, numerics::relative_position_ulps),
          .way = share(numerics::distance_share, numerics::distance_ulps)};
}

void Tolerances::update(double t, const std::vector<double>& yp, const Dae::View& view) {
  const std::vector<double>& slope = dae_->slopes();
  roundoff_.find(view, slope, seen_);
  // Time is known to half an ulp: changes within that cannot be resolved.
  const double grain = numerics::time_change_ulps * std::numeric_limits<double>::epsilon() * std::abs(t);
  const BySort largest = find_largest(slope);
  const double relative = accuracy_.local(), velocity = largest[static_cast<std::size_t>(Sort::velocity)];
  accuracy_.largest_velocity = velocity;
  block_scales_.find(*dae_, view, seen_, foreseen_, largest[static_cast<std::size_t>(Sort::force)], relative);
  const LeastShares least = least_shares();
  const UnknownRoundoff::At now{t, step_, begin_};
  std::optional<BySort> to_come;  // rarely needed
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const Unknown& q = unknowns_[i];
    double scale = scale_of(q, largest, least, slope);
    if (scale == 0) {
      if (!to_come) to_come = scales_to_come(std::max(ahead_, t - begin_), largest);
      scale = (*to_come)[static_cast<std::size_t>(q.sort)];
    }
    const double asked = std::max(relative * slider_shares_.of(i) * scale, numerics::least_step_tolerance * std::min(scale, size_[i]));
    const double stopping = q.sort == Sort::velocity ? stopping_.limit(q.index) : std::numeric_limits<double>::infinity();
    tolerance_[i] = roundoff_.raise(i, asked, size_[i], now, grain * std::abs(yp[i]), stopping);
    // A displacement has the error of its velocity over the time for which scales are foreseen.
    if (q.sort == Sort::deflection || q.sort == Sort::position) tolerance_[i] = std::max(tolerance_[i], accuracy_.relative * velocity * ahead_);
  }
  if (!dae_->positions().integrated.empty()) loosen_positions();
  balance_followers_.raise(tolerance_, slope, roundoff_, seen_, relative);
  dead_bands_.find(tolerance_, slope);
}

/// A position integrates a velocity, of which Newton's iteration leaves a share of its tolerance as an error.
void Tolerances::loosen_positions() {
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const Unknown& q = unknowns_[i];
    if (q.sort != Sort::position || stands_alone(q)) continue;
    const int velocity = dae_->indices().velocity[at(static_cast<NodeId>(q.index))];
    const double most = numerics::position_loosening * accuracy_.local() * of(seen_.unknown, q);
    if (velocity >= 0) tolerance_[i] = std::max(tolerance_[i], std::min(most, step_ * tolerance_[at(velocity)]));
  }
}

}  // namespace rheonet
