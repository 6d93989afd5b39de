#include "tests/wiring/catalogue.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "tests/support/random.hpp"
#include "tests/wiring/random_wiring.hpp"

namespace rheonet::test {

namespace {

using Drive = Wiring::Drive;

constexpr int random_trees = 500, random_graphs = 300, brake_trees = 400, freewheel_trees = 200, stop_trees = 250, gear_graphs = 500, stribeck_trees = 300, planetary_graphs = 200, mixed_graphs = 300, lossy_graphs = 200;
constexpr unsigned seed = 20260313;

constexpr std::array<std::string_view, 4> drive_names = {"velocity", "position", "force", "force on a mass"};

struct Shape { const char* name; Tree tree; };

std::vector<Shape> shapes() {
  const Tree a = Tree::of_leaf(0), b = Tree::of_leaf(1), c = Tree::of_leaf(2);
  return {
      {"two in series", Tree::series({a, b})},
      {"two in parallel", Tree::parallel({a, b})},
      {"three in series", Tree::series({a, b, c})},
      {"three in parallel", Tree::parallel({a, b, c})},
      {"first in series with two in parallel", Tree::series({a, Tree::parallel({b, c})})},
      {"two in parallel in series with last", Tree::series({Tree::parallel({a, b}), c})},
      {"first in parallel with two in series", Tree::parallel({a, Tree::series({b, c})})},
      {"two in series in parallel with last", Tree::parallel({Tree::series({a, b}), c})},
  };
}

class Maker {
 public:
  std::vector<Wiring> all() {
    for (const Shape& shape : shapes()) every_choice(shape);
    Random random(seed);
    for (int k = 0; k < random_trees; ++k) {
      Wiring w;
      w.tree = random_tree(random, 4 + k % 5);
      w.graph = wired(*w.tree);
      w.types = random_types(random, w.graph.branches.size());
      w.name = "tree " + described(*w.tree, w.types);
      add_random(std::move(w), random, k);
    }
    for (int k = 0; k < random_graphs; ++k) {
      Wiring w;
      w.graph = random_graph(random);
      w.types = random_types(random, w.graph.branches.size());
      w.name = "graph " + described(w.graph, w.types);
      add_random(std::move(w), random, k);
    }
    for (int k = 0; k < brake_trees + freewheel_trees; ++k) {
      const std::string special = k < brake_trees ? "brake" : "freewheel";
      Wiring w;
      w.tree = random_tree(random, 2 + k % 5);
      w.graph = wired(*w.tree);
      w.types = random_types(random, w.graph.branches.size());
      w.types[static_cast<std::size_t>(random.below(static_cast<int>(w.types.size())))] = special;
      w.name = special + " " + described(*w.tree, w.types);
      add_random(std::move(w), random, k);
    }
    for (int k = 0; k < stop_trees; ++k) {
      Wiring w;
      w.tree = random_tree(random, 2 + k % 5);
      w.graph = wired(*w.tree);
      w.types = random_types(random, w.graph.branches.size());
      for (int stops = 1 + k % 2; stops > 0; --stops) w.types[static_cast<std::size_t>(random.below(static_cast<int>(w.types.size())))] = "stop";
      w.name = "stop " + described(*w.tree, w.types);
      add_heavy(std::move(w), random);
    }
    for (int k = 0; k < gear_graphs; ++k) {
      Wiring w;
      w.graph = random_graph(random);
      w.types = random_types(random, w.graph.branches.size());
      // In the smallest graphs two gears could fix all nodes.
      for (int gears = w.graph.nodes > 5 ? 1 + k % 2 : 1; gears > 0; --gears) w.types[static_cast<std::size_t>(random.below(static_cast<int>(w.types.size())))] = "gear";
      if (k % 4 == 0) w.types[static_cast<std::size_t>(random.below(static_cast<int>(w.types.size())))] = "stop";
      w.name = "gear " + described(w.graph, w.types);
      add_heavy(std::move(w), random);
    }
    for (int k = 0; k < stribeck_trees; ++k) {
      Wiring w;
      w.tree = random_tree(random, 2 + k % 5);
      w.graph = wired(*w.tree);
      w.types = random_types(random, w.graph.branches.size());
      for (int sliders = 1 + k % 2; sliders > 0; --sliders) any_of(w.types, random) = "stribeck";
      w.name = "stribeck " + described(*w.tree, w.types);
      add_heavy(std::move(w), random);
    }
    for (int k = 0; k < planetary_graphs; ++k) {
      Wiring w;
      w.graph = random_graph(random);
      w.types = random_types(random, w.graph.branches.size());
      for (int gears = w.graph.nodes > 5 ? 1 + k % 2 : 1; gears > 0; --gears) any_of(w.types, random) = "planetary";
      w.name = "planetary " + described(w.graph, w.types);
      w.rotating.assign(node_count(w.graph), 1);
      add_heavy(std::move(w), random);
    }
    for (int k = 0; k < mixed_graphs; ++k) {
      Wiring w = of_two_domains(random);
      w.name = "domains " + described(w.graph, w.types);
      add_heavy(std::move(w), random);
    }
    for (int k = 0; k < lossy_graphs; ++k) {
      Wiring w;
      w.graph = random_graph(random);
      w.types = random_types(random, w.graph.branches.size());
      // Beside the friction of a gear at rest the laws would leave open how a cfm goes on.
      std::replace(w.types.begin(), w.types.end(), std::string("cfm"), std::string("vfm"));
      for (int gears = w.graph.nodes > 5 ? 1 + k % 2 : 1; gears > 0; --gears) any_of(w.types, random) = "lossy";
      w.name = "losses " + described(w.graph, w.types);
      // An impulse passes gears without losses: the driven node must not jump.
      std::vector<char> masses(node_count(w.graph), 1);
      add(std::move(w), std::move(masses), Drive::force_on_mass);
    }
    return std::move(wirings_);
  }

 private:
  void every_choice(const Shape& shape) {
    const Graph graph = wired(shape.tree);
    const std::size_t leaves = graph.branches.size();
    std::vector<std::size_t> choice(leaves, 0);
    for (;;) {
      Wiring w;
      w.tree = shape.tree;
      w.graph = graph;
      std::string list;
      for (const std::size_t c : choice) {
        w.types.emplace_back(law_types[c]);
        list += (list.empty() ? "" : ", ") + w.types.back();
      }
      w.name = std::string(shape.name) + "(" + list + ")";
      for (const bool masses : {false, true}) {
        if (masses && graph.nodes == 2) continue;
        for (int drive = 0; drive < 4; ++drive) add(w, std::vector<char>(node_count(graph), masses), Drive(drive));
      }
      std::size_t last = leaves;
      while (last > 0 && ++choice[last - 1] == law_types.size()) choice[--last] = 0;
      if (last == 0) return;
    }
  }

  static std::string& any_of(std::vector<std::string>& types, Random& random) {
    return types[static_cast<std::size_t>(random.below(static_cast<int>(types.size())))];
  }

  /// A random graph of which some nodes turn. One or two branches join them to those that do not.
  static Wiring of_two_domains(Random& random) {
    for (;;) {
      Wiring w;
      w.graph = random_graph(random);
      w.types = random_types(random, w.graph.branches.size());
      w.rotating.assign(node_count(w.graph), 0);
      for (std::size_t n = 2; n < w.rotating.size(); ++n) w.rotating[n] = random.below(2) == 0;
      std::set<std::pair<int, int>> joints;
      bool once = true;
      for (std::size_t k = 0; k < w.types.size(); ++k) {
        auto& [a, b] = w.graph.branches[k];
        if (a == 0 || b == 0 || w.rotating[static_cast<std::size_t>(a)] == w.rotating[static_cast<std::size_t>(b)]) continue;
        if (!w.rotating[static_cast<std::size_t>(a)]) std::swap(a, b);
        w.types[k] = random.below(2) == 0 ? "rack" : "screw";
        // Two of them between the same nodes would hold these.
        once = joints.insert({a, b}).second && once;
      }
      if (once && (joints.size() == 1 || joints.size() == 2)) return w;
    }
  }

  void add_random(Wiring w, Random& random, int k) {
    std::vector<char> masses(node_count(w.graph), 0);
    // A third of the scenes without masses, a third with a mass at each node, a third with some.
    for (char& m : masses) m = k % 3 == 2 ? random.below(2) == 0 : k % 3 == 1;
    add(std::move(w), std::move(masses), Drive(random.below(4)));
  }

  /// Adds a wiring with a mass at each node.
  void add_heavy(Wiring w, Random& random) {
    constexpr std::array<Drive, 3> drives{Drive::velocity, Drive::position, Drive::force_on_mass};
    std::vector<char> masses(node_count(w.graph), 1);
    add(std::move(w), std::move(masses), drives[static_cast<std::size_t>(random.below(3))]);
  }

  static std::size_t node_count(const Graph& graph) { return static_cast<std::size_t>(graph.nodes); }

  void add(Wiring w, std::vector<char> massive, Drive drive) {
    massive[0] = 0;
    massive[1] = drive == Drive::force_on_mass;
    w.number = static_cast<int>(wirings_.size());
    w.drive = drive;
    const auto masses = std::count(massive.begin() + 2, massive.end(), char{1});
    if (masses > 0) w.name += masses + 2 == w.graph.nodes ? ", masses" : ", some masses";
    w.name += ", " + std::string(drive_names[static_cast<std::size_t>(drive)]);
    w.massive = std::move(massive);
    wirings_.push_back(std::move(w));
  }

  std::vector<Wiring> wirings_;
};

}  // namespace

const std::vector<Wiring>& catalogue() {
  static const std::vector<Wiring> all = Maker().all();
  return all;
}

std::vector<int> sample(int count, unsigned seed) {
  Random random(seed);
  const int all = static_cast<int>(catalogue().size());
  std::vector<int> numbers;
  for (int k = 0; k < count; ++k) {
    const int from = static_cast<int>(std::int64_t{all} * k / count);
    const int to = static_cast<int>(std::int64_t{all} * (k + 1) / count);
    numbers.push_back(from + random.below(to - from));
  }
  return numbers;
}

std::vector<int> part(int i, int n) {
  std::vector<int> numbers;
  for (int k = 0; k < static_cast<int>(catalogue().size()); ++k) {
    if (Random(static_cast<std::uint64_t>(k)).below(n) == i) numbers.push_back(k);
  }
  return numbers;
}

}  // namespace rheonet::test
