#include "core/dae/start_balance.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

/// The initial value of this quantity that an element was given; NaN if none.
double initial(const Network& network, const Branch& branch, Quantity quantity) {
  const SceneElement& element = network.scene->elements[at(branch.element)];
  const Declaration& declaration = *declarations()[at(element.declaration)];
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    const Parameter& p = declaration.parameters[k];
    if (p.kind == Parameter::Kind::initial && p.quantity == quantity) return element.values[k];
  }
  return not_given;
}

class StartBalance {
 public:
  StartBalance(const Network& network, const Structure& structure, std::vector<char> fixed, State& state)
      : network_(network),
        structure_(structure),
        state_(state),
        fixed_(std::move(fixed)),
        tolerance_(std::max(numerics::equal_given_values, network.scene->accuracy)),
        around_(structure.groups.size()),
        lets_go_(structure.groups.size(), 0),
        before_(structure.groups.size(), 0),
        after_(before_) {
    // Masses, and nodes held by dashpots, have positions of their own: 0 unless given.
    for (std::size_t n = 0; n < fixed_.size(); ++n) fixed_[n] = fixed_[n] || structure.group[n] < 0;
    find_branches();
    find_loads();
  }

  std::vector<std::string> settle() {
    bool again = true;
    const auto sweep = [&](auto&& action) {
      for (std::size_t g = 0; g < around_.size(); ++g) again = action(static_cast<int>(g)) || again;
    };
    while (again) {
      again = false;
      sweep([this](int g) { return follow(g); });
      if (!again) sweep([this, &again](int g) { return !again && share(g); });
    }
    for (std::size_t g = 0; g < around_.size(); ++g) require_balance(static_cast<int>(g));
    return std::move(chosen_);
  }

 private:
  struct Member {
    DeflectionBatch* batch;
    std::size_t i;
    Branch ends;
    bool by_place;  ///< Its force follows from the displacement of its ends, not from an initial force.
    bool given;     ///< Its initial force or displacement is known.
    bool forced;    ///< The netlist gives it to the element itself (`f0`, `d0`); an f0 of 0 demands nothing of others.
    double step;    ///< Step of its displacement at the start, due to motions.
  };
  struct Side {
    int member;
    double sign;
  };

  void find_branches() {
    std::vector<double> step(structure_.kind.size(), 0);
    for (const Network::Motion& m : network_.motions) {
      if (m.position) step[at(m.node)] = m.signal.value(0) - state_.position[at(m.node)];
    }
    for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const Branch& b = network_.deflections[at(laws.first) + i];
        const bool by_place = laws.batch->starts_by_place(i);
        const double value = initial(network_, b, by_place ? Quantity::position : Quantity::force);
        const bool given = !std::isnan(value) || (by_place && fixed_[at(b.a)] && fixed_[at(b.b)]);
        const bool forced = !std::isnan(value) && (by_place || value != 0);
        const int member = static_cast<int>(members_.size());
        members_.push_back({laws.batch.get(), i, b, by_place, given, forced, step[at(b.a)] - step[at(b.b)]});
        const int ga = structure_.group[at(b.a)], gb = structure_.group[at(b.b)];
        if (ga == gb) continue;
        if (ga >= 0) around_[at(ga)].push_back({member, 1});
        if (gb >= 0) around_[at(gb)].push_back({member, -1});
      }
    }
    for (const Network::Slider& slider : network_.sliders) {
      if (slider.box.takes_force() || !slider.varying.empty() || slider.contact) let_go(slider.branch);
    }
    if (network_.bundles == nullptr) return;
    // A bundle contains sliders, and gives way as they do.
    for (std::size_t j = at(network_.first_bundle); j < network_.deflections.size(); ++j) let_go(network_.deflections[j]);
  }

  void let_go(const Branch& slides) {
    const int ga = structure_.group[at(slides.a)], gb = structure_.group[at(slides.b)];
    if (ga == gb) return;
    if (ga >= 0) lets_go_[at(ga)] = 1;
    if (gb >= 0) lets_go_[at(gb)] = 1;
  }

  void find_loads() {
    const auto add = [&](NodeId node, double before, double after) {
      if (node < 0 || structure_.group[at(node)] < 0) return;
      before_[at(structure_.group[at(node)])] += before;
      after_[at(structure_.group[at(node)])] += after;
    };
    for (const Network::Force& f : network_.forces) {
      const double before = f.signal.before(0), after = f.signal.value(0);
      add(f.a, before, after);
      add(f.b, -before, -after);
    }
  }

  double& deflection(const Member& m) { return state_.p[static_cast<std::size_t>(&m - members_.data())]; }

  double force(const Member& m, double p) const {
    double slope;
    return m.batch->force_along(m.i, p, 0, slope);
  }
  /// Force of a member with its displacement changed by `step`, if it follows that.
  double force(const Member& m, double p, double step) const {
    double slope;
    return m.by_place ? m.batch->force_along(m.i, p, step, slope) : force(m, p);
  }

  /// Sum of the forces that the members that are not given must have at this group.
  double left_to_others(int g) {
    double left = before_[at(g)];
    for (const Side& side : around_[at(g)]) {
      const Member& m = members_[at(side.member)];
      if (m.given) left -= side.sign * force(m, deflection(m));
    }
    return left;
  }

  bool any_forced(int g) const {
    return std::any_of(around_[at(g)].begin(), around_[at(g)].end(),
                       [&](const Side& s) { return members_[at(s.member)].forced; });
  }
  /// Whether a law that follows positions joins this group to another one whose position is given.
  bool beside_given_place(int g) const {
    const std::vector<Side> places = open(g, true);
    return std::any_of(places.begin(), places.end(), [&](const Side& s) {
      const NodeId other = far_end(s);
      return structure_.group[at(other)] >= 0 && fixed_[at(other)];
    });
  }

  std::vector<Side> open(int g, bool by_place) const {
    std::vector<Side> result;
    for (const Side& side : around_[at(g)]) {
      const Member& m = members_[at(side.member)];
      if (!m.given && m.by_place == by_place) result.push_back(side);
    }
    return result;
  }

  /// If one value is left open at a group with an initial force, it follows: its position, or another initial force.
  bool follow(int g) {
    if (lets_go_[at(g)] || !(any_forced(g) || beside_given_place(g))) return false;
    const std::vector<Side> places = open(g, true), forces = open(g, false);
    if (!places.empty()) return place(g);
    if (!any_forced(g) || forces.size() != 1) return false;
    return demand(g, forces.front(), left_to_others(g));
  }

  /// If several initial forces are left open, each takes an equal part.
  bool share(int g) {
    if (!any_forced(g) || lets_go_[at(g)] || !open(g, true).empty()) return false;
    const std::vector<Side> forces = open(g, false);
    if (forces.empty()) return false;
    const double each = left_to_others(g) / static_cast<double>(forces.size());
    bool any = false;
    for (const Side& side : forces) any = demand(g, side, each) || any;
    return any;
  }

  bool demand(int g, const Side& side, double sum) {
    Member& m = members_[at(side.member)];
    const double f = side.sign * sum;
    if (f != 0) {
      const double p = m.batch->start_with(m.i, f);
      if (std::isnan(p)) return false;
      state_.offset[static_cast<std::size_t>(&m - members_.data())] += deflection(m) - p;
      deflection(m) = p;
      if (!(std::abs(force(m, p) - f) <= tolerance_ * std::abs(f))) report(g);
      chosen_.push_back(
          fmt::format("element `{}` starts with a force of {}: it has no f0, and has to balance what is given at node "
                      "`{}`",
                      network_.name_of(m.ends), with_unit(*network_.scene, network_.element_of(m.ends), f, Quantity::force), name(g)));
    }
    m.given = m.forced = true;
    return true;
  }

  /// Groups joined by laws that follow their positions, and the laws around them.
  struct Region {
    std::vector<int> groups = {};
    std::unordered_map<int, int> number = {};  ///< of each group: its index in `groups`
    bool anchored = false;          ///< such a law joins it to a known position
    std::vector<Side> places = {};  ///< those laws, each once
    std::vector<Side> forces = {};  ///< initial forces that are left open, between it and the rest
  };

  /// Empty if one of its groups cannot move as a whole: a node there has a position, or a slider may give way.
  std::optional<Region> region_of(int g) const {
    Region region{.groups = {g}, .number = {{g, 0}}};
    for (std::size_t k = 0; k < region.groups.size(); ++k) {
      const int group = region.groups[k];
      if (lets_go_[at(group)]) return {};
      for (const NodeId node : structure_.groups[at(group)].nodes) {
        if (fixed_[at(node)]) return {};
      }
      for (const Side& side : open(group, true)) {
        const NodeId other = far_end(side);
        if (fixed_[at(other)]) {
          region.anchored = true;
        } else if (region.number.try_emplace(structure_.group[at(other)], static_cast<int>(region.groups.size())).second) {
          region.groups.push_back(structure_.group[at(other)]);
        }
        if (fixed_[at(other)] || side.sign > 0) region.places.push_back(side);
      }
    }
    for (const int group : region.groups) {
      for (const Side& side : open(group, false)) {
        if (number_of(region, far_end(side)) < 0) region.forces.push_back(side);
      }
    }
    return region;
  }

  NodeId far_end(const Side& side) const {
    const Branch& b = members_[at(side.member)].ends;
    return side.sign > 0 ? b.b : b.a;
  }
  NodeId near_end(const Side& side) const {
    const Branch& b = members_[at(side.member)].ends;
    return side.sign > 0 ? b.a : b.b;
  }
  int number_of(const Region& region, NodeId node) const {
    const auto found = region.number.find(structure_.group[at(node)]);
    return found == region.number.end() ? -1 : found->second;
  }

  /// Shifts groups to where the laws that depend on their positions balance the rest. Initial forces left open are 0, unless
  /// nothing else carries the loads of the groups.
  bool place(int g) {
    const std::optional<Region> region = region_of(g);
    if (!region) return false;
    if (!region->anchored && !region->forces.empty()) {
      double left = 0;
      for (const int group : region->groups) left += left_to_others(group);
      for (const Side& side : region->forces) {
        if (!demand(structure_.group[at(near_end(side))], side, left / static_cast<double>(region->forces.size()))) return false;
      }
    }
    const Eigen::VectorXd shift = balanced_shifts(*region);
    if (!shift.allFinite()) return false;
    const auto shift_of = [&](NodeId node) {
      const int number = number_of(*region, node);
      return number < 0 ? 0.0 : shift[number];
    };
    for (std::size_t k = 0; k < region->groups.size(); ++k) {
      for (const Side& side : around_[at(region->groups[k])]) {
        if (side.sign < 0 && number_of(*region, far_end(side)) >= 0) continue;  // already visited from its other end
        Member& m = members_[at(side.member)];
        const double change = shift_of(m.ends.a) - shift_of(m.ends.b);
        (m.by_place && !m.given ? state_.p : state_.offset)[at(side.member)] += change;
        m.given = true;
      }
      for (const NodeId node : structure_.groups[at(region->groups[k])].nodes) {
        state_.position[at(node)] += shift[static_cast<Eigen::Index>(k)];
        fixed_[at(node)] = 1;
      }
    }
    return true;
  }

  /// Shift of each group of the region [m]; the first one stays if nothing anchors the region.
  Eigen::VectorXd balanced_shifts(const Region& region) {
    const auto size = static_cast<Eigen::Index>(region.groups.size());
    Eigen::VectorXd left(size), shift = Eigen::VectorXd::Zero(size);
    for (Eigen::Index k = 0; k < size; ++k) left[k] = left_to_others(region.groups[static_cast<std::size_t>(k)]);
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
    for (int n = 0; n < numerics::start_balance_iterations; ++n) {
      Eigen::VectorXd missing = left;
      std::vector<Eigen::Triplet<double>> stiffness;
      for (const Side& side : region.places) {
        Member& m = members_[at(side.member)];
        const int near = number_of(region, near_end(side)), far = number_of(region, far_end(side));
        double slope = 0;
        const double change = side.sign * (shift[near] - (far < 0 ? 0 : shift[far]));
        const double force = side.sign * m.batch->force_along(m.i, deflection(m), change, slope);
        missing[near] -= force;
        stiffness.emplace_back(near, near, slope);
        if (far < 0) continue;
        missing[far] += force;
        stiffness.emplace_back(far, far, slope);
        stiffness.emplace_back(near, far, -slope);
        stiffness.emplace_back(far, near, -slope);
      }
      if (!region.anchored) {
        std::erase_if(stiffness, [](const auto& entry) { return entry.row() == 0 || entry.col() == 0; });
        stiffness.emplace_back(0, 0, 1);
        missing[0] = 0;
      }
      Eigen::SparseMatrix<double> matrix(size, size);
      matrix.setFromTriplets(stiffness.begin(), stiffness.end());
      factors.compute(matrix);
      if (factors.info() != Eigen::Success) return Eigen::VectorXd::Constant(size, not_given);
      const Eigen::VectorXd change = factors.solve(missing);
      shift += change;
      if (!(change.cwiseAbs().maxCoeff() > numerics::last_digit_ulps * std::numeric_limits<double>::epsilon() * shift.cwiseAbs().maxCoeff())) break;
    }
    return shift;
  }

  /// Whether all branches of a group lead to one place.
  bool hangs(int g) const {
    const auto place = [&](const Side& s) {
      const NodeId node = structure_.rigid[at(far_end(s))];
      const int group = structure_.group[at(node)];
      return std::pair(group, group < 0 ? node : ground);
    };
    return std::all_of(around_[at(g)].begin(), around_[at(g)].end(), [&](const Side& s) { return place(s) == place(around_[at(g)].front()); });
  }

  void require_balance(int g) {
    // A loose end contradicts no given value, and neither does a node where a slider may give way.
    const bool loaded = before_[at(g)] != 0 || after_[at(g)] != 0;
    if (around_[at(g)].empty() || (!loaded && hangs(g)) || lets_go_[at(g)]) return;
    const auto all = [&](bool Member::*what) {
      return std::all_of(around_[at(g)].begin(), around_[at(g)].end(),
                         [&](const Side& s) { return members_[at(s.member)].*what; });
    };
    if (!all(&Member::given) || !(any_forced(g) || all(&Member::by_place))) return;
    double sum_before = -before_[at(g)], sum_after = -after_[at(g)];
    double magnitude = std::abs(before_[at(g)]) + std::abs(after_[at(g)]);
    for (const Side& side : around_[at(g)]) {
      const Member& m = members_[at(side.member)];
      const double p = deflection(m), now = force(m, p), then = force(m, p, m.step);
      sum_before += side.sign * now;
      sum_after += side.sign * then;
      magnitude += std::max(std::abs(now), std::abs(then));
    }
    // Balanced before the first event, or after it.
    if (std::min(std::abs(sum_before), std::abs(sum_after)) > tolerance_ * magnitude) report(g);
  }

  const std::string& name(int g) const { return network_.node_name(structure_.groups[at(g)].nodes.front()); }

  [[noreturn]] void report(int g) {
    std::string forces;
    Spot spot = network_.spot_of_node(structure_.groups[at(g)].nodes.front());
    int first = std::numeric_limits<int>::max();
    for (const Side& side : around_[at(g)]) {
      const Member& m = members_[at(side.member)];
      if (m.forced && m.ends.element < first) spot = network_.spot_of(first = m.ends.element);
      forces += fmt::format("{}`{}` {}with {}", forces.empty() ? "" : ", ", network_.name_of(m.ends),
                            forces.empty() ? "begins " : "",
                            with_unit(*network_.scene, network_.element_of(m.ends), force(m, deflection(m)), Quantity::force));
    }
    throw SimulationError(
        spot, fmt::format("the initial forces at node `{}` do not balance, and it has no mass: {}; leave one "
                          "of the start values (`f0`, `d0`, a position) out, or make them fit",
                          name(g), forces));
  }

  const Network& network_;
  const Structure& structure_;
  State& state_;
  std::vector<char> fixed_;
  double tolerance_;                       ///< Forces within the accuracy asked for agree.
  std::vector<Member> members_;            ///< For each deflection branch.
  std::vector<std::vector<Side>> around_;  ///< For each group: the branches that lead away.
  std::vector<char> lets_go_;              ///< For each group: a slider there may give way.
  std::vector<double> before_, after_;     ///< For each group: force applied just before and just after the start [N].
  std::vector<std::string> chosen_;
};

}  // namespace

std::vector<std::string> balance_start(const Network& network, const Structure& classified, std::vector<char> fixed,
                                       State& state) {
  return StartBalance(network, classified, std::move(fixed), state).settle();
}

}  // namespace rheonet
