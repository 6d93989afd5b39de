#include "core/netlist/scene_index.hpp"

namespace rheonet {

namespace {

// Limit that keeps the search for a mistyped name below a few milliseconds.
constexpr std::size_t most_paths = 10'000;

}  // namespace

SceneIndex::SceneIndex(const Scene& scene, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) found_.emplace(name, Found{});
  const auto note = [&](const auto& things, int Found::*member) {
    for (std::size_t i = 0; i < things.size(); ++i)
      if (const auto found = found_.find(things[i].name); found != found_.end())
        found->second.*member = static_cast<int>(i);
  };
  if (found_.empty()) return;
  note(scene.nodes, &Found::node);
  note(scene.elements, &Found::element);
  note(scene.assemblies, &Found::assembly);
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    const std::string& name = scene.elements[static_cast<std::size_t>(scene.blocks[i].element)].name;
    if (const auto found = found_.find(name); found != found_.end()) found->second.block = static_cast<int>(i);
  }
}

std::vector<std::string> known_paths(const Scene& scene, bool all) {
  std::vector<std::string> paths;
  const auto add = [&](const auto& things) {
    for (const auto& thing : things)
      if (paths.size() < most_paths) paths.push_back(thing.name);
  };
  add(scene.nodes);
  if (all) {
    for (const SceneElement& element : scene.elements)
      if (paths.size() < most_paths && element.part != SceneElement::Part::inner) paths.push_back(element.name);
    add(scene.assemblies);
  }
  return paths;
}

}  // namespace rheonet
