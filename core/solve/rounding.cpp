#include <algorithm>
#include <cmath>
#include <limits>

#include "core/network/index.hpp"
#include "core/network/sets.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

namespace {

// Roundings of forces that balance (a sum of a few).
constexpr double force_grains = 16;
// Near rest an iteration takes the velocity of a dilatant law to and fro by so many times the rounding of its force: its
// slopes are of the velocities that it comes from.
constexpr double to_and_fro = 4;
// The same of a difference of two velocities.
constexpr double difference_grains = 8;

}  // namespace

/// The parts of the network that known nodes keep from each other: the noise of one does not reach the others.
void Tolerances::find_parts() {
  const Structure& structure = dae_->structure();
  Sets parts(structure.kind.size());
  const auto join = [&](const Branch& b) {
    if (structure.kind[at(b.a)] != Kind::known && structure.kind[at(b.b)] != Kind::known) parts.join(b.a, b.b);
  };
  for (const Branch& b : structure.deflections) join(b);
  for (const Branch& b : structure.rates) join(b);
  for (const Branch& b : structure.sliders) join(b);
  part_.clear();
  for (std::size_t n = 0; n < structure.kind.size(); ++n) part_.push_back(parts.find(static_cast<NodeId>(n)));
}

int Tolerances::part_of(const Branch& b) const {
  return part_[at(dae_->structure().kind[at(b.a)] == Kind::known ? b.b : b.a)];
}

template <class Visit>
void Tolerances::for_each_dilatant(Visit visit) const {
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      if (laws.batch->growth(i).exponent > 1) visit(*laws.batch, i, r, part_of(dae_->structure().rates[r]));
    }
  }
}

/// What rounding leaves of forces F that balance and of velocities V that are equal is noise: a velocity
/// eps (V + F/sqrt(k m)) at a mass, eps (V + F/B) at a node that dashpots hold, a deflection eps F/k, and what comes of
/// eps V until it has crept away. Without this a network in equilibrium would be followed into its rounding.
void Tolerances::find_rounding(const Dae::View& view) {
  constexpr double eps = force_grains * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  const std::size_t nodes = structure.kind.size();
  std::vector<double> force(nodes, 0), speed(nodes, 0), stiffness(nodes, 0), damping(nodes, 0);
  const auto add = [](std::vector<double>& sum, const Branch& b, double x) {
    sum[at(b.a)] += x;
    sum[at(b.b)] += x;
  };
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  const auto speed_of = [&](const Branch& b) {
    return std::max(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
  };
  const auto meet = [&](const Branch& b, double f) {
    if (known(b.a) && known(b.b)) return;
    const std::size_t part = at(part_[at(known(b.a) ? b.b : b.a)]);
    force[part] = std::max(force[part], std::abs(f));
    speed[part] = std::max(speed[part], speed_of(b));
  };
  const std::size_t count = structure.deflections.size();
  std::vector<double> f(count), df(count), c(count), dc(count);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&view.p[k], &f[k], &df[k], &c[k], &dc[k]);
  }
  for (std::size_t j = 0; j < count; ++j) {
    add(stiffness, structure.deflections[j], std::abs(df[j]));
    meet(structure.deflections[j], f[j]);
  }
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      meet(structure.rates[r], view.rate_force[r]);
      if (const double B = laws.batch->impulse(i); std::isfinite(B)) add(damping, structure.rates[r], B);
    }
  }
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) meet(structure.sliders[k], view.slider_force[k]);
  for (std::size_t n = 0; n < nodes; ++n) {
    double& largest = force[at(part_[n])];
    largest = std::max(largest, std::abs(view.applied[n]));
  }
  plain_rounding_.assign(nodes, 0);
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const auto [sort, k] = quantity_[i];
    rounding_[i] = 0;
    drift_[i] = {};
    if (sort == Sort::velocity) {
      const double impedance = std::sqrt(stiffness[k] * structure.mass[k]) + damping[k];
      const std::size_t part = at(part_[k]);
      rounding_[i] = eps * (speed[part] + (impedance > 0 ? force[part] / impedance : 0));
      plain_rounding_[part] = std::max(plain_rounding_[part], rounding_[i]);
    } else if (sort == Sort::deflection) {
      const Branch& b = structure.deflections[k];
      const bool alone = known(b.a) && known(b.b);
      const std::size_t part = at(part_[at(known(b.a) ? b.b : b.a)]);
      if (df[k] != 0) rounding_[i] += eps * (alone ? std::abs(f[k]) : force[part]) / std::abs(df[k]);
      drift_[i] = {eps * (alone ? speed_of(b) : speed[part]),
                   dc[k] != 0 ? 1 / std::abs(dc[k]) : std::numeric_limits<double>::infinity()};
    } else if (sort == Sort::force) {
      const Branch& b = structure.rates[k];
      rounding_[i] = eps * force[at(part_[at(known(b.a) ? b.b : b.a)])];
    }
  }
  rounding_at_rest_ = plain_rounding_;
  find_dashpot_rounding(view);
  find_force_rounding(view, df, force);
  find_rounding_now(view);
}

/// Where force goes with a power of the velocity above 1 the rounding of a force is a much larger one of the velocity, at
/// rest the most.
void Tolerances::find_force_rounding(const Dae::View& view, const std::vector<double>& df,
                                     const std::vector<double>& force) {
  constexpr double eps = force_grains * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  force_rounding_ = force;
  for (std::size_t j = 0; j < df.size(); ++j) {
    double& largest = force_rounding_[at(part_of(structure.deflections[j]))];
    largest = std::max(largest, std::abs(df[j] * view.p[j]));
  }
  for (double& rounding : force_rounding_) rounding *= eps;
  for (std::size_t r = 0; any_solved_ && r < dashpot_rounding_.size(); ++r) {
    if (dae_->force_unknown(static_cast<int>(r)) >= 0) continue;
    double& largest = force_rounding_[at(part_of(structure.rates[r]))];
    largest = std::max(largest, dashpot_rounding_[r]);
  }
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t, int part) {
    double& largest = rounding_at_rest_[at(part)];
    largest = std::max(largest, law.velocity_at(i, force_rounding_[at(part)]));
  });
}

/// What the rounding of the velocities at the ends of dashpots leaves of their forces, near rest a lot where they go with a
/// small power.
void Tolerances::find_dashpot_rounding(const Dae::View& view) {
  if (!any_solved_) return;
  constexpr double eps = force_grains * std::numeric_limits<double>::epsilon();
  for (std::size_t r = 0; r < dashpot_rounding_.size(); ++r) {
    const Branch& b = dae_->structure().rates[r];
    std::size_t i = 0;
    const RateBatch& law = network_.rate_of(static_cast<int>(r), i);
    const double speed = b.a == b.b ? 0 : std::max(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
    const double w = std::abs(view.rate_velocity[r]);
    dashpot_rounding_[r] = law.force_at(i, w + eps * speed) - law.force_at(i, w);
  }
}

/// What it is of the velocity at present.
void Tolerances::find_rounding_now(const Dae::View& view) {
  rounding_now_ = plain_rounding_;
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t r, int part) {
    const double f = std::abs(view.rate_force[r]), rounding = to_and_fro * force_rounding_[at(part)];
    double& largest = rounding_now_[at(part)];
    largest = std::max(largest, law.velocity_at(i, f + rounding) - law.velocity_at(i, f));
  });
}

/// Where both ends of a branch move almost alike its own velocity is the rounding of theirs: the end of a branch hangs free, say,
/// or a thin gel rides on thick oil.
void Tolerances::find_difference_rounding(const Dae::View& view) {
  constexpr double grain = difference_grains * std::numeric_limits<double>::epsilon();
  const auto rounding = [&](const Branch& b) {
    return grain * std::min(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
  };
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < difference_rounding_.size(); ++j) difference_rounding_[j] = rounding(structure.deflections[j]);
  for (std::size_t k = 0; k < slide_rounding_.size(); ++k) slide_rounding_[k] = rounding(structure.sliders[k]);
}

/// A force that is an unknown balances others: it cannot be known better than they are. The same of the deflection of what is
/// held still, which may take any force. Where all that such a force could balance may take any (or moves with a momentum of
/// its own, or as it is told to) it follows from a velocity, and has the rounding of that.
void Tolerances::loosen_balanced_forces() {
  if (!any_solved_) return;
  constexpr int passes = 3;  // such forces in a row
  const Structure& structure = dae_->structure();
  struct Noise { double sum = 0; int any = 0; };
  std::vector<Noise> fixed(structure.kind.size());
  for (std::size_t n = 0; n < fixed.size(); ++n) fixed[n].any = structure.kind[n] == Kind::known || structure.mass[n] > 0;
  struct Follower { Branch ends; int unknown; double per_unit, own, noise; bool any; };
  std::vector<Follower> followers;
  const auto add = [](std::vector<Noise>& noise, const Branch& b, double force, bool any) {
    if (b.a == b.b) return;
    for (NodeId node : {b.a, b.b}) {
      noise[at(node)].sum += any ? 0 : force;
      noise[at(node)].any += any;
    }
  };
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    const Branch& b = structure.rates[r];
    const double own = dashpot_rounding_[r];
    const int unknown = dae_->force_unknown(static_cast<int>(r));
    if (unknown < 0) add(fixed, b, own, false);
    if (unknown >= 0) followers.push_back({b, unknown, 1, own, own, false});
  }
  const std::vector<double>& slope = dae_->slopes();
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const Branch& b = structure.deflections[j];
    const int unknown = dae_->deflection_unknown(static_cast<int>(j));
    if (unknown < 0) continue;
    const double stiffness = std::abs(slope[j]), own = stiffness * tolerance_[at(unknown)];
    std::size_t i = 0;
    if (!network_.batch_of(static_cast<int>(j), i).holds(i)) {
      add(fixed, b, own, false);
    } else if (stiffness > 0) {
      followers.push_back({b, unknown, 1 / stiffness, own, own, true});
    }
  }
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<Noise> noise = fixed;
    for (const Follower& f : followers) add(noise, f.ends, f.noise, f.any);
    for (Follower& f : followers) {
      double others = std::numeric_limits<double>::infinity();
      for (NodeId node : {f.ends.a, f.ends.b}) {
        const Noise& here = noise[at(node)];
        if (here.any == f.any) others = std::min(others, std::max(0.0, here.sum - (f.any ? 0 : f.noise)));
      }
      f.noise = std::isinf(others) ? f.own : others;
      f.any = false;
    }
  }
  for (const Follower& f : followers) {
    double& tolerance = tolerance_[at(f.unknown)];
    tolerance = std::max(tolerance, f.per_unit * f.noise);
  }
}

}  // namespace rheonet
