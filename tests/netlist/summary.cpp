#include "tests/netlist/summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/netlist/fake_declarations.hpp"

namespace rheonet::test {

namespace {

const std::string& name(const Scene& scene, NodeId node) { return scene.nodes.at(static_cast<std::size_t>(node)).name; }

}  // namespace

std::string elements_of(const Scene& scene) {
  std::string text;
  for (const SceneElement& e : scene.elements) {
    text += fmt::format("{}: {} {}", e.name, fake_declarations()[static_cast<std::size_t>(e.declaration)]->type,
                        name(scene, e.a));
    if (!e.at) text += '-' + name(scene, e.b);
    for (const double value : e.values)
      if (!std::isnan(value)) text += fmt::format(" {:.9g}", value);
    for (const Signal& signal : e.signals) text += fmt::format(" ~{:.9g}", signal.value(0.25));
    text += '\n';
  }
  return text;
}

std::string assemblies_of(const Scene& scene) {
  std::string text;
  for (const SceneAssembly& assembly : scene.assemblies) {
    text += fmt::format("{}: {}-{} =", assembly.name, name(scene, assembly.a), name(scene, assembly.b));
    for (const SceneAssembly::Term& term : assembly.force)
      text += fmt::format(" {}{}", term.sign > 0 ? '+' : '-', scene.elements.at(static_cast<std::size_t>(term.element)).name);
    text += '\n';
  }
  return text;
}

std::string nodes_of(const Scene& scene) {
  std::string text;
  for (std::size_t i = 1; i < scene.nodes.size(); ++i) text += (i > 1 ? " " : "") + scene.nodes[i].name;
  return text;
}

std::string records_of(const Scene& scene) {
  std::string text;
  for (const Record& record : scene.records) text += (text.empty() ? "" : " ") + record.path;
  return text;
}

}  // namespace rheonet::test
