#include "core/network/forest.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <queue>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/netlist/diagnostic_list.hpp"

namespace rheonet {

namespace {

/// "; did you mean ...?" for a node of one element alone, whose name may be misspelt there.
std::string other_node_meant(const Scene& scene, const std::string& name) {
  int elements = 0;
  for (const SceneElement& element : scene.elements) for_each_node(element, [&](NodeId node) { elements += scene.nodes[at(node)].name == name; });
  if (elements != 1) return "";
  std::vector<std::string> others;
  for (const SceneNode& node : scene.nodes) {
    if (node.name != name) others.push_back(node.name);
  }
  const std::string hint = did_you_mean(name, others);
  return hint.empty() ? "" : "; " + hint;
}

[[noreturn]] void report_undefined(const Network& network, const Structure& s, const std::vector<int>& lost) {
  std::vector<std::string> names;
  NodeId first = ground;
  for (int g : lost) {
    for (NodeId node : s.groups[at(g)].nodes) {
      if (first == ground || s.rank[at(node)] < s.rank[at(first)]) first = node;
      names.push_back(network.node_name(node));
    }
  }
  throw SimulationError(network.spot_of_node(first), fmt::format(
      "nothing determines the motion of node{} {}: no mass there, and no element that resists motion leads from there to "
      "ground, to a mass or to a prescribed motion; add one, or a mass{}",
      names.size() > 1 ? "s" : "", format_list(names), names.size() > 1 ? "" : other_node_meant(*network.scene, names.front())));
}

/// An element whose force is constant at present: it joins nodes, but its force does not depend on their motion.
struct Weak { int element; NodeId a, b; };

/// Spanning trees of the deflection branches, grown breadth first to keep loops short.
class Forest {
 public:
  Forest(const Network& network, Structure& s) : network_(network), s_(s), branches_of_(s.groups.size()) {
    reached_.assign(s.groups.size(), 0);
    for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const int j = laws.first + static_cast<int>(i);
        const Branch& b = s.deflections[at(j)];
        if (b.a == b.b || laws.batch->delay(i) > 0) continue;  // a delayed force does not depend on the present motion
        if (laws.batch->constant(i)) {
          if (!network.is_gauge(j)) weak_.push_back({b.element, b.a, b.b});
          continue;
        }
        const int ga = s.group[at(b.a)], gb = s.group[at(b.b)];
        if (ga >= 0) branches_of_[at(ga)].push_back(j);
        if (gb >= 0 && gb != ga) branches_of_[at(gb)].push_back(j);
      }
    }
    for (std::size_t k = 0; k < s.sliders.size(); ++k) {
      if (!s.stuck[k] && s.sliders[k].a != s.sliders[k].b) {
        weak_.push_back({s.sliders[k].element, s.sliders[k].a, s.sliders[k].b});
      }
    }
  }

  /// Grows trees from the nodes outside all groups; then starts at groups that no tree reaches, whose motion is indeterminate.
  void grow() {
    for (std::size_t g = 0; g < branches_of_.size(); ++g) {
      for (int j : branches_of_[g]) attach_from_outside(j);
    }
    spread();
    while (order_.size() < s_.groups.size()) {
      start_at_indeterminate_groups();
      spread();
    }
    renumber();
    if (!s_.indeterminate.empty()) solve_indeterminate_groups();
  }

 private:
  bool in_group(NodeId node) const { return s_.group[at(node)] >= 0; }

  void attach_from_outside(int j) {
    const Branch& b = s_.deflections[at(j)];
    if (in_group(b.a) && !in_group(b.b)) attach(j, b.a, b.b, 1);
    if (in_group(b.b) && !in_group(b.a)) attach(j, b.b, b.a, 1);
  }

  void attach(int branch, NodeId node, NodeId parent, int depth) {
    const int g = s_.group[at(node)];
    if (reached_[at(g)]) return;
    reached_[at(g)] = 1;
    Structure::Group& group = s_.groups[at(g)];
    group.tree_branch = branch;
    group.node = node;
    group.parent = parent;
    group.sign = s_.deflections[at(branch)].a == node ? 1 : -1;
    group.depth = depth;
    queue_.push(g);
  }

  void spread() {
    while (!queue_.empty()) {
      const int g = queue_.front();
      queue_.pop();
      order_.push_back(g);
      for (int j : branches_of_[at(g)]) {
        const Branch& b = s_.deflections[at(j)];
        if (s_.group[at(b.a)] == g && in_group(b.b)) attach(j, b.b, b.a, s_.groups[at(g)].depth + 1);
        if (s_.group[at(b.b)] == g && in_group(b.a)) attach(j, b.a, b.b, s_.groups[at(g)].depth + 1);
      }
    }
  }

  /// All groups connected with `first` through deflection branches.
  std::vector<int> piece(int first) const {
    std::vector<char> seen(s_.groups.size(), 0);
    std::vector<int> members{first};
    seen[at(first)] = 1;
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (int j : branches_of_[at(members[k])]) {
        for (NodeId node : {s_.deflections[at(j)].a, s_.deflections[at(j)].b}) {
          const int g = s_.group[at(node)];
          if (g < 0 || seen[at(g)]) continue;
          seen[at(g)] = 1;
          members.push_back(g);
        }
      }
    }
    return members;
  }

  void start_at_indeterminate_groups() {
    const auto lost = std::find(reached_.begin(), reached_.end(), 0);
    const int root = static_cast<int>(lost - reached_.begin());
    const std::vector<int> members = piece(root);
    Structure::IndeterminateGroups set;
    for (int g : members) {
      for (NodeId node : s_.groups[at(g)].nodes) set.nodes.push_back(node);
    }
    std::vector<char> inside(s_.kind.size(), 0);
    for (NodeId node : set.nodes) inside[at(node)] = 1;
    for (const Weak& w : weak_) {
      if (inside[at(w.a)] != inside[at(w.b)]) set.elements.push_back(w.element);
    }
    for (std::size_t n = 0; n < inside.size(); ++n) {
      if (s_.kind[n] == Kind::joined && inside[at(s_.rigid[n])]) set.nodes.push_back(static_cast<NodeId>(n));
    }
    if (set.elements.empty()) report_undefined(network_, s_, members);
    reached_[at(root)] = 1;
    s_.groups[at(root)].indeterminate = static_cast<int>(s_.indeterminate.size());
    s_.groups[at(root)].depth = 1;
    s_.indeterminate.push_back(std::move(set));
    queue_.push(root);
  }

  /// Numbers the groups by depth.
  void renumber() {
    std::vector<Structure::Group> sorted;
    sorted.reserve(order_.size());
    for (int g : order_) {
      for (NodeId node : s_.groups[at(g)].nodes) s_.group[at(node)] = static_cast<int>(sorted.size());
      sorted.push_back(std::move(s_.groups[at(g)]));
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Structure::Group& x, const Structure::Group& y) { return x.depth < y.depth; });
    for (std::size_t g = 0; g < sorted.size(); ++g) {
      for (NodeId node : sorted[g].nodes) s_.group[at(node)] = static_cast<int>(g);
    }
    s_.groups = std::move(sorted);
  }

  void solve_indeterminate_groups();

  const Network& network_;
  Structure& s_;
  std::vector<std::vector<int>> branches_of_;
  std::vector<Weak> weak_;
  std::vector<char> reached_;
  std::vector<int> order_;
  std::queue<int> queue_;
};

/// Terms by deflection branch, by node and by set of indeterminate groups.
struct Sum {
  std::map<int, double> flows, velocities, sets;

  void add(const Structure::Loop& loop, double factor) {
    for (const Structure::Term& x : loop.flows) flows[x.index] += factor * x.sign;
    for (const Structure::Term& x : loop.velocities) velocities[x.index] += factor * x.sign;
  }

  Structure::Loop loop(const Structure& s, int branch) const {
    Structure::Loop result{.branch = branch, .flows = {}, .velocities = {}};
    for (auto [j, sign] : flows) {
      if (std::abs(sign) > numerics::equal_values) result.flows.push_back({j, sign});
    }
    for (auto [node, sign] : velocities) {
      if (std::abs(sign) > numerics::equal_values && node != ground) result.velocities.push_back({node, sign});
    }
    std::sort(result.velocities.begin(), result.velocities.end(), [&](const Structure::Term& x, const Structure::Term& y) {
      return s.rank[at(x.index)] < s.rank[at(y.index)];
    });
    return result;
  }
};

/// Expresses -(v_a - v_b) along the trees, from both nodes up to where their paths meet.
Sum difference(const Structure& s, NodeId a, NodeId b) {
  Sum sum;
  // velocity(node) = v_node + base(group), base(group) = base(parent's group) + v_parent - v_node' + sign (p' + creep)
  const auto climb = [&](int group, double sign) {
    const Structure::Group& g = s.groups[at(group)];
    if (g.indeterminate >= 0) {
      sum.sets[g.indeterminate] -= sign;
      return -1;
    }
    sum.velocities[g.parent] -= sign;
    sum.velocities[g.node] += sign;
    sum.flows[g.tree_branch] -= sign * g.sign;
    return s.group[at(g.parent)];
  };
  sum.velocities[a] -= 1;
  sum.velocities[b] += 1;
  int ga = s.group[at(a)], gb = s.group[at(b)];
  while (ga != gb) {
    const int da = ga < 0 ? 0 : s.groups[at(ga)].depth, db = gb < 0 ? 0 : s.groups[at(gb)].depth;
    if (da >= db) {
      ga = climb(ga, 1);
    } else {
      gb = climb(gb, -1);
    }
  }
  return sum;
}

/// Least-squares condition of each set of indeterminate groups: the relative velocities of the elements that lead out of it sum to 0.
void Forest::solve_indeterminate_groups() {
  const auto count = static_cast<Eigen::Index>(s_.indeterminate.size());
  std::vector<int> set_of(s_.kind.size(), -1);
  for (std::size_t k = 0; k < s_.indeterminate.size(); ++k) {
    for (NodeId node : s_.indeterminate[k].nodes) set_of[at(node)] = static_cast<int>(k);
  }
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  std::vector<Sum> rest(s_.indeterminate.size());
  for (const Weak& w : weak_) {
    const int ta = set_of[at(w.a)], tb = set_of[at(w.b)];
    if (ta == tb) continue;
    const Sum term = difference(s_, w.a, w.b);
    for (const auto& [set, sign] : {std::pair{ta, 1.0}, std::pair{tb, -1.0}}) {
      if (set < 0) continue;
      for (auto [j, x] : term.flows) rest[at(set)].flows[j] += sign * x;
      for (auto [node, x] : term.velocities) rest[at(set)].velocities[node] += sign * x;
      for (auto [other, x] : term.sets) matrix(set, other) += sign * x;
    }
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(matrix);
  if (!lu.isInvertible()) {
    std::vector<int> lost;
    for (std::size_t g = 0; g < s_.groups.size(); ++g) {
      if (s_.groups[g].indeterminate >= 0) lost.push_back(static_cast<int>(g));
    }
    report_undefined(network_, s_, lost);
  }
  const Eigen::MatrixXd inverse = lu.inverse();
  for (Eigen::Index k = 0; k < count; ++k) {
    Sum sum;
    for (Eigen::Index l = 0; l < count; ++l) {
      for (auto [j, x] : rest[static_cast<std::size_t>(l)].flows) sum.flows[j] += inverse(k, l) * x;
      for (auto [node, x] : rest[static_cast<std::size_t>(l)].velocities) sum.velocities[node] += inverse(k, l) * x;
    }
    s_.indeterminate[static_cast<std::size_t>(k)].velocity = sum.loop(s_, -1);
  }
}

}  // namespace

void grow_forest(const Network& network, Structure& structure) { Forest(network, structure).grow(); }

Structure::Loop express(const Structure& s, NodeId a, NodeId b, int branch) {
  Sum sum = difference(s, a, b);
  if (branch >= 0) sum.flows[branch] += 1;
  for (auto [set, sign] : sum.sets) sum.add(s.indeterminate[at(set)].velocity, -sign);
  return sum.loop(s, branch);
}

}  // namespace rheonet
