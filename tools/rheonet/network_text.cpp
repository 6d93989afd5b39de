#include "tools/rheonet/network_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/netlist/characters.hpp"
#include "core/netlist/switched_function.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

double flow_index_of(const Parameter& parameter, const Declaration& declaration, const SceneElement& element) {
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i) {
    if (declaration.parameters[i].name == parameter.flow_index) return element.values[i];
  }
  return 1;
}

/// "of command, -drum.velocity"
std::string inputs_of(const SceneBlock& block, const Scene& scene) {
  std::vector<std::string> inputs;
  for (const SceneBlock::Input& input : block.inputs) {
    const auto k = static_cast<std::size_t>(input.index);
    const std::string& source = input.from_block ? scene.elements[static_cast<std::size_t>(scene.blocks[k].element)].name : scene.sensed[k].path;
    inputs.push_back((input.sign < 0 ? "-" : "") + source);
  }
  return inputs.empty() ? "" : fmt::format("of {}", fmt::join(inputs, ", "));
}

}  // namespace

std::string count(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::array<std::string, 4> row_of(const SceneElement& element, const Scene& scene) {
  const auto index = static_cast<int>(&element - scene.elements.data());
  const Declaration& declaration = *declarations()[static_cast<std::size_t>(element.declaration)];
  const auto node = [&scene](NodeId id) { return scene.nodes[static_cast<std::size_t>(id)].name; };

  std::vector<std::string> values;
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i) {
    const Parameter& parameter = declaration.parameters[i];
    const std::string name = parameter.name_in(domain_of(scene, element));
    const std::string unit = unit_of(quantity_of(declaration, element, i), domain_of(scene, element), flow_index_of(parameter, declaration, element));
    const auto& with_signal = element.signal_parameters;
    const auto found = std::find(with_signal.begin(), with_signal.end(), static_cast<int>(i));
    const auto fed = std::find_if(scene.feeds.begin(), scene.feeds.end(), [&](const SceneFeed& feed) {
      return feed.element == index && feed.parameter == static_cast<int>(i);
    });
    if (fed != scene.feeds.end()) {
      const SceneBlock& block = scene.blocks[static_cast<std::size_t>(fed->block)];
      if (block.function && scene.elements[static_cast<std::size_t>(block.element)].part != SceneElement::Part::none) {
        values.push_back(fmt::format("{} = {}", name, block.function->text()));
        continue;
      }
      values.push_back(fmt::format("{} = {}block {}", name, fed->sign < 0 ? "-" : "", scene.elements[static_cast<std::size_t>(block.element)].name));
    } else if (found != with_signal.end()) {
      const auto which = static_cast<std::size_t>(found - with_signal.begin());
      values.push_back(fmt::format("{} = {}", name, in_words(element.signals[which], unit)));
    } else if (!parameter.second_of.empty() && !std::isnan(element.values[i - 1])) {
      if (std::isnan(element.values[i]) || element.values[i] == element.values[i - 1]) continue;
      values.back() = fmt::format("{} = [{:.10g}, {:.10g}]{}", parameter.second_of, element.values[i - 1], element.values[i], unit == "1" ? "" : " " + unit);
    } else if (!parameter.same_as.empty() && !element.given[i]) {
      continue;  // Equal to the parameter `same_as`; a `peak` sets a `breakaway` that differs.
    } else if (!std::isnan(element.values[i]) && parameter.kind != Parameter::Kind::characteristic) {
      values.push_back(fmt::format("{} = {:.10g}{}", name, element.values[i], unit == "1" ? "" : " " + unit));
    }
  }
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i)
    if (const Parameter& parameter = declaration.parameters[i]; element.characteristic(i) && (parameter.second_of.empty() || element.characteristic(i) != element.characteristic(i - 1)))
      values.push_back((parameter.second_of.empty() ? parameter.name : parameter.second_of + ", second value") + " by its curve");
  const auto block = std::find_if(scene.blocks.begin(), scene.blocks.end(), [&](const SceneBlock& one) { return one.element == index; });
  if (block != scene.blocks.end()) {
    if (block->function) values.push_back("out = " + block->function->text());
    auto polynomial = block->coefficients.begin();
    for (const Parameter& parameter : declaration.parameters) {
      if (parameter.kind == Parameter::Kind::coefficients) values.push_back(fmt::format("{} = {:.10g}", parameter.name, fmt::join(*polynomial++, " ")));
    }
    return {element.name, declaration.type, inputs_of(*block, scene), fmt::format("{}", fmt::join(values, "  "))};
  }
  return {element.name, declaration.type,
          (element.at ? "at " + node(element.a) : node(element.a) + " - " + node(element.b)) +
              (element.support == ground ? "" : " against " + node(element.support)),
          fmt::format("{}", fmt::join(values, "  "))};
}

std::string describe_network(const Scene& scene) {
  std::string text;
  const auto print = [&text]<class... Args>(fmt::format_string<Args...> pattern, Args&&... values) {
    text += fmt::format(pattern, std::forward<Args>(values)...);
  };
  print("{} ({})\n", scene.title.empty() ? "untitled" : printable(scene.title),
        in_both_domains(scene) ? "rotation and translation" : scene.domain == Domain::rotation ? "rotation" : "translation");
  print("{:g} s to {:g} s, accuracy {:g}, {} output times, {}\n", scene.start, scene.stop, scene.accuracy,
        scene.output_intervals + 1, count(scene.records.size(), "recorded quantity", "recorded quantities"));

  std::size_t width = 0;
  for (const SceneNode& node : scene.nodes) width = std::max(width, node.name.size());
  for (const SceneElement& element : scene.elements) width = std::max(width, element.name.size());
  for (const SceneAssembly& assembly : scene.assemblies) width = std::max(width, assembly.name.size());
  const int name_width = static_cast<int>(width);

  print("nodes:\n");
  for (const SceneNode& node : scene.nodes) {
    std::string start = &node == &scene.nodes.front() ? "  never moves" : "";
    if (start.empty() && !std::isnan(node.position)) {
      start += fmt::format("  position = {:.10g} {}", node.position, unit_of(Quantity::position, domain_of(scene, node)));
    }
    if (&node != &scene.nodes.front() && !std::isnan(node.velocity)) {
      start += fmt::format("  velocity = {:.10g} {}", node.velocity, unit_of(Quantity::velocity, domain_of(scene, node)));
    }
    print("  {:<{}}{}\n", node.name, start.empty() ? 0 : name_width, start);
  }
  print("elements:\n");
  std::vector<std::array<std::string, 4>> rows;
  std::size_t type_width = 0, place_width = 0;
  for (const SceneElement& element : scene.elements) {
    if (element.part != SceneElement::Part::none) continue;
    rows.push_back(row_of(element, scene));
    type_width = std::max(type_width, rows.back()[1].size());
    place_width = std::max(place_width, rows.back()[2].size());
  }
  for (const auto& [name, type, place, values] : rows) {
    print("  {:<{}}  {:<{}}  {:<{}}  {}\n", name, name_width, type, type_width, place, place_width, values);
  }
  if (!scene.assemblies.empty()) print("assemblies:\n");
  for (const SceneAssembly& assembly : scene.assemblies) {
    print("  {:<{}}  {} - {}\n", assembly.name, name_width, scene.nodes[static_cast<std::size_t>(assembly.a)].name,
               scene.nodes[static_cast<std::size_t>(assembly.b)].name);
  }
  std::string records;
  for (const Record& record : scene.records) records += (records.empty() ? "" : " ") + record.path;
  print("recorded:\n  {}\n", wrapped(records, 2));
  return text;
}

}  // namespace rheonet::tool
