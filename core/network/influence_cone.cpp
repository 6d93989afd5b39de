#include "core/network/influence_cone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/component.hpp"
#include "core/network/linear_law.hpp"
#include "core/network/reductions.hpp"

namespace rheonet {

namespace {

constexpr int unreached = std::numeric_limits<int>::max();

/// An element, as it acts on masses at rest.
struct Quiet {
  enum class Kind : char { none, mass, spring, dashpot, other };
  Kind kind = Kind::other;
  double value = 0;  ///< mass [kg], stiffness [N/m] or damping [N s/m]
};

/// The last result of find_quiet for one declaration.
struct Found {
  const SceneElement* element = nullptr;
  Quiet quiet = {};
};

bool elsewhere(double start) { return !std::isnan(start) && start != 0; }

class InfluenceSearch {
 public:
  explicit InfluenceSearch(const Scene& scene)
      : scene_(scene), found_(components().size()), mass_(scene.nodes.size(), 0), distance_(scene.nodes.size(), unreached) {}

  std::optional<InfluenceCone> find() {
    if (scene_.start_from != Scene::StartFrom::given || kept(scene_, Reduction::reach)) return {};
    look_at_elements();
    mark_what_begins();
    if (std::none_of(distance_.begin() + 1, distance_.end(), [](int d) { return d == unreached; })) return {};
    find_neighbours();
    go_out();
    return cut(farthest());
  }

 private:
  struct Branch { NodeId a, b; double stiffness, damping; };

  /// Caches by declaration: elements from one entry of a netlist mostly share their values (but effects may be left out of
  /// some).
  Quiet quiet(const SceneElement& e) {
    Found& before = found_[at(e.declaration)];
    if (!before.element || !scene_.without.empty() || !same_values(before.element->values, e.values)) before = {&e, find_quiet(e)};
    return before.quiet;
  }

  Quiet find_quiet(const SceneElement& e) const {
    const Role role = components()[at(e.declaration)]->role;
    if ((role != Role::mass && role != Role::deflection && role != Role::rate) || starts_by_itself(e)) return {};
    const Reduced law = law_of(scene_, e);
    if (!law.component) return {Quiet::Kind::none};
    if (law.component->role == Role::mass) return {Quiet::Kind::mass, law.values[0]};
    const std::optional<LinearLaw> linear = linear_law(law);
    if (!linear || linear->rest != 0) return {};
    return {linear->spring ? Quiet::Kind::spring : Quiet::Kind::dashpot, linear->coefficient};
  }

  void look_at_elements() {
    for (const SceneElement& e : scene_.elements) {
      const Quiet what = quiet(e);
      if (what.kind == Quiet::Kind::none) continue;
      if (!std::isfinite(what.value) || what.kind == Quiet::Kind::other || (!e.at && e.a == e.b)) {
        begin_at(e);
      } else if (what.kind == Quiet::Kind::mass) {
        mass_[at(e.a)] += what.value;
      } else {
        const bool spring = what.kind == Quiet::Kind::spring;
        branches_.push_back({e.a, e.b, spring ? what.value : 0, spring ? 0 : what.value});
      }
    }
  }

  void begin_at(NodeId node) {
    if (node != ground) distance_[at(node)] = 0;
  }
  void begin_at(const SceneElement& e) {
    for_each_node(e, [this](NodeId node) { begin_at(node); });
  }

  void mark_what_begins() {
    for (std::size_t n = 1; n < scene_.nodes.size(); ++n) {
      const SceneNode& node = scene_.nodes[n];
      if (!(mass_[n] > 0) || elsewhere(node.position) || elsewhere(node.velocity)) begin_at(static_cast<NodeId>(n));
    }
    for (const std::vector<Record>* records : {&scene_.records, &scene_.claimed, &scene_.sensed}) {
      for (const Record& record : *records) for_each_operand(scene_, record, [this](const Record& operand) { ask_for(operand); });
    }
  }

  void ask_for(const Record& record) {
    switch (record.subject) {
      case Record::Subject::node:
        begin_at(record.index);
        break;
      case Record::Subject::element:
        begin_at(scene_.elements[at(record.index)]);
        break;
      case Record::Subject::assembly: {
        const SceneAssembly& assembly = scene_.assemblies[at(record.index)];
        begin_at(assembly.a);
        begin_at(assembly.b);
        for (const SceneAssembly::Term& term : assembly.force) begin_at(scene_.elements[at(term.element)]);
        break;
      }
      case Record::Subject::block:
      case Record::Subject::expression:
        break;
    }
  }

  /// Branch number `neighbours_[k]`, first_[n] <= k < first_[n + 1], is at node n.
  void find_neighbours() {
    first_.assign(scene_.nodes.size() + 1, 0);
    for (const Branch& b : branches_) {
      for (const NodeId node : {b.a, b.b}) ++first_[at(node) + 1];
    }
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    neighbours_.resize(2 * branches_.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      for (const NodeId node : {branches_[k].a, branches_[k].b}) neighbours_[next[at(node)]++] = static_cast<int>(k);
    }
  }

  template <class Visit>
  void for_each_neighbour(NodeId node, Visit visit) const {
    for (std::size_t k = first_[at(node)]; k < first_[at(node) + 1]; ++k) {
      const Branch& b = branches_[at(neighbours_[k])];
      visit(b.a == node ? b.b : b.a, b);
    }
  }

  /// Breadth-first distances from the nodes where motion may begin. Ground does not transmit motion.
  void go_out() {
    std::vector<NodeId> front, next;
    for (std::size_t n = 1; n < distance_.size(); ++n) {
      if (distance_[n] == 0) front.push_back(static_cast<NodeId>(n));
    }
    for (int d = 1; !front.empty(); ++d) {
      next.clear();
      for (const NodeId node : front) {
        for_each_neighbour(node, [&](NodeId other, const Branch&) {
          if (other == ground || distance_[at(other)] != unreached) return;
          distance_[at(other)] = d;
          next.push_back(other);
        });
      }
      std::swap(front, next);
    }
  }

  int farthest() const {
    std::array<double, numerics::cone_weights> weight, a, b;
    for (std::size_t k = 0; k < numerics::cone_weights; ++k) weight[k] = 1 + numerics::cone_first_weight * std::pow(numerics::cone_weight_ratio, static_cast<double>(k));
    a.fill(0);  // a >= 0: a negative growth rate, from damping, is not relied upon
    b.fill(0);
    for (std::size_t n = 1; n < distance_.size(); ++n) {
      if (distance_[n] == 0 || distance_[n] == unreached) continue;
      struct { double nearer = 0, equal = 0, farther = 0, ground = 0; } c, k;
      for_each_neighbour(static_cast<NodeId>(n), [&](NodeId other, const Branch& branch) {
        const int d = distance_[at(other)];
        const auto add = [&](auto& sums, double value) {
          double& sum = other == ground ? sums.ground : d < distance_[n] ? sums.nearer : d > distance_[n] ? sums.farther : sums.equal;
          sum += value / mass_[n];
        };
        add(c, branch.damping);
        add(k, branch.stiffness);
      });
      for (std::size_t i = 0; i < numerics::cone_weights; ++i) {
        const double w = weight[i];
        a[i] = std::max(a[i], c.nearer * (w - 1) + c.farther * (1 / w - 1) - c.ground);
        b[i] = std::max(b[i], k.nearer * (w + 1) + k.farther * (1 / w + 1) + 2 * k.equal + k.ground);
      }
    }
    double least = unreached;
    for (std::size_t i = 0; i < numerics::cone_weights; ++i) {
      const double rate = (a[i] + std::sqrt(a[i] * a[i] + 4 * b[i])) / 2;
      least = std::min(least, std::ceil((rate * (scene_.stop - scene_.start) - std::log(numerics::cone_share)) / std::log(weight[i])));
    }
    return least < unreached ? static_cast<int>(least) : unreached - 1;
  }

  std::optional<InfluenceCone> cut(int farthest) const {
    const auto near = [&](NodeId node) { return node == ground || distance_[at(node)] <= farthest; };
    InfluenceCone reach{.node = std::vector<char>(scene_.nodes.size(), 0),
                .element = std::vector<char>(scene_.elements.size(), 0),
                .farthest = farthest};
    std::size_t nodes_beyond = 0;
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      reach.node[n] = near(static_cast<NodeId>(n));
      nodes_beyond += reach.node[n] ? 0 : 1;
    }
    if (nodes_beyond == 0 || static_cast<double>(nodes_beyond) < numerics::cone_worth * static_cast<double>(scene_.nodes.size())) return {};
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      const SceneElement& element = scene_.elements[e];
      const bool block = components()[at(element.declaration)]->role == Role::block;
      reach.element[e] = block || (near(element.a) && (element.at || near(element.b)));
      reach.beyond += reach.element[e] ? 0 : 1;
    }
    return reach;
  }

  const Scene& scene_;
  std::vector<Found> found_;     ///< of each declaration
  std::vector<double> mass_;     ///< of each node [kg]
  std::vector<int> distance_;    ///< of each node: number of elements between it and the nearest node where motion may begin
  std::vector<Branch> branches_; ///< linear ones
  std::vector<std::size_t> first_;
  std::vector<int> neighbours_;
};

}  // namespace

std::optional<InfluenceCone> influence_cone(const Scene& scene) { return InfluenceSearch(scene).find(); }

}  // namespace rheonet
