#include <algorithm>
#include <cmath>
#include <limits>

#include "core/network/index.hpp"
#include "core/network/sets.hpp"
#include "core/network/velocity_grain.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

namespace {

// Roundings of forces that balance (a sum of a few).
constexpr double force_grains = 16;
// A difference of two velocities that is larger than this share of the smaller one is told from none, with something to spare.
constexpr double different = 2.2 * velocity_grain;
// Near rest an iteration takes the velocity of a dilatant law to and fro by so many times the rounding of its force: its
// slopes are of the velocities that it comes from.
constexpr double to_and_fro = 4;

double speed_at(const Dae::View& view, const Branch& b) {
  return std::max(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
}

/// How well forces are known that balance others [N]: as well as all the others at a node where they are the only one that is
/// not told by a law of its own.
class BalancedForces {
 public:
  explicit BalancedForces(const Structure& structure) : nodes_(structure.kind.size()) {
    // A momentum, or what moves as it is told to, takes any force.
    for (std::size_t n = 0; n < nodes_.size(); ++n) nodes_[n].any = structure.kind[n] == Kind::known || structure.mass[n] > 0;
  }

  void add_told(const Branch& b, double noise) {
    if (b.a == b.b) return;
    nodes_[at(b.a)].noise += noise;
    nodes_[at(b.b)].noise += noise;
  }
  void add(const Branch& b) {
    const int index = static_cast<int>(forces_.size());
    forces_.push_back({b, 0, b.a == b.b});
    if (b.a == b.b) return;
    for (const NodeId node : {b.a, b.b}) {
      nodes_[at(node)].forces.push_back(index);
      ++nodes_[at(node)].open;
    }
  }
  /// Follows every balance as far as it tells something.
  void find() {
    for (std::size_t n = 0; n < nodes_.size(); ++n) look_at(static_cast<NodeId>(n));
    follow();
  }
  bool found(std::size_t force) const { return forces_[force].found; }
  double noise(std::size_t force) const { return forces_[force].noise; }
  /// The same from what is known of one more.
  void tell(std::size_t force, double noise) {
    settle(forces_[force], noise);
    follow();
  }

 private:
  struct Force { Branch ends; double noise; bool found; };
  struct Node {
    double noise = 0;         ///< of the forces that are told or found
    int open = 0;             ///< the others
    bool any = false;
    std::vector<int> forces;  ///< all that had to be found
  };

  void look_at(NodeId node) {
    if (!nodes_[at(node)].any && nodes_[at(node)].open == 1) next_.push_back(node);
  }
  void settle(Force& force, double noise) {
    force.noise = noise;
    force.found = true;
    for (const NodeId node : {force.ends.a, force.ends.b}) {
      nodes_[at(node)].noise += noise;
      --nodes_[at(node)].open;
      look_at(node);
    }
  }
  void follow() {
    while (!next_.empty()) {
      const Node& node = nodes_[at(next_.back())];
      next_.pop_back();
      for (const int f : node.forces) {
        if (forces_[at(f)].found) continue;
        settle(forces_[at(f)], node.noise);
        break;
      }
    }
  }

  std::vector<Node> nodes_;
  std::vector<Force> forces_;
  std::vector<NodeId> next_;
};

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

/// Through dashpots and friction motion follows what moves at once, and jitters as time is rounded. Where there are only
/// springs it goes by the lengths of steps.
void Tolerances::find_jitter() {
  const Structure& structure = dae_->structure();
  std::vector<char> dissipates(structure.kind.size(), 0);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->creeps(i) || laws.batch->events(i) > 0) dissipates[at(part_of(structure.deflections[at(laws.first) + i]))] = 1;
    }
  }
  for (const Branch& b : structure.rates) dissipates[at(part_of(b))] = 1;
  for (const Branch& b : structure.sliders) dissipates[at(part_of(b))] = 1;
  jitters_.assign(quantity_.size(), 1);
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const Quantity& q = quantity_[i];
    if (q.sort == Sort::velocity || q.sort == Sort::position) jitters_[i] = dissipates[at(part_[q.index])];
    if (q.sort == Sort::deflection) jitters_[i] = dissipates[at(part_of(structure.deflections[q.index]))];
  }
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

/// Of each part of the network the largest force and velocity; of each node what is around it; of each deflection branch its law.
struct Tolerances::Loads {
  std::vector<double> force, speed;        ///< N, m/s
  std::vector<double> stiffness, damping;  ///< N/m, N s/m
  std::vector<double> f, df, dc;           ///< N, N/m, 1/s
};

Tolerances::Loads Tolerances::find_loads(const Dae::View& view) const {
  const Structure& structure = dae_->structure();
  const std::size_t nodes = structure.kind.size(), count = structure.deflections.size();
  const std::vector<double> none(nodes, 0), of_branches(count);
  Loads loads{none, none, none, none, of_branches, of_branches, of_branches};
  const auto add = [](std::vector<double>& sum, const Branch& b, double x) {
    sum[at(b.a)] += x;
    sum[at(b.b)] += x;
  };
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  const auto meet = [&](const Branch& b, double f) {
    if (known(b.a) && known(b.b)) return;
    const std::size_t part = at(part_of(b));
    loads.force[part] = std::max(loads.force[part], std::abs(f));
    loads.speed[part] = std::max(loads.speed[part], speed_at(view, b));
  };
  std::vector<double> creep(count);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&view.p[k], &loads.f[k], &loads.df[k], &creep[k], &loads.dc[k]);
  }
  for (std::size_t j = 0; j < count; ++j) {
    add(loads.stiffness, structure.deflections[j], std::abs(loads.df[j]));
    meet(structure.deflections[j], loads.f[j]);
  }
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      meet(structure.rates[r], view.rate_force[r]);
      if (const double B = laws.batch->impulse(i); std::isfinite(B)) add(loads.damping, structure.rates[r], B);
    }
  }
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) meet(structure.sliders[k], view.slider_force[k]);
  for (std::size_t n = 0; n < nodes; ++n) {
    double& largest = loads.force[at(part_[n])];
    largest = std::max(largest, std::abs(view.applied[n]));
  }
  return loads;
}

/// What rounding leaves of forces F that balance and of velocities V that are equal is noise: a velocity
/// eps (V + F/sqrt(k m)) at a mass, eps (V + F/B) at a node that dashpots hold, a deflection eps F/k, and what comes of
/// eps V until it has crept away. Without this a network in equilibrium would be followed into its rounding.
void Tolerances::find_rounding(const Dae::View& view) {
  constexpr double eps = force_grains * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  const Loads loads = find_loads(view);
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  plain_rounding_.assign(structure.kind.size(), 0);
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const auto [sort, k] = quantity_[i];
    rounding_[i] = 0;
    drift_[i] = {};
    if (sort == Sort::velocity) {
      const double impedance = std::sqrt(loads.stiffness[k] * structure.mass[k]) + loads.damping[k];
      const std::size_t part = at(part_[k]);
      rounding_[i] = eps * (loads.speed[part] + (impedance > 0 ? loads.force[part] / impedance : 0));
      plain_rounding_[part] = std::max(plain_rounding_[part], rounding_[i]);
    } else if (sort == Sort::deflection) {
      const Branch& b = structure.deflections[k];
      const bool alone = known(b.a) && known(b.b);
      const std::size_t part = at(part_of(b));
      const double f = std::abs(loads.f[k]), df = std::abs(loads.df[k]), dc = std::abs(loads.dc[k]);
      // At its bound friction has hardly any slope, and its deflection goes with others.
      const double slope = std::max(df, view.p[k] != 0 ? f / std::abs(view.p[k]) : 0);
      if (df != 0) rounding_[i] += eps * (alone ? f : loads.force[part]) / slope;
      drift_[i] = {eps * (alone ? speed_at(view, b) : loads.speed[part]), dc != 0 ? 1 / dc : std::numeric_limits<double>::infinity()};
    } else if (sort == Sort::force) {
      rounding_[i] = eps * loads.force[at(part_of(structure.rates[k]))];
    }
  }
  rounding_at_rest_ = plain_rounding_;
  find_dashpot_rounding(view);
  find_force_rounding(view, loads.df, loads.force);
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
    largest = std::max(largest, law.velocity_at(i, to_and_fro * force_rounding_[at(part)]));
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
    const double w = std::abs(view.rate_velocity[r]), grain = b.a == b.b ? 0 : eps * speed_at(view, b);
    dashpot_rounding_[r] = law.force_at(i, w + grain) - law.force_at(i, w);
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
  const auto rounding = [&](const Branch& b) {
    return different * std::min(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
  };
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < difference_rounding_.size(); ++j) difference_rounding_[j] = rounding(structure.deflections[j]);
  for (std::size_t k = 0; k < slide_rounding_.size(); ++k) slide_rounding_[k] = rounding(structure.sliders[k]);
}

/// A force that is an unknown balances others: it cannot be known better than they are. The same of the deflection of what is
/// held still, which may take any force. Where no balance tells the force of a dashpot it follows from a velocity, and has the
/// rounding of that.
void Tolerances::loosen_balanced_forces() {
  if (!any_balanced_) return;
  const Structure& structure = dae_->structure();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  BalancedForces forces(structure);
  struct Follower { int unknown; double per_unit, most; };
  std::vector<Follower> followers;
  std::vector<double> of_velocity;  // of those that are forces of dashpots
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    const int unknown = dae_->force_unknown(static_cast<int>(r));
    if (unknown < 0) {
      forces.add_told(structure.rates[r], dashpot_rounding_[r]);
    } else {
      forces.add(structure.rates[r]);
      followers.push_back({unknown, 1, infinite});
      of_velocity.push_back(dashpot_rounding_[r]);
    }
  }
  const std::vector<double>& slope = dae_->slopes();
  std::vector<double> way(structure.kind.size(), 0);  // of each node: the longest of the deflections there [m]
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const double seen = seen_[static_cast<std::size_t>(Sort::deflection)][j];
    for (const NodeId node : {structure.deflections[j].a, structure.deflections[j].b}) way[at(node)] = std::max(way[at(node)], seen);
  }
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->deflection_unknown(static_cast<int>(j));
    if (unknown < 0) continue;
    const double stiffness = std::abs(slope[j]);
    std::size_t i = 0;
    const bool held = network_.batch_of(static_cast<int>(j), i).holds(i);
    if (balanced_[j] < 0 && !held) {
      forces.add_told(structure.deflections[j], stiffness * tolerance_[at(unknown)]);
    } else {
      forces.add(structure.deflections[j]);
      // Where friction has hardly any slope it is its deflection that places its end.
      const double most = held ? infinite : local() * way[at(balanced_[j])];
      followers.push_back({unknown, stiffness > 0 ? 1 / stiffness : 0, most});
    }
  }
  forces.find();
  for (std::size_t k = 0; k < of_velocity.size(); ++k) {
    if (!forces.found(k)) forces.tell(k, of_velocity[k]);
  }
  for (std::size_t k = 0; k < followers.size(); ++k) {
    double& tolerance = tolerance_[at(followers[k].unknown)];
    if (forces.found(k)) tolerance = std::max(tolerance, std::min(followers[k].most, followers[k].per_unit * forces.noise(k)));
  }
}

}  // namespace rheonet
