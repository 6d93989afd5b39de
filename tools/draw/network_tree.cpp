#include "tools/draw/network_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/network/component.hpp"
#include "tools/draw/mesh_order.hpp"

namespace rheonet::draw {
namespace {

struct Vertex {
  bool there = false;   ///< not yet part of a block
  bool loaded = false;  ///< something stands at it: a mass, a drive
  bool driven = false;
  std::vector<int> edges;
  std::vector<Block> grounded;  ///< ways from it to ground
  std::vector<Block> tails;     ///< ways from it that end in a node of their own
};

struct Edge {
  NodeId from, to;  ///< as its block has them to the left and to the right
  Block block;
};

/// Takes a network apart, from single elements to ever larger blocks.
class Reduction {
 public:
  explicit Reduction(const Scene& scene) : vertices_(scene.nodes.size()), scene_(scene) {
    for (std::size_t i = 0; i < scene.elements.size(); ++i) add(static_cast<int>(i));
  }

  Forest forest() {
    for (NodeId n = 1; n < static_cast<NodeId>(vertices_.size()); ++n)
      if (vertex(n).there && !seen(n)) take_apart(component_of(n));
    for (Block& row : rows_at_ground_) forest_.rows.push_back(std::move(row));
    return std::move(forest_);
  }

 private:
  Vertex& vertex(NodeId n) { return vertices_[static_cast<std::size_t>(n)]; }
  Edge& edge(int e) { return edges_[static_cast<std::size_t>(e)]; }
  NodeId other_end(int e, NodeId n) { return edge(e).from == n ? edge(e).to : edge(e).from; }
  bool seen(NodeId n) const { return seen_.size() > static_cast<std::size_t>(n) && seen_[static_cast<std::size_t>(n)]; }

  void add(int index) {
    const SceneElement& element = scene_.elements[static_cast<std::size_t>(index)];
    const Role role = components()[static_cast<std::size_t>(element.declaration)]->role;
    if (role == Role::block) return;
    if (element.at) {
      Vertex& at = vertex(element.a);
      at.there = at.loaded = true;
      at.driven = at.driven || role == Role::motion || role == Role::force;
      if (element.a == ground && rows_at_ground_.empty()) rows_at_ground_.push_back(Block::of_node(ground));
      return;
    }
    add_between(Block::of_element(index, element.a, element.b));
    if (element.support == ground) return;
    Block support = Block::of_element(index, element.b, element.support);
    support.of_support = true;
    add_between(support);
  }

  void add_between(const Block& block) {
    const NodeId a = block.left, b = block.right;
    vertex(a).there = vertex(b).there = true;
    if (a == ground && b == ground) {
      rows_at_ground_.push_back(Block::in_row({ground, {}}, block, {ground, {}}, true, true));
    } else if (a == ground || b == ground) {
      add_grounded(a == ground ? b : a, block);
    } else {
      add_edge({a, b, block});
    }
  }

  void add_edge(Edge added) {
    const int e = static_cast<int>(edges_.size());
    vertex(added.from).edges.push_back(e);
    vertex(added.to).edges.push_back(e);
    edges_.push_back(std::move(added));
  }
  void add_grounded(NodeId n, Block block) {
    if (block.left != n) block.reverse();
    std::vector<Block>& grounded = vertex(n).grounded;
    if (grounded.empty())
      grounded.push_back(std::move(block));
    else
      grounded.front() = Block::in_parallel(std::move(grounded.front()), std::move(block));
  }
  void drop_edge(int e) {
    for (const NodeId n : {edge(e).from, edge(e).to}) std::erase(vertex(n).edges, e);
  }
  /// Takes an edge away; its block, seen from n.
  Block take_edge(int e, NodeId n) {
    drop_edge(e);
    Block block = std::move(edge(e).block);
    if (edge(e).from != n) block.reverse();
    return block;
  }

  std::vector<NodeId> component_of(NodeId start) {
    seen_.resize(vertices_.size());
    std::vector<NodeId> nodes{start};
    seen_[static_cast<std::size_t>(start)] = true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (const int e : vertex(nodes[i]).edges) {
        const NodeId next = other_end(e, nodes[i]);
        if (seen_[static_cast<std::size_t>(next)]) continue;
        seen_[static_cast<std::size_t>(next)] = true;
        nodes.push_back(next);
      }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  /// Where the drawing begins: what a prescribed motion drives, else what a force does; -1 if nothing does.
  NodeId driven_of(const std::vector<NodeId>& nodes) const {
    for (const Role wanted : {Role::motion, Role::force})
      for (const SceneElement& element : scene_.elements)
        if (components()[static_cast<std::size_t>(element.declaration)]->role == wanted && element.at &&
            std::binary_search(nodes.begin(), nodes.end(), element.a))
          return element.a;
    return -1;
  }

  bool merge_parallel(NodeId n) {
    std::map<NodeId, int> first;  // edge to each neighbour
    bool merged = false;
    for (const int e : std::vector<int>(vertex(n).edges)) {
      const auto [found, is_new] = first.emplace(other_end(e, n), e);
      if (is_new) continue;
      Edge& kept = edge(found->second);
      kept.block = Block::in_parallel(std::move(kept.block), take_edge(e, kept.from));
      merged = true;
    }
    return merged;
  }

  Station station(NodeId n) {
    Vertex& v = vertex(n);
    v.there = false;
    Station made{n, {}};
    for (Block& way : v.grounded) made.hanging.push_back(closed(std::move(way)));
    for (Block& tail : v.tails) made.hanging.push_back(std::move(tail));
    return made;
  }
  /// A way to ground with its wall.
  static Block closed(Block way) {
    const NodeId from = way.left;
    return Block::in_row({from, {}}, std::move(way), {ground, {}}, false, true);
  }
  /// Two rows, of which one ends with the station that the other begins with: that of the first one is the one that
  /// counts.
  static Block joined(Block first, Block second) {
    Station middle = std::move(first.stations.back());
    if (!first.parts.empty() && !second.parts.empty())
      return Block::in_series(std::move(first), std::move(middle), std::move(second));
    Block& whole = first.parts.empty() ? second : first;
    whole.opens = first.opens;
    whole.closes = second.closes;
    (first.parts.empty() ? whole.stations.front() : whole.stations.back()) = std::move(middle);
    return std::move(whole);
  }
  /// A row whose last station has ways that hang from it: the first of them goes straight on.
  static Block straight_on(Block row) {
    std::vector<Block>& hanging = row.stations.back().hanging;
    if (hanging.empty()) return row;
    Block way = std::move(hanging.front());
    hanging.erase(hanging.begin());
    return joined(std::move(row), std::move(way));
  }

  /// Which nodes may become stations of a row: others only where these do not help. A driven node is an end, if possible.
  enum Stage { plain, with_branches, driven_too };

  /// A node that two edges meet at becomes a station of a row.
  bool in_series(NodeId n, Stage stage) {
    Vertex& v = vertex(n);
    const bool branches = !v.grounded.empty() || !v.tails.empty();
    if (v.edges.size() != 2 || (branches && stage < with_branches) || (v.driven && stage < driven_too)) return false;
    int before = v.edges[0], behind = v.edges[1];
    if (other_end(before, n) == other_end(behind, n)) return merge_parallel(n);
    // A long row grows at its end, which costs least: each part that is put before it moves all others.
    if (edge(behind).block.parts.size() > edge(before).block.parts.size()) std::swap(before, behind);
    const NodeId from = other_end(before, n), to = other_end(behind, n);
    Block second = take_edge(behind, n), first = take_edge(before, from);
    add_edge({from, to, Block::in_series(std::move(first), station(n), std::move(second))});
    return true;
  }

  /// A node without mass that an edge and a way to ground meet at: both are a way to ground of its neighbour.
  bool in_series_with_ground(NodeId n, bool loaded_too) {
    constexpr int most_levels = 4;  // of parallels within parallels: deeper ones are drawn as a ladder
    Vertex& v = vertex(n);
    if (v.edges.size() != 1 || v.grounded.size() != 1 || !v.tails.empty() || (v.loaded && !loaded_too) ||
        (!loaded_too && v.grounded.front().levels() >= most_levels))
      return false;
    const NodeId neighbour = other_end(v.edges[0], n);
    Block way = std::move(v.grounded.front());
    v.grounded.clear();
    Block first = take_edge(v.edges[0], neighbour);
    add_grounded(neighbour, Block::in_series(std::move(first), station(n), std::move(way)));
    return true;
  }

  void reduce(std::vector<NodeId>& nodes, NodeId start) {
    for (Stage stage = plain;;) {
      bool changed = false;
      for (const NodeId n : nodes) {
        if (!vertex(n).there) continue;
        changed = merge_parallel(n) || changed;
        if (n != start && (in_series_with_ground(n, false) || in_series(n, stage))) changed = true;
      }
      std::erase_if(nodes, [this](NodeId n) { return !vertex(n).there; });
      if (!changed && stage == driven_too) return;
      stage = changed ? plain : stage == plain ? with_branches : driven_too;
    }
  }

  bool is_row(const std::vector<NodeId>& nodes) {
    std::size_t ends = 0;
    for (const NodeId n : nodes) {
      if (vertex(n).edges.size() > 2) return false;
      ends += vertex(n).edges.size();
    }
    return ends / 2 + 1 == nodes.size();
  }

  /// Makes a node with a single edge part of a way that hangs from its neighbour; false if there is no such node.
  bool absorb_end(const std::vector<NodeId>& nodes, NodeId start) {
    for (const NodeId n : nodes) {
      Vertex& v = vertex(n);
      if (n == start || v.edges.size() != 1) continue;
      if (in_series_with_ground(n, true)) return true;
      const NodeId neighbour = other_end(v.edges[0], n);
      Block way = take_edge(v.edges[0], neighbour);
      vertex(neighbour).tails.push_back(
          straight_on(Block::in_row({neighbour, {}}, std::move(way), station(n), false, true)));
      return true;
    }
    return false;
  }

  void take_apart(std::vector<NodeId> nodes) {
    const NodeId start = driven_of(nodes);
    reduce(nodes, start);
    while (!is_row(nodes)) {
      if (!absorb_end(nodes, start)) return make_mesh(nodes, start);
      reduce(nodes, start);
    }
    make_row(nodes, start);
  }

  /// At which end a row begins: where it is driven; else where it does not go to ground.
  NodeId first_of(const std::vector<NodeId>& nodes, NodeId start) {
    NodeId first = -1;
    for (const NodeId n : nodes) {
      if (vertex(n).edges.size() > 1) continue;
      if (n == start) return n;
      if (first < 0 || (vertex(n).grounded.empty() && !vertex(first).grounded.empty())) first = n;
    }
    return first;
  }

  void make_row(const std::vector<NodeId>& nodes, NodeId start) {
    NodeId at = first_of(nodes, start);
    const bool driven = vertex(at).driven;
    Block row = Block::of_node(at);
    row.stations.front() = station(at);
    while (!vertex(at).edges.empty()) {
      const int e = vertex(at).edges.front();
      const NodeId next = other_end(e, at);
      Block part = Block::in_row({at, {}}, take_edge(e, at), station(next), false, true);
      row = joined(std::move(row), std::move(part));
      at = next;
    }
    std::vector<Block>& hanging = row.stations.front().hanging;
    if (!driven && !hanging.empty() && (!row.parts.empty() || hanging.size() > 1)) {
      Block left = std::move(hanging.front());
      hanging.erase(hanging.begin());
      left.reverse();
      Station middle = std::move(row.stations.front());
      left.stations.back() = std::move(middle);
      row = joined(std::move(left), std::move(row));
    }
    forest_.rows.push_back(straight_on(std::move(row)));
  }

  void make_mesh(const std::vector<NodeId>& nodes, NodeId start) {
    Mesh mesh;
    std::vector<int> place(vertices_.size(), -1);
    std::vector<NodeId> all = nodes;
    const bool grounded =
        std::any_of(nodes.begin(), nodes.end(), [&](NodeId n) { return !vertex(n).grounded.empty(); });
    if (grounded) all.push_back(ground);
    for (std::size_t i = 0; i < all.size(); ++i) place[static_cast<std::size_t>(all[i])] = static_cast<int>(i);
    const auto add = [&](NodeId from, NodeId to, Block block) {
      mesh.links.push_back(
          {place[static_cast<std::size_t>(from)], to < 0 ? -1 : place[static_cast<std::size_t>(to)], std::move(block)});
    };
    for (const NodeId n : nodes) {
      Vertex& v = vertex(n);
      for (const int e : std::vector<int>(v.edges)) {
        const NodeId to = other_end(e, n);
        add(n, to, take_edge(e, n));
      }
      for (Block& way : v.grounded) add(n, ground, std::move(way));
      for (Block& tail : v.tails) add(n, -1, std::move(tail));
      v.grounded.clear();
      v.tails.clear();
    }
    for (const NodeId n : all) mesh.stations.push_back(n == ground ? Station{ground, {}} : station(n));
    put_in_order(mesh, start < 0 ? 0 : place[static_cast<std::size_t>(start)], grounded);
    forest_.meshes.push_back(std::move(mesh));
  }

  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::vector<bool> seen_;
  std::vector<Block> rows_at_ground_;
  Forest forest_;
  const Scene& scene_;
};

/// Parallel parts from top to bottom as the netlist has them.
void sort_parallels(Block& block) {
  for (Block& part : block.parts) sort_parallels(part);
  for (Station& station : block.stations)
    for (Block& way : station.hanging) sort_parallels(way);
  if (block.kind != Block::Kind::parallel) return;
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t i = 0; i < block.parts.size(); ++i) order.emplace_back(block.parts[i].first_element(), i);
  std::sort(order.begin(), order.end());
  std::vector<Block> parts;
  for (const auto& [first, i] : order) parts.push_back(std::move(block.parts[i]));
  block.parts = std::move(parts);
}

/// On which side of its second end the first end of an element belongs: 1 left, -1 right, 0 either. Positions increase to the right. The
/// first end of a stop with an upper bound alone strikes the second one from the left.
int side_of(const SceneElement& element) {
  const std::vector<Parameter>& parameters = declarations()[static_cast<std::size_t>(element.declaration)]->parameters;
  const auto given = [&](const char* name) {
    for (std::size_t k = 0; k < parameters.size() && k < element.values.size(); ++k)
      if (parameters[k].name == name) return std::isfinite(element.values[k]);
    return false;
  };
  return int{given("upper")} - int{given("lower")};
}

/// How many elements of a part stand on the wrong side, less those that stand on the right one.
int on_wrong_side(const Block& block, const Scene& scene) {
  int sum = 0;
  for (const Block& part : block.parts) sum += on_wrong_side(part, scene);
  if (block.kind != Block::Kind::element || block.of_support) return sum;
  const SceneElement& element = scene.elements[static_cast<std::size_t>(block.element)];
  return sum + (block.left == element.a ? -side_of(element) : side_of(element));
}

}  // namespace

Forest forest_of(const Scene& scene) {
  Forest forest = Reduction(scene).forest();
  for (Block& row : forest.rows) {
    if (on_wrong_side(row, scene) > 0) row.reverse();
    sort_parallels(row);
  }
  for (Mesh& mesh : forest.meshes)
    for (Mesh::Link& link : mesh.links) sort_parallels(link.block);
  return forest;
}

}  // namespace rheonet::draw
