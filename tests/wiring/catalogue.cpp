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
    for (int k = 0; k < random_trees; ++k) add_random("tree", of_tree(random, 4 + k % 5), random, k);
    for (int k = 0; k < random_graphs; ++k) add_random("graph", of_graph(random), random, k);
    for (int k = 0; k < brake_trees + freewheel_trees; ++k) {
      const char* special = k < brake_trees ? "brake" : "freewheel";
      Wiring w = of_tree(random, 2 + k % 5);
      any_of(w, random) = special;
      add_random(special, std::move(w), random, k);
    }
    for (int k = 0; k < stop_trees; ++k) {
      Wiring w = of_tree(random, 2 + k % 5);
      replace(w, 1 + k % 2, "stop", random);
      add_heavy("stop", std::move(w), random);
    }
    for (int k = 0; k < gear_graphs; ++k) {
      Wiring w = of_graph(random);
      replace(w, gears_of(w, k), "gear", random);
      if (k % 4 == 0) any_of(w, random) = "stop";
      add_heavy("gear", std::move(w), random);
    }
    for (int k = 0; k < stribeck_trees; ++k) {
      Wiring w = of_tree(random, 2 + k % 5);
      replace(w, 1 + k % 2, "stribeck", random);
      add_heavy("stribeck", std::move(w), random);
    }
    for (int k = 0; k < planetary_graphs; ++k) {
      Wiring w = of_graph(random);
      replace(w, gears_of(w, k), "planetary", random);
      w.rotating.assign(node_count(w.graph), 1);
      add_heavy("planetary", std::move(w), random);
    }
    for (int k = 0; k < mixed_graphs; ++k) add_heavy("domains", of_two_domains(random), random);
    for (int k = 0; k < lossy_graphs; ++k) {
      Wiring w = of_graph(random);
      // Beside the friction of a gear at rest the laws would leave open how a cfm goes on.
      std::replace(w.types.begin(), w.types.end(), std::string("cfm"), std::string("vfm"));
      replace(w, gears_of(w, k), "lossy", random);
      // An impulse passes gears without losses: the driven node must not jump.
      add_heavy("losses", std::move(w), Drive::force_on_mass);
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

  static Wiring of_tree(Random& random, int leaves) {
    Wiring w;
    w.tree = random_tree(random, leaves);
    w.graph = wired(*w.tree);
    w.types = random_types(random, w.graph.branches.size());
    return w;
  }
  static Wiring of_graph(Random& random) {
    Wiring w;
    w.graph = random_graph(random);
    w.types = random_types(random, w.graph.branches.size());
    return w;
  }
  static std::string& any_of(Wiring& w, Random& random) {
    return w.types[static_cast<std::size_t>(random.below(static_cast<int>(w.types.size())))];
  }
  static void replace(Wiring& w, int count, const char* type, Random& random) {
    for (; count > 0; --count) any_of(w, random) = type;
  }
  /// One gear or two. In the smallest graphs two could fix all nodes.
  static int gears_of(const Wiring& w, int k) { return w.graph.nodes > 5 ? 1 + k % 2 : 1; }

  /// A random graph of which some nodes turn. One or two branches join them to those that do not.
  static Wiring of_two_domains(Random& random) {
    for (;;) {
      Wiring w = of_graph(random);
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

  void add_random(const std::string& kind, Wiring w, Random& random, int k) {
    std::vector<char> masses(node_count(w.graph), 0);
    // A third of the scenes without masses, a third with a mass at each node, a third with some.
    for (char& m : masses) m = k % 3 == 2 ? random.below(2) == 0 : k % 3 == 1;
    name(w, kind);
    add(std::move(w), std::move(masses), Drive(random.below(4)));
  }

  /// Adds a wiring with a mass at each node.
  void add_heavy(const std::string& kind, Wiring w, Random& random) {
    constexpr std::array<Drive, 3> drives{Drive::velocity, Drive::position, Drive::force_on_mass};
    add_heavy(kind, std::move(w), drives[static_cast<std::size_t>(random.below(3))]);
  }
  void add_heavy(const std::string& kind, Wiring w, Drive drive) {
    std::vector<char> masses(node_count(w.graph), 1);
    name(w, kind);
    add(std::move(w), std::move(masses), drive);
  }
  static void name(Wiring& w, const std::string& kind) { w.name = kind + " " + (w.tree ? described(*w.tree, w.types) : described(w.graph, w.types)); }

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
