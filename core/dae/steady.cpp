#include "core/dae/steady.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/dae/convex.hpp"
#include "core/dae/rate_law.hpp"

namespace rheonet {

namespace {

// Forces that balance, and values that agree, but for this share of their magnitudes do so.
constexpr double rounding = 1e-12;
// A law at its bound has this share of its slope below: it is let go in the direction in which its force stays.
constexpr double slope_at_bound = 1e-6;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Sets of nodes that something joins.
class Sets {
 public:
  explicit Sets(std::size_t n) : leader_(n) { std::iota(leader_.begin(), leader_.end(), 0); }
  NodeId find(NodeId node) {
    while (leader_[at(node)] != node) node = leader_[at(node)] = leader_[at(leader_[at(node)])];
    return node;
  }
  void join(const Branch& b) { leader_[at(find(b.a))] = find(b.b); }

 private:
  std::vector<NodeId> leader_;
};

class Settling {
 public:
  Settling(const Network& network, const Structure& classified, double t, Start& begin)
      : network_(network),
        structure_(classified),
        drive_(begin.drive),
        state_(begin.state),
        resting_(network.scene->start_from == Scene::StartFrom::rest),
        t_(t),
        velocity_(classified.kind.size(), 0),
        load_(velocity_),
        load_magnitude_(velocity_),
        broken_(network.sliders.size(), 0) {
    result_.modes.slider.assign(network.sliders.size(), Modes::stuck);
    result_.slider_force.assign(network.sliders.size(), 0);
    for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        laws_.push_back({laws.batch.get(), i, laws.batch->steady(i), 0});
      }
    }
  }

  SteadyStart go() {
    enter_drive();
    refuse_stretching();
    hold_what_is_free();
    Sets rigid(velocity_.size());
    for_each_rigid([&](const Branch& b) { rigid.join(b); });
    lead(rigid);
    while (find_velocities()) {
    }
    if (resting_) refuse_motion();
    find_places();
    note_what_gave_way();
    return std::move(result_);
  }

 private:
  struct Law {
    DeflectionBatch* batch;
    std::size_t i;
    DeflectionBatch::Steady steady;
    int direction;
    bool rigid() const { return std::isinf(steady.rest); }
    /// Its force follows from its deflection: a spring, or friction that sticks.
    bool elastic() const { return steady.rest > 0 && direction == 0; }
    double force(double w) const {
      return std::clamp(steady.rest * direction + steady.slope * w, -steady.bound, steady.bound);
    }
  };

  std::string kind() const { return resting_ ? "no state of rest to start from" : "no steady state to start from"; }
  std::string with_unit(double x, Quantity quantity) const {
    return fmt::format("{:.6g} {}", x, unit_of(quantity, network_.scene->domain));
  }
  std::string name(const Branch& b) const { return network_.name_of(b); }
  static std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most = 5;
    std::string text;
    for (std::size_t k = 0; k < std::min(most, names.size()); ++k) text += fmt::format("{}`{}`", k ? ", " : "", names[k]);
    return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
  }
  void note(const std::string& text) {
    result_.notes.push_back((resting_ ? "start from rest: " : "steady start: ") + text);
  }

  bool known(NodeId node) const { return structure_.kind[at(node)] == Kind::known; }
  double difference(const Branch& b) const {
    const double va = velocity_[at(b.a)], vb = velocity_[at(b.b)], w = va - vb;
    return std::abs(w) <= rounding * std::max(std::abs(va), std::abs(vb)) ? 0 : w;
  }
  int slot(NodeId node) const { return structure_.rank[at(node)]; }
  /// Of the node that speaks for all that move with this one.
  int leader(NodeId node) const { return slot(leader_[at(node)]); }
  bool together(const Branch& b) const { return leader_[at(b.a)] == leader_[at(b.b)]; }
  bool held(NodeId node) const {
    return known(node) || std::find(pinned_.begin(), pinned_.end(), node) != pinned_.end();
  }

  /// One node of each set speaks for it: one whose velocity is given if there is one.
  void lead(Sets& sets) {
    std::vector<NodeId> first(velocity_.size(), -1);
    for (const bool given : {true, false}) {
      for (std::size_t n = 0; n < velocity_.size(); ++n) {
        NodeId& leader = first[at(sets.find(static_cast<NodeId>(n)))];
        if (leader < 0 && held(static_cast<NodeId>(n)) == given) leader = static_cast<NodeId>(n);
      }
    }
    leader_.resize(velocity_.size());
    for (std::size_t n = 0; n < velocity_.size(); ++n) leader_[n] = first[at(sets.find(static_cast<NodeId>(n)))];
  }

  /// Motions are where they are just after the start: a step there is over.
  void enter_drive() {
    drive_.enter(t_);
    drive_.evaluate(t_);
    for (std::size_t m = 0; m < network_.motions.size(); ++m) {
      const std::size_t n = at(network_.motions[m].node);
      const double step = drive_.steps()[m];
      state_.position[n] += step;
      for (std::size_t j = 0; step != 0 && j < laws_.size(); ++j) {
        const Branch& b = network_.deflections[j];
        const double moved = (at(b.a) == n ? step : 0) - (at(b.b) == n ? step : 0);
        laws_[j].batch->jump(laws_[j].i, state_.p[j], moved);
        state_.p[j] += moved;
      }
      if (!resting_) velocity_[n] = drive_.velocity[m];
      if (!resting_ && drive_.acceleration[m] != 0) changing_.push_back(network_.motions[m].element);
    }
    for (std::size_t k = 0; k < network_.forces.size(); ++k) {
      const Network::Force& force = network_.forces[k];
      for (const auto& [node, sign] : {std::pair{force.a, 1}, std::pair{force.b, -1}}) {
        if (node < 0) continue;
        load_[at(node)] += sign * drive_.force[k];
        load_magnitude_[at(node)] += std::abs(drive_.force[k]);
      }
      if (drive_.force_rate[k] != 0) changing_.push_back(force.element);
    }
    for (int element : changing_) {
      note(fmt::format("`{}` changes with time: the state is that under its value at the start, held",
                       network_.scene->elements[at(element)].name));
    }
  }

  bool rigid(std::size_t slider) const { return std::isinf(network_.sliders[slider].law.breakaway); }

  template <class Visit>
  void for_each_rigid(Visit visit) const {
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      if (laws_[j].rigid()) visit(network_.deflections[j]);
    }
    for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
      if (rigid(k)) visit(network_.sliders[k].branch);
    }
  }

  /// A spring whose ends move at different velocities for ever.
  void refuse_stretching() const {
    std::vector<std::vector<std::pair<NodeId, const Branch*>>> around(velocity_.size());
    for_each_rigid([&](const Branch& b) {
      around[at(b.a)].push_back({b.b, &b});
      around[at(b.b)].push_back({b.a, &b});
    });
    std::vector<const Branch*> from(velocity_.size(), nullptr);
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      const NodeId first = static_cast<NodeId>(n);
      if (!known(first)) continue;
      std::vector<NodeId> reached{first};
      std::vector<char> seen(velocity_.size(), 0);
      seen[n] = 1;
      for (std::size_t r = 0; r < reached.size(); ++r) {
        const NodeId node = reached[r];
        if (known(node) && velocity_[at(node)] != velocity_[n]) report_stretching(first, node, from);
        if (node != first && known(node)) continue;  // its own turn comes
        for (const auto& [other, branch] : around[at(node)]) {
          if (seen[at(other)]) continue;
          seen[at(other)] = 1;
          from[at(other)] = branch;
          reached.push_back(other);
        }
      }
    }
  }

  [[noreturn]] void report_stretching(NodeId first, NodeId last, const std::vector<const Branch*>& from) const {
    std::vector<std::string> path;
    for (NodeId node = last; node != first;) {
      const Branch& b = *from[at(node)];
      path.push_back(name(b));
      node = b.a == node ? b.b : b.a;
    }
    std::reverse(path.begin(), path.end());
    throw SimulationError(fmt::format(
        "{}: {} between `{}`, which moves at {}, and `{}`, at {}, would stretch for ever; make the velocities equal or "
        "put something between them that gives way",
        kind(), listed(path), network_.node_name(first), with_unit(velocity_[at(first)], Quantity::velocity),
        network_.node_name(last), with_unit(velocity_[at(last)], Quantity::velocity)));
  }

  /// What nothing joins to a prescribed motion or to ground keeps the velocity of its centre of mass.
  void hold_what_is_free() {
    Sets sets(velocity_.size());
    for (const Branch& b : network_.deflections) sets.join(b);
    for (const Branch& b : network_.rates) sets.join(b);
    for (const Network::Slider& s : network_.sliders) sets.join(s.branch);
    std::vector<char> held(velocity_.size(), 0);
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      if (known(static_cast<NodeId>(n))) held[at(sets.find(static_cast<NodeId>(n)))] = 1;
    }
    std::vector<double> load(velocity_.size(), 0), magnitude(load), momentum(load), mass(load);
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      const std::size_t set = at(sets.find(static_cast<NodeId>(n)));
      load[set] += load_[n];
      magnitude[set] += load_magnitude_[n];
      mass[set] += structure_.own_mass[n];
      momentum[set] += structure_.own_mass[n] * state_.velocity[n];
    }
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      if (held[n] || sets.find(static_cast<NodeId>(n)) != static_cast<NodeId>(n)) continue;
      if (std::abs(load[n]) > rounding * magnitude[n]) {
        std::vector<NodeId> nodes;
        for (std::size_t m = 0; m < velocity_.size(); ++m) {
          if (at(sets.find(static_cast<NodeId>(m))) == n) nodes.push_back(static_cast<NodeId>(m));
        }
        report_acceleration(nodes);
      }
      pinned_.push_back(static_cast<NodeId>(n));
      if (!resting_ && mass[n] > 0) velocity_[n] = momentum[n] / mass[n];
      note(fmt::format("nothing joins node `{}` to ground or to a motion: it moves at {}",
                       network_.node_name(static_cast<NodeId>(n)), with_unit(velocity_[n], Quantity::velocity)));
    }
  }

  [[noreturn]] void report_acceleration(const std::vector<NodeId>& nodes) const {
    std::vector<std::string> names, loads;
    for (NodeId node : nodes) names.push_back(network_.node_name(node));
    for (const Network::Force& force : network_.forces) {
      loads.push_back(network_.scene->elements[at(force.element)].name);
    }
    throw SimulationError(fmt::format(
        "{}: what is at node{} {} cannot take the force{} {} for ever, and would go ever faster; give it a dashpot or more "
        "friction, or apply less force",
        kind(), names.size() > 1 ? "s" : "", listed(names), loads.size() > 1 ? "s" : "", listed(loads)));
  }

  /// Velocities at which all forces balance when springs are rigid, friction has its full force in motion, and nothing
  /// accelerates. True if sliders have broken away under more than their force of sliding: then it is to be done again.
  bool find_velocities() {
    ConvexNetwork problem = velocity_problem();
    std::vector<int> law_branch(laws_.size(), -1), slider_branch(network_.sliders.size(), -1);
    double scale = 0;
    for (double f : load_magnitude_) scale = std::max(scale, f);
    for (const Law& law : laws_) {
      for (double f : {law.steady.rest, law.steady.bound}) scale = std::isfinite(f) ? std::max(scale, f) : scale;
    }
    if (scale == 0) scale = 1;
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const Branch& b = network_.deflections[j];
      const DeflectionBatch::Steady& s = laws_[j].steady;
      if (together(b)) continue;
      ConvexNetwork::Law law{.low = -s.rest, .high = s.rest, .backward = s.slope, .forward = s.slope};
      if (s.slope > 0 && std::isfinite(s.bound)) {
        law.beyond = [s](double w, double& slope) {
          const double f = s.slope * w;
          slope = std::abs(f) < s.bound ? s.slope : slope_at_bound * s.slope;
          return std::clamp(f, -s.bound, s.bound);
        };
      }
      law_branch[j] = problem.add(leader(b.a), leader(b.b), law);
    }
    for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
      const Network::Slider& s = network_.sliders[k];
      const double limit = broken_[k] ? s.law.coulomb : s.law.breakaway;
      if (!together(s.branch)) {
        slider_branch[k] = problem.add(leader(s.branch.a), leader(s.branch.b), {.low = -limit, .high = limit});
      }
    }
    add_rates(problem, scale);
    solve(problem);

    bool again = false;
    slip_.assign(network_.sliders.size(), 0);
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      slip_[k] = slider_branch[k] < 0 ? 0 : problem.direction(slider_branch[k]);
      const Slip& law = network_.sliders[k].law;
      if (slip_[k] == 0 || broken_[k] || law.breakaway == law.coulomb) continue;
      broken_[k] = again = true;
    }
    if (again) return true;
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      laws_[j].direction = laws_[j].steady.rest > 0 && law_branch[j] >= 0 ? problem.direction(law_branch[j]) : 0;
    }
    take_velocities(problem);
    refine_velocities(scale);
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const double w = difference(network_.deflections[j]);
      if (laws_[j].steady.rest == 0) laws_[j].direction = w > 0 ? 1 : w < 0 ? -1 : 0;
    }
    for (std::size_t k = 0; k < slip_.size(); ++k) result_.modes.slider[k] = static_cast<signed char>(slip_[k]);
    return false;
  }

  ConvexNetwork velocity_problem() const {
    ConvexNetwork problem(static_cast<int>(velocity_.size()));
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      const NodeId node = static_cast<NodeId>(n);
      if (leader_[n] != node) {
        problem.fix(slot(node), 0);  // its leader speaks for it
      } else if (held(node)) {
        problem.fix(slot(node), velocity_[n]);
      }
      if (load_[n] != 0) problem.load(leader(node), load_[n]);
    }
    return problem;
  }

  void add_rates(ConvexNetwork& problem, double scale) const {
    for (const Laws<RateBatch>& laws : network_.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const Branch& b = network_.rates[at(laws.first) + i];
        if (!together(b)) problem.add(leader(b.a), leader(b.b), rate_law(*laws.batch, i, scale));
      }
    }
  }

  void solve(ConvexNetwork& problem) const {
    const ConvexNetwork::Outcome outcome = problem.solve();
    if (outcome == ConvexNetwork::Outcome::solved) return;
    if (outcome == ConvexNetwork::Outcome::unbounded) {
      std::vector<NodeId> nodes;
      for (int runaway : problem.runaways()) {
        const auto found = std::find(structure_.rank.begin(), structure_.rank.end(), runaway);
        nodes.push_back(static_cast<NodeId>(found - structure_.rank.begin()));
      }
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      report_acceleration(nodes);
    }
    throw SimulationError(kind() + " was found: forces on what sticks or slips differ by rounding only");
  }

  void take_velocities(const ConvexNetwork& problem) {
    for (std::size_t n = 0; n < velocity_.size(); ++n) velocity_[n] = problem.value(leader(static_cast<NodeId>(n)));
  }

  /// The same once more, with all that sticks rigid and all that slips a force: nothing is left of what has decided among
  /// equals. Where velocities are open without that, they stay as they are.
  void refine_velocities(double scale) {
    Sets joined(velocity_.size());
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      if (laws_[j].elastic()) joined.join(network_.deflections[j]);
    }
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      if (slip_[k] == 0) joined.join(network_.sliders[k].branch);
    }
    lead(joined);
    ConvexNetwork problem = velocity_problem();
    const auto push = [&](const Branch& b, double f) {
      problem.load(leader(b.a), -f);
      problem.load(leader(b.b), f);
    };
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const Branch& b = network_.deflections[j];
      const DeflectionBatch::Steady& s = laws_[j].steady;
      const double w = difference(b);
      if (together(b)) continue;
      if (s.rest > 0) {
        push(b, s.rest * laws_[j].direction);
      } else if (std::abs(s.slope * w) >= s.bound) {
        push(b, std::copysign(s.bound, w));
      } else {
        problem.add(leader(b.a), leader(b.b), {.backward = s.slope, .forward = s.slope});
      }
    }
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      if (slip_[k] != 0) push(network_.sliders[k].branch, slip_[k] * network_.sliders[k].law.coulomb);
    }
    add_rates(problem, scale);
    if (problem.solve() == ConvexNetwork::Outcome::solved) take_velocities(problem);
  }

  void refuse_motion() const {
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      if (velocity_[n] == 0) continue;
      throw SimulationError(fmt::format(
          "{}: the forces are more than holds node `{}`, which goes on at {} under them; start from \"steady\", or apply "
          "less force",
          kind(), network_.node_name(static_cast<NodeId>(n)), with_unit(velocity_[n], Quantity::velocity)));
    }
  }

  /// Displacements from the start values to where the forces balance that go with the velocities.
  void find_places() {
    std::vector<double> load = load_;
    const auto push = [&](const Branch& b, double f) {
      load[at(b.a)] -= f;
      load[at(b.b)] += f;
    };
    for (const Laws<RateBatch>& laws : network_.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const Branch& b = network_.rates[at(laws.first) + i];
        push(b, laws.batch->force_at(i, difference(b)));
      }
    }
    Sets hang(velocity_.size());
    std::vector<std::string> sticking;
    std::vector<double> f(laws_.size(), 0);
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      Law& law = laws_[j];
      const Branch& b = network_.deflections[j];
      if (law.elastic()) {
        double slope = 0;
        f[j] = law.batch->force_along(law.i, state_.p[j], 0, slope);
        hang.join(b);
        if (!law.rigid()) sticking.push_back(name(b));
      } else {
        f[j] = law.force(difference(b));
        state_.p[j] = law.batch->settle(law.i, state_.p[j], f[j], law.direction);
      }
      push(b, f[j]);
    }
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      const Network::Slider& s = network_.sliders[k];
      if (slip_[k] == 0) {
        hang.join(s.branch);
        if (!rigid(k)) sticking.push_back(name(s.branch));
      } else {
        result_.slider_force[k] = slip_[k] * s.law.coulomb;
        push(s.branch, result_.slider_force[k]);
      }
    }
    if (!sticking.empty()) {
      note(listed(sticking) + (sticking.size() > 1 ? " stick: their forces are" : " sticks: its force is") +
           " what slow loading from the start values leaves");
    }

    ConvexNetwork problem(static_cast<int>(velocity_.size()));
    fix_places(problem, hang);
    for (std::size_t n = 0; n < load.size(); ++n) problem.load(slot(static_cast<NodeId>(n)), load[n]);
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const Law& law = laws_[j];
      if (!law.elastic()) continue;
      const double p = state_.p[j], f0 = f[j];
      problem.add(slot(network_.deflections[j].a), slot(network_.deflections[j].b),
                  {.backward = law.batch->slope(law.i, p, -1),
                   .forward = law.batch->slope(law.i, p, 1),
                   .rounding = std::abs(f0),
                   .beyond = [batch = law.batch, i = law.i, p, f0](double step, double& slope) {
                     return batch->force_along(i, p, step, slope) - f0;
                   }});
    }
    std::vector<int> slider_branch(slip_.size(), -1);
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      const Network::Slider& s = network_.sliders[k];
      if (slip_[k] != 0) continue;
      slider_branch[k] = problem.add(slot(s.branch.a), slot(s.branch.b), {.low = -s.law.breakaway, .high = s.law.breakaway});
    }
    solve(problem);
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      if (slip_[k] == 0) result_.slider_force[k] = problem.force(slider_branch[k]);
    }
    const auto moved = [&](NodeId node) { return problem.value(slot(node)); };
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const Branch& b = network_.deflections[j];
      const double step = moved(b.a) - moved(b.b);
      if (laws_[j].elastic()) {
        laws_[j].batch->jump(laws_[j].i, state_.p[j], step);
        state_.p[j] += step;
      } else {
        state_.offset[j] += step;
      }
    }
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      state_.position[n] += moved(static_cast<NodeId>(n));
    }
  }

  /// Of nodes that hang together, but on nothing whose place is given, one keeps its own.
  void fix_places(ConvexNetwork& problem, Sets& hang) {
    std::vector<char> placed(velocity_.size(), 0);
    const auto fix = [&](NodeId node) {
      problem.fix(slot(node), 0);
      placed[at(hang.find(node))] = 1;
    };
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      if (known(static_cast<NodeId>(n))) fix(static_cast<NodeId>(n));
    }
    std::vector<std::string> open;
    // One that the user has placed goes before any other.
    for (const bool given : {true, false}) {
      for (std::size_t n = 0; n < velocity_.size(); ++n) {
        const NodeId node = static_cast<NodeId>(n);
        if (placed[at(hang.find(node))] || std::isnan(network_.scene->nodes[n].position) == given) continue;
        fix(node);
        open.push_back(network_.node_name(node));
      }
    }
    if (open.empty()) return;
    note(fmt::format("no force says where {} {}: {} in the position of the start values", listed(open),
                     open.size() > 1 ? "are" : "is", open.size() > 1 ? "they start" : "it starts"));
  }

  /// Start values that the steady state contradicts.
  void note_what_gave_way() {
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      const SceneNode& node = network_.scene->nodes[n];
      state_.velocity[n] = velocity_[n];
      if (n == 0 || std::isnan(node.velocity) || known(static_cast<NodeId>(n))) continue;
      if (std::abs(node.velocity - velocity_[n]) <= rounding * std::abs(node.velocity)) continue;
      note(fmt::format("node `{}` moves at {}, not at its start value, {}", node.name,
                       with_unit(velocity_[n], Quantity::velocity), with_unit(node.velocity, Quantity::velocity)));
    }
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const SceneElement& element = network_.scene->elements[at(network_.deflections[j].element)];
      const std::vector<Parameter>& parameters = declarations()[at(element.declaration)]->parameters;
      double slope = 0;
      const double f = laws_[j].batch->force_along(laws_[j].i, state_.p[j], 0, slope);
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        const double f0 = element.values[k];
        if (parameters[k].kind != Parameter::Kind::initial || parameters[k].quantity != Quantity::force) continue;
        // That of a spring says where it is free of force.
        if (std::isnan(f0) || laws_[j].rigid() || std::abs(f - f0) <= rounding * std::abs(f0)) continue;
        note(fmt::format("`{}` has the force {}, not its start value, {}", element.name, with_unit(f, Quantity::force),
                         with_unit(f0, Quantity::force)));
      }
    }
  }

  const Network& network_;
  const Structure& structure_;
  Drive& drive_;
  State& state_;
  const bool resting_;
  const double t_;
  std::vector<Law> laws_;         ///< one for each deflection branch
  std::vector<double> velocity_;  ///< of each node
  std::vector<double> load_, load_magnitude_;  ///< applied at each node
  std::vector<NodeId> leader_;    ///< of each node: the one that speaks for all that move as it does
  std::vector<NodeId> pinned_;    ///< their velocity is given because nothing else gives one
  std::vector<char> broken_;      ///< of each slider: it has broken away
  std::vector<int> slip_;         ///< of each slider: its direction
  std::vector<int> changing_;     ///< elements: drives that do not stay as they are
  SteadyStart result_;
};

}  // namespace

SteadyStart settle(const Network& network, const Structure& classified, double t, Start& begin) {
  return Settling(network, classified, t, begin).go();
}

}  // namespace rheonet
