#include "core/netlist/loose_nodes.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/netlist/mistakes.hpp"

namespace rheonet {

namespace {

bool is_ground_in_capitals(const std::string& name) {
  const std::string_view wanted = "ground";
  return name != wanted && std::equal(name.begin(), name.end(), wanted.begin(), wanted.end(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
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
    meet(element.a, element);
    if (!element.at) meet(element.b, element);
  }
  std::vector<std::string> others{"ground"};
  for (std::size_t n = 1; n < meetings.size(); ++n) {
    if (meetings[n].count > 1) others.push_back(scene.nodes[n].name);
  }
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
    // One that hangs nowhere is refused: nothing determines its motion.
    const SceneElement& only = *meetings[n].only;
    const NodeId other = only.a == static_cast<NodeId>(n) ? only.b : only.a;
    if (other != ground && meetings[static_cast<std::size_t>(other)].count == 1) continue;
    warnings.push_back({Severity::warning, node.spot,
                        "nothing but `" + meetings[n].only->name + "` is at node `" + node.name + "`: it carries no force",
                        did_you_mean(node.name, others)});
  }
  return warnings;
}

}  // namespace rheonet
