#include "core/network/parts.hpp"

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/network/component.hpp"

namespace rheonet {

namespace {

/// Union-find over the nodes, followed by the elements.
class Joiner {
 public:
  Joiner(const Scene& scene, const std::vector<char>& without, Between between)
      : scene_(scene), 
        sets_(scene.nodes.size() + scene.elements.size()),
        shared_(scene.nodes.size(), 0),
        ignored_(scene.elements.size(), 0),
        of_block_(scene.elements.size(), 0) {
    std::vector<char> fed(scene.elements.size(), 0);
    for (const SceneFeed& feed : scene.feeds) fed[at(feed.element)] = 1;
    shared_[ground] = 1;
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      if (between == Between::ground_and_given_motions && role(e) == Role::motion && !fed[e]) shared_[at(scene.elements[e].a)] = 1;
    }
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      if (role(e) != Role::block) join_ends(static_cast<int>(e));
    }
    for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
      if (!without.empty() && without[b]) {
        ignored_[at(scene.blocks[b].element)] = 1;
      } else {
        join_inputs(scene.blocks[b]);
      }
    }
    for (const SceneFeed& feed : scene.feeds) join_block(scene.blocks[at(feed.block)].element, feed.element);
  }

  bool shared(NodeId node) const { return shared_[at(node)] != 0; }
  /// The element belongs to no part: it acts on a shared node alone, or it is ignored. An element whose force a block senses,
  /// or that a block feeds, belongs to the part of the block, unless it is a motion, which all parts at its node share.
  bool bound(std::size_t e) const {
    if (ignored_[e]) return true;
    if (of_block_[e] && role(e) != Role::motion) return false;
    const SceneElement& element = scene_.elements[e];
    return element.at && role(e) != Role::block && shared(element.a);
  }
  int of_element(int e) { return sets_.find(static_cast<int>(scene_.nodes.size()) + e); }
  int of_node(NodeId node) { return sets_.find(node); }

 private:
  Role role(std::size_t e) const { return components()[at(scene_.elements[e].declaration)]->role; }
  void join(int e, int other) { sets_.join(static_cast<int>(scene_.nodes.size()) + e, static_cast<int>(scene_.nodes.size()) + other); }
  void join_block(int block, int e) {
    join(block, e);
    of_block_[at(e)] = 1;
  }
  void join_node(int e, NodeId node) {
    if (!shared(node)) sets_.join(static_cast<int>(scene_.nodes.size()) + e, node);
  }
  void join_ends(int e) {
    const SceneElement& element = scene_.elements[at(e)];
    for_each_node(element, [&](NodeId node) { join_node(e, node); });
  }
  void join_inputs(const SceneBlock& block) {
    for (const SceneBlock::Input& input : block.inputs) {
      if (input.from_block) {
        join(block.element, scene_.blocks[at(input.index)].element);
        continue;
      }
      const Record& record = scene_.sensed[at(input.index)];
      if (record.subject == Record::Subject::node) join_node(block.element, record.index);
      if (record.subject == Record::Subject::element) join_block(block.element, record.index);
      if (record.subject == Record::Subject::assembly) {
        const SceneAssembly& assembly = scene_.assemblies[at(record.index)];
        join_node(block.element, assembly.a);
        join_node(block.element, assembly.b);
        for (const SceneAssembly::Term& term : assembly.force) join_block(block.element, term.element);
      }
    }
  }

  const Scene& scene_;
  DisjointSets sets_;
  std::vector<char> shared_, ignored_, of_block_;
};

}  // namespace

Parts find_parts(const Scene& scene, const std::vector<char>& without, Between between) {
  Joiner joiner(scene, without, between);
  Parts parts{.of_element = std::vector<int>(scene.elements.size(), -1), .of_node = std::vector<int>(scene.nodes.size(), -1)};
  std::vector<int> number(scene.nodes.size() + scene.elements.size(), -1);
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    if (joiner.bound(e)) continue;
    int& part = number[at(joiner.of_element(static_cast<int>(e)))];
    if (part < 0) part = parts.count++;
    parts.of_element[e] = part;
  }
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (!joiner.shared(static_cast<NodeId>(n))) parts.of_node[n] = number[at(joiner.of_node(static_cast<NodeId>(n)))];
  }
  return parts;
}

}  // namespace rheonet
