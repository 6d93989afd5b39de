#include "core/network/transmission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/netlist/characteristic.hpp"
#include "core/netlist/records.hpp"
#include "core/network/component.hpp"
#include "core/network/error.hpp"
#include "core/network/resolved.hpp"

namespace rheonet {

namespace {

const Component& component_of(const SceneElement& element) { return *components()[at(element.declaration)]; }

bool is_transmission(const SceneElement& element) { return static_cast<bool>(component_of(element).ratio); }

/// Velocity of the first node over that of the second, relative to the support.
double ratio_of(const SceneElement& element) { return component_of(element).ratio(element.values); }

bool joins_two_nodes(const SceneElement& element) { return !element.at && element.a != ground && element.b != ground; }

bool has_losses(const Scene& scene, const SceneElement& element) {
  const Component& component = component_of(element);
  return component.loss && !component.loss(resolved_values(scene, element)).none();
}

/// Its support is at rest, and it has no losses: it may be a change of units.
bool is_two_port(const Scene& scene, const SceneElement& element) { return is_transmission(element) && element.support == ground && !has_losses(scene, element); }

/// The elements on a shortest path between two nodes, from the first node on, along elements that `may_pass`. Empty if none.
template <class MayPass>
std::vector<int> path_between(const Scene& scene, NodeId from, NodeId to, MayPass may_pass) {
  std::vector<std::vector<int>> around(scene.nodes.size());
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    if (!joins_two_nodes(scene.elements[e]) || !may_pass(static_cast<int>(e))) continue;
    around[at(scene.elements[e].a)].push_back(static_cast<int>(e));
    around[at(scene.elements[e].b)].push_back(static_cast<int>(e));
  }
  const auto beyond = [&](int e, NodeId node) { return scene.elements[at(e)].a == node ? scene.elements[at(e)].b : scene.elements[at(e)].a; };
  std::vector<int> by(scene.nodes.size(), -1);
  std::vector<NodeId> reached{from};
  for (std::size_t k = 0; k < reached.size() && by[at(to)] < 0; ++k) {
    for (const int e : around[at(reached[k])]) {
      const NodeId next = beyond(e, reached[k]);
      if (next == from || by[at(next)] >= 0) continue;
      by[at(next)] = e;
      reached.push_back(next);
    }
  }
  std::vector<int> path;
  for (NodeId node = to; node != from && by[at(node)] >= 0; node = beyond(by[at(node)], node)) path.push_back(by[at(node)]);
  std::reverse(path.begin(), path.end());
  return path;
}

/// Finds the scale of each node, and the transmissions that cannot be changes of units: those with losses or a moving support, and those
/// that close a loop with other elements.
class Scales {
 public:
  explicit Scales(const Scene& scene)
      : scene_(scene), regions_(scene.nodes.size()), scale_(scene.nodes.size(), 0), across_(scene.nodes.size()), row_(scene.elements.size(), 0) {
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      const SceneElement& element = scene.elements[e];
      if (joins_two_nodes(element) && !is_transmission(element)) regions_.join(element.a, element.b);
      // Losses are friction between the first node and the support.
      if (is_transmission(element) && has_losses(scene, element) && element.a != ground && element.support != ground) regions_.join(element.a, element.support);
    }
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      const SceneElement& element = scene.elements[e];
      row_[e] = is_transmission(element) && !is_two_port(scene, element);
      if (!joins_two_nodes(element) || !is_two_port(scene, element)) continue;
      across_[at(regions_.find(element.a))].push_back(static_cast<int>(e));
      across_[at(regions_.find(element.b))].push_back(static_cast<int>(e));
    }
    for (std::size_t n = 1; n < scene.nodes.size(); ++n) {
      const std::size_t region = at(regions_.find(static_cast<NodeId>(n)));
      if (scale_[region] == 0) spread(region);
    }
  }

  double of(NodeId node) { return node == ground ? 1 : scale_[at(regions_.find(node))]; }
  bool is_row(std::size_t e) const { return row_[e] != 0; }

 private:
  void spread(std::size_t first) {
    scale_[first] = 1;
    std::vector<std::size_t> reached{first};
    for (std::size_t k = 0; k < reached.size(); ++k) {
      for (const int e : across_[reached[k]]) {
        const SceneElement& element = scene_.elements[at(e)];
        const std::size_t a = at(regions_.find(element.a)), b = at(regions_.find(element.b));
        const double ratio = ratio_of(element);
        const std::size_t next = a == reached[k] ? b : a;
        const double wanted = a == reached[k] ? ratio * scale_[a] : scale_[b] / ratio;
        if (scale_[next] == 0) {
          scale_[next] = wanted;
          reached.push_back(next);
        } else if (std::abs(scale_[b] - ratio * scale_[a]) > numerics::equal_given_values * std::abs(scale_[b])) {
          refuse_contradiction(e);
          row_[at(e)] = 1;
        }
      }
    }
  }

  /// Refuses a loop of transmissions alone that this one closes.
  void refuse_contradiction(int e) const {
    const SceneElement& closing = scene_.elements[at(e)];
    const auto transmits = [&](int other) { return other != e && is_two_port(scene_, scene_.elements[at(other)]); };
    const std::vector<int> loop = path_between(scene_, closing.a, closing.b, transmits);
    if (loop.empty()) return;
    double ratio = 1;
    NodeId node = closing.a;
    for (const int other : loop) {
      const SceneElement& element = scene_.elements[at(other)];
      ratio *= element.a == node ? ratio_of(element) : 1 / ratio_of(element);
      node = element.a == node ? element.b : element.a;
    }
    throw SimulationError(closing.spot,
                          fmt::format("`{}` makes a loop with {}, and their ratios contradict each other: the velocity of `{}` is {:.10g} times that of "
                                      "`{}` by `{}`, and {:.10g} times by the others, so that nothing could move; leave one of them out",
                                      closing.name, names(loop), scene_.nodes[at(closing.a)].name, ratio_of(closing),
                                      scene_.nodes[at(closing.b)].name, closing.name, ratio));
  }

  std::string names(const std::vector<int>& elements) const {
    std::vector<std::string> result;
    for (const int e : elements) result.push_back(scene_.elements[at(e)].name);
    return format_list(result);
  }

  const Scene& scene_;
  DisjointSets regions_;
  std::vector<double> scale_;              ///< of each region's representative; 0: not found yet
  std::vector<std::vector<int>> across_;   ///< of each region's representative: the transmissions at its nodes
  std::vector<char> row_;                  ///< of each element: a transmission that is no change of units
};

double flow_index_of(const Declaration& declaration, const Parameter& parameter, const std::vector<double>& values) {
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    if (declaration.parameters[k].name == parameter.flow_index) return values[k];
  }
  return 1;
}

class Converter {
 public:
  explicit Converter(const Scene& scene) : whole_(scene), result_(scene) {}

  Scene convert() {
    Scales scales(whole_);
    result_.common_units = true;
    for (std::size_t n = 1; n < result_.nodes.size(); ++n) convert(result_.nodes[n], scales.of(static_cast<NodeId>(n)));
    for (std::size_t e = 0; e < result_.elements.size(); ++e) {
      if (scales.is_row(e)) give_row(result_.elements[e]);
    }
    for (SceneElement& element : result_.elements) convert(element);
    for (SceneAssembly& assembly : result_.assemblies) {
      for (SceneAssembly::Term& term : assembly.force) term.sign *= force_of(term);
    }
    for (SceneFeed& feed : result_.feeds) {
      const SceneElement& element = result_.elements[at(feed.element)];
      feed.sign /= own_unit(quantity_of(component_of(element).declaration, element, at(feed.parameter)), element.scale);
    }
    for (SceneBlock& block : result_.blocks) {
      for (SceneBlock::Input& input : block.inputs) {
        if (!input.from_block) take_in(block, input);
      }
    }
    for (SceneExpression& expression : result_.expressions) convert(expression);
    for (std::vector<Record>* records : {&result_.records, &result_.claimed}) {
      for (Record& record : *records) convert(record);
    }
    return std::move(result_);
  }

 private:
  const SceneNode& node(NodeId n) const { return result_.nodes[at(n)]; }

  static void convert(SceneNode& node, double scale) {
    node.scale = scale;
    node.position /= own_unit(Quantity::position, scale);
    node.velocity /= own_unit(Quantity::velocity, scale);
  }

  /// v_a - v_s = i (v_b - v_s) in common units.
  void give_row(SceneElement& element) const {
    const double i = ratio_of(element);
    element.row = {1 / node(element.a).scale, -i / node(element.b).scale, (i - 1) / node(element.support).scale};
    for (double& factor : element.row) factor *= node(element.a).scale;
  }

  void convert(SceneElement& element) const {
    const Component& component = component_of(element);
    if (component.role == Role::block) return;
    if (component.ratio) {
      element.scale = scale_at(element, true);
      std::vector<double> values = element.values;
      for (std::size_t k = 0; k < values.size(); ++k) {
        // Losses are the same in both directions.
        if (element.has_row()) values[k] /= own_unit(component.declaration.parameters[k].quantity, std::abs(element.scale));
      }
      element.values = std::move(values);
      if (element.has_row()) scale_characteristics(element, [&](std::size_t k) { return own_unit(component.declaration.parameters[k].quantity, element.scale); });
      return;
    }
    element.scale = node(element.a == ground && !element.at ? element.b : element.a).scale;
    if (!element.at && element.scale < 0) {
      std::swap(element.a, element.b);
      element.scale = -element.scale;
    }
    if (element.scale == 1) return;
    const Declaration& declaration = component.declaration;
    const std::vector<double> before = element.values;
    const auto factor = [&](std::size_t k) {
      return own_unit(quantity_of(declaration, element, k), element.scale, flow_index_of(declaration, declaration.parameters[k], before));
    };
    std::vector<double> values = before;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] /= factor(k);
    for (std::size_t k = 0; k < element.signals.size(); ++k) {
      element.signals.own()[k] = element.signals[k].times(1 / factor(at(element.signal_parameters[k])));
    }
    element.values = std::move(values);
    scale_characteristics(element, factor);
  }

  /// `factor`: of the values of a parameter.
  template <class Factor>
  static void scale_characteristics(SceneElement& element, Factor factor) {
    if (!element.characteristics || element.scale == 1) return;
    Characteristics scaled;
    for (const auto& [k, function] : *element.characteristics) {
      const double by_x = std::abs(own_unit(component_of(element).declaration.parameters[k].over, element.scale)), by_value = std::abs(factor(k));
      scaled[k] = std::make_shared<const Characteristic>(function->scaled(1 / by_x, 1 / by_value));
    }
    element.characteristics = std::make_shared<const Characteristics>(std::move(scaled));
  }

  /// The scale of a transmission at its first or its second end, one of which may be at ground.
  double scale_at(const SceneElement& transmission, bool first) const {
    if (transmission.has_row()) return node(first ? transmission.a : transmission.b).scale;
    if (first && transmission.a == ground) return node(transmission.b).scale / ratio_of(transmission);
    if (!first && transmission.b == ground) return node(transmission.a).scale * ratio_of(transmission);
    return node(first ? transmission.a : transmission.b).scale;
  }

  /// Factor of the force of an element in that of an assembly. A term with a negative sign is a transmission's force at its
  /// second node.
  double force_of(const SceneAssembly::Term& term) const {
    const SceneElement& element = result_.elements[at(term.element)];
    if (term.at_support) return element.row[2] * own_unit(Quantity::force, node(element.support).scale);
    if (element.has_row() && term.sign < 0) return -element.row[1] * own_unit(Quantity::force, node(element.b).scale);
    const bool at_second = static_cast<bool>(component_of(element).ratio) && term.sign < 0;
    return own_unit(Quantity::force, at_second ? scale_at(element, false) : element.scale);
  }

  /// Where a record measures between nodes of different scales: these nodes.
  std::optional<std::pair<NodeId, NodeId>> across(const Record& record) const {
    if (record.channel != Record::Channel::displacement && record.channel != Record::Channel::velocity) return {};
    const auto apart = [&](NodeId a, NodeId b) -> std::optional<std::pair<NodeId, NodeId>> {
      if (a == ground || b == ground || node(a).scale == node(b).scale) return {};
      return std::pair{a, b};
    };
    if (record.subject == Record::Subject::assembly) return apart(result_.assemblies[at(record.index)].a, result_.assemblies[at(record.index)].b);
    if (record.subject != Record::Subject::element || result_.elements[at(record.index)].at) return {};
    return apart(result_.elements[at(record.index)].a, result_.elements[at(record.index)].b);
  }

  /// Factor of a record in common units.
  double factor_of(const Record& record) const {
    const auto factor = [&](double scale) { return own_unit(quantity_of(record.channel), scale); };
    switch (record.subject) {
      case Record::Subject::node:
        return factor(node(record.index).scale);
      case Record::Subject::element: {
        const SceneElement& element = result_.elements[at(record.index)];
        const bool motion = record.channel == Record::Channel::displacement || record.channel == Record::Channel::velocity;
        // A transmission from ground moves with its second node.
        return factor(motion && element.has_row() && element.a == ground ? node(element.b).scale : element.scale);
      }
      case Record::Subject::assembly: {
        const SceneAssembly& assembly = result_.assemblies[at(record.index)];
        return record.channel == Record::Channel::force ? 1 : factor(node(assembly.a == ground ? assembly.b : assembly.a).scale);
      }
      case Record::Subject::block:
      case Record::Subject::expression:
        break;
    }
    return 1;
  }

  /// The record of one of the two nodes of a record across a transmission.
  Record of_node(const Record& record, NodeId n) const {
    Record one{.path = node(n).name, .subject = Record::Subject::node, .index = n,
               .channel = record.channel == Record::Channel::displacement ? Record::Channel::position : Record::Channel::velocity};
    one.factor = factor_of(one);
    return one;
  }

  void convert(Record& record) {
    const auto nodes = across(record);
    if (!nodes) {
      record.factor = factor_of(record);
      return;
    }
    result_.expressions.push_back({.name = record.path,
                                   .operands = {of_node(record, nodes->first), of_node(record, nodes->second)},
                                   .value = [](std::span<const double> x) { return x[0] - x[1]; },
                                   .unit = unit_of(whole_, record)});
    record = {record.path, Record::Subject::expression, static_cast<int>(result_.expressions.size()) - 1, Record::Channel::value};
  }

  void convert(SceneExpression& expression) const {
    std::vector<Record> operands;
    std::vector<char> differences(expression.operands.size(), 0);
    for (std::size_t k = 0; k < expression.operands.size(); ++k) {
      Record& operand = expression.operands[k];
      if (const auto nodes = across(operand)) {
        differences[k] = 1;
        operands.push_back(of_node(operand, nodes->first));
        operands.push_back(of_node(operand, nodes->second));
      } else {
        operand.factor = factor_of(operand);
        operands.push_back(operand);
      }
    }
    if (operands.size() == expression.operands.size()) {
      expression.operands = std::move(operands);
      return;
    }
    expression.operands = std::move(operands);
    expression.value = [differences = std::move(differences), value = std::move(expression.value)](std::span<const double> x) {
      std::vector<double> values;
      std::size_t next = 0;
      for (const char difference : differences) {
        values.push_back(difference ? x[next] - x[next + 1] : x[next]);
        next += difference ? 2 : 1;
      }
      return value(values);
    };
  }

  void take_in(const SceneBlock& block, SceneBlock::Input& input) const {
    const Record& record = whole_.sensed[at(input.index)];
    if (const auto nodes = across(record)) {
      const SceneElement& element = result_.elements[at(block.element)];
      throw SimulationError(element.spot, fmt::format("{} cannot take in `{}`: a transmission is between its ends; take in the motions of nodes `{}` and `{}`",
                                                      block_in_words(element), record.path, node(nodes->first).name, node(nodes->second).name));
    }
    input.sign *= factor_of(record);
  }

  const Scene& whole_;
  Scene result_;
};

}  // namespace

double own_unit(Quantity quantity, double scale, double flow_index) {
  switch (quantity) {
    case Quantity::position:
    case Quantity::velocity:
    case Quantity::acceleration:
      return 1 / scale;
    case Quantity::force:
      return scale;
    case Quantity::stiffness:
    case Quantity::mass:
      return scale * scale;
    case Quantity::damping:
      return flow_index == 1 ? scale * scale : std::pow(scale, 1 + flow_index);
    case Quantity::number:
    case Quantity::time:
    case Quantity::frequency:
    case Quantity::angle:
    case Quantity::length:
    case Quantity::power:
    case Quantity::energy:
      break;
  }
  return 1;
}

std::optional<Scene> in_common_units(const Scene& scene) {
  if (scene.common_units || std::none_of(scene.elements.begin(), scene.elements.end(), is_transmission)) return {};
  return Converter(scene).convert();
}

}  // namespace rheonet
