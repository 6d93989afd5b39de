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
// The same of a difference of two velocities, over the next step, which may be twice as long as the last.
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
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t, int part) {
    double& largest = rounding_at_rest_[at(part)];
    largest = std::max(largest, law.velocity_at(i, force_rounding_[at(part)]));
  });
}

/// What it is of the velocity at present.
void Tolerances::find_rounding_now(const Dae::View& view) {
  rounding_now_ = plain_rounding_;
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t r, int part) {
    const double f = std::abs(view.rate_force[r]), rounding = force_rounding_[at(part)];
    double& largest = rounding_now_[at(part)];
    largest = std::max(largest, law.velocity_at(i, f + rounding) - law.velocity_at(i, f));
  });
}

/// Where both ends of a branch move almost alike its own velocity is the rounding of theirs, and so is what a step adds to
/// its deflection: the end of a branch hangs free, say, or a thin gel rides on thick oil.
void Tolerances::find_difference_rounding(double t, const Dae::View& view) {
  const double grain = difference_grains * std::numeric_limits<double>::epsilon() * (t - reached_);
  reached_ = t;
  for (std::size_t j = 0; j < difference_rounding_.size(); ++j) {
    const Branch& b = dae_->structure().deflections[j];
    difference_rounding_[j] = grain * std::min(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
  }
}

}  // namespace rheonet
