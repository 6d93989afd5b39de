#include "core/netlist/loose_nodes.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "core/netlist/diagnostic_list.hpp"

namespace rheonet {

namespace {

bool is_ground_in_capitals(const std::string& name) {
  const std::string_view wanted = "ground";
  return name != wanted && std::equal(name.begin(), name.end(), wanted.begin(), wanted.end(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

/// Names of all nodes other than `ends`, the ends of an element.
std::vector<std::string> ends_but(const Scene& scene, std::pair<NodeId, NodeId> ends) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const NodeId node = static_cast<NodeId>(n);
    if (node != ends.first && node != ends.second) names.push_back(node == ground ? "ground" : scene.nodes[n].name);
  }
  return names;
}

}  // namespace

std::vector<Diagnostic> loose_nodes(const Scene& scene) {
  struct Meeting { int count = 0; const SceneElement* only = nullptr; };
  std::vector<Meeting> meetings(scene.nodes.size());
  const auto meet = [&](NodeId node, const SceneElement& element) {
    Meeting& meeting = meetings[static_cast<std::size_t>(node)];
    ++meeting.count;
    meeting.only = &element;
  };
  for (const SceneElement& element : scene.elements) {
    for_each_node(element, [&](NodeId node) { meet(node, element); });
  }
  const auto loose = std::count_if(meetings.begin() + 1, meetings.end(), [](const Meeting& m) { return m.count == 1; });
  std::vector<Diagnostic> warnings;
  for (std::size_t n = 1; n < meetings.size(); ++n) {
    const SceneNode& node = scene.nodes[n];
    if (is_ground_in_capitals(node.name)) {
      warnings.push_back({Severity::warning, node.spot, "node `" + node.name + "` moves as any other does",
                          "the node that never moves is `ground`"});
      continue;
    }
    const bool inner = node.name.find('.') != std::string::npos;
    if (meetings[n].count != 1 || meetings[n].only->at || inner) continue;
    // An element whose other end is loose too is an error anyway: nothing determines its motion.
    const SceneElement& only = *meetings[n].only;
    const NodeId other = only.a == static_cast<NodeId>(n) ? only.b : only.a;
    if (other != ground && meetings[static_cast<std::size_t>(other)].count == 1) continue;
    std::string hint = loose > most_mistyped ? "" : did_you_mean(node.name, ends_but(scene, {static_cast<NodeId>(n), other}));
    if (hint.empty()) hint = "a node is free until something holds it; the one that never moves is `ground`";
    warnings.push_back({Severity::warning, node.spot,
                        "nothing but `" + meetings[n].only->name + "` is at node `" + node.name + "`: it carries no force", std::move(hint)});
  }
  return warnings;
}

}  // namespace rheonet
