#include "core/netlist/scene.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

bool same_values(std::span<const double> one, std::span<const double> other) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), same);
}

std::string block_in_words(const SceneElement& block) {
  return block.part != SceneElement::Part::none ? "`" + block.name.substr(0, block.name.rfind('.')) + "`" : "block `" + block.name + "`";
}

Domain domain_of(const Scene& scene, const SceneNode& node) { return node.domain.value_or(scene.domain); }

Domain domain_of(const Scene& scene, const SceneElement& element) { return element.domain.value_or(scene.domain); }

Domain domain_of(const Scene& scene, const Record& record) {
  const std::size_t k = static_cast<std::size_t>(record.index);
  switch (record.subject) {
    case Record::Subject::node:
      return domain_of(scene, scene.nodes[k]);
    case Record::Subject::element:
      return domain_of(scene, scene.elements[k]);
    case Record::Subject::assembly: {
      const SceneAssembly& assembly = scene.assemblies[k];
      return domain_of(scene, scene.nodes[static_cast<std::size_t>(assembly.a == ground ? assembly.b : assembly.a)]);
    }
    case Record::Subject::block: {
      // The domain of the element that it feeds, or else of its input; only names of units depend on it.
      for (const SceneFeed& feed : scene.feeds) {
        if (feed.block == record.index) return domain_of(scene, scene.elements[static_cast<std::size_t>(feed.element)]);
      }
      for (const SceneBlock::Input& input : scene.blocks[k].inputs) {
        if (!input.from_block) return domain_of(scene, scene.sensed[static_cast<std::size_t>(input.index)]);
      }
      return scene.domain;
    }
    case Record::Subject::expression: {
      const std::vector<Record>& operands = scene.expressions[k].operands;
      const auto same = [&](const Record& operand) { return domain_of(scene, operand) == domain_of(scene, operands.front()); };
      return !operands.empty() && std::all_of(operands.begin(), operands.end(), same) ? domain_of(scene, operands.front()) : scene.domain;
    }
  }
  return scene.domain;
}

bool in_both_domains(const Scene& scene) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const SceneNode& n) { return n.domain && *n.domain != scene.domain; });
}

bool joins_domains(const Scene& scene, NodeId a, NodeId b) {
  const auto domain = [&](NodeId node) { return domain_of(scene, scene.nodes[static_cast<std::size_t>(node)]); };
  return a != ground && b != ground && domain(a) != domain(b);
}

Quantity quantity_of(const Declaration& declaration, const SceneElement& element, std::size_t parameter) {
  const Parameter& p = declaration.parameters[parameter];
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    if (p.coefficient_with.empty() || declaration.parameters[k].name != p.coefficient_with) continue;
    const bool varies = std::find(element.signal_parameters.begin(), element.signal_parameters.end(), static_cast<int>(k)) !=
                        element.signal_parameters.end();
    if (varies || !std::isnan(element.values[k])) return Quantity::number;
  }
  return p.quantity;
}

}  // namespace rheonet
