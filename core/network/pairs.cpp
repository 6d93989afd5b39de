#include "core/network/pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/index.hpp"
#include "core/network/network.hpp"
#include "core/network/reductions.hpp"

namespace rheonet {

namespace {

/// The elements at a node.
struct Touch {
  int count = 0;
  int spring = -1, slider = -1;
  bool firm = false;            ///< ground, a mass or a motion: its start value is independent of its neighbours
  std::array<double, 2> start;  ///< where it may start, before and after a step [m]; NaN if its start follows from other values
};

bool is_spring(const Reduced& law) { return law.component && law.component->spring; }

bool is_plain_slider(const Reduced& law) {
  if (!law.component || law.component->role != Role::slip || law.component->contact) return false;
  const Box box = constant_box(*law.component, law.values);
  const double sliding = box.forward.sliding.value;
  if (over_velocity(*law.component, {law.values, law.characteristic.get()})) return false;
  return std::isfinite(sliding) && sliding == box.backward.sliding.value && !box.breaks_away();
}

bool starts_displaced(const Scene& scene, std::size_t element) {
  const SceneElement& e = scene.elements[element];
  const std::vector<Parameter>& parameters = components()[at(e.declaration)]->declaration.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& p = parameters[k];
    if (p.kind == Parameter::Kind::initial && p.quantity == Quantity::position && !std::isnan(e.values[k])) return true;
  }
  return false;
}

std::vector<Touch> touches(const Scene& scene, const std::vector<Reduced>& laws) {
  std::vector<Touch> result(scene.nodes.size());
  result[ground].firm = true;
  for (std::size_t n = 0; n < result.size(); ++n) {
    const double given = scene.nodes[n].position;
    result[n].start.fill(std::isnan(given) ? 0 : given);
  }
  for (std::size_t e = 0; e < laws.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    const Role role = laws[e].component ? laws[e].component->role : Role::nothing;
    const bool spring = is_spring(laws[e]), slider = element.signals.empty() && is_plain_slider(laws[e]);
    const auto touch = [&](NodeId node) {
      Touch& t = result[at(node)];
      ++t.count;
      if (spring) t.spring = static_cast<int>(e);
      if (slider) t.slider = static_cast<int>(e);
      t.firm = t.firm || role == Role::mass || role == Role::motion;
      if (role == Role::motion && prescribes(element, Quantity::position)) {
        t.start = {element.signals.at(0).before(scene.start), element.signals.at(0).value(scene.start)};
      }
      if (starts_displaced(scene, e)) t.start.fill(not_given);
    };
    for_each_node(element, touch);
  }
  return result;
}

/// Excludes sensed nodes and elements from pairs, because blocks need their quantities.
void keep_sensed(const Scene& scene, std::vector<Touch>& touched) {
  const auto keep = [&](NodeId node) { ++touched[at(node)].count; };
  const auto keep_ends = [&](int element) {
    keep(scene.elements[at(element)].a);
    keep(scene.elements[at(element)].b);
  };
  for (const Record& record : scene.sensed) {
    if (record.subject == Record::Subject::node) keep(record.index);
    if (record.subject == Record::Subject::element) keep_ends(record.index);
    if (record.subject == Record::Subject::assembly)
      for (const SceneAssembly::Term& term : scene.assemblies[at(record.index)].force) keep_ends(term.element);
  }
}

bool joins_spring_and_slider(const Touch& touch) { return touch.count == 2 && touch.spring >= 0 && touch.slider >= 0; }

NodeId other_end(const SceneElement& element, NodeId node) { return element.a == node ? element.b : element.a; }

/// Wherever the spring's end may start, the slider holds the force of the spring.
bool holds_at_start(const Pair& pair, const Touch& end) {
  return std::all_of(end.start.begin(), end.start.end(), [&](double x) {
    return std::abs(pair.law.stiffness * (pair.spring_sign * x - pair.law.rest)) <= pair.coulomb;  // false for NaN
  });
}

}  // namespace

std::vector<Pair> find_pairs(const Scene& scene, const std::vector<Reduced>& laws) {
  if (kept(scene, Reduction::bundles)) return {};
  std::vector<Touch> touched = touches(scene, laws);
  keep_sensed(scene, touched);
  std::vector<char> taken(scene.elements.size(), 0);
  std::vector<Pair> pairs;
  pairs.reserve(static_cast<std::size_t>(std::count_if(touched.begin(), touched.end(), joins_spring_and_slider)));
  for (NodeId node = 1; node < static_cast<NodeId>(scene.nodes.size()); ++node) {
    const Touch& touch = touched[at(node)];
    if (!joins_spring_and_slider(touch)) continue;
    if (taken[at(touch.spring)] || taken[at(touch.slider)] || !std::isnan(scene.nodes[at(node)].velocity)) continue;
    const SceneElement &spring = scene.elements[at(touch.spring)], &slider = scene.elements[at(touch.slider)];
    const Reduced &spring_law = laws[at(touch.spring)], &slider_law = laws[at(touch.slider)];
    Pair pair{.spring = touch.spring,
              .slider = touch.slider,
              .node = node,
              .spring_end = other_end(spring, node),
              .slider_end = other_end(slider, node),
              .law = spring_law.component->spring(spring_law.values),
              .coulomb = constant_box(*slider_law.component, slider_law.values).forward.sliding.value,
              .spring_sign = spring.b == node ? 1.0 : -1.0,
              .slider_sign = slider.a == node ? 1.0 : -1.0};
    if (pair.spring_end == pair.slider_end) continue;
    // A start displacement of the spring may determine the position of its end. (NaN: not given.)
    if (!std::isnan(pair.law.displacement)) continue;
    // At an end without mass or motion, values given here may have to balance values of neighbours; and the slip of a slider
    // that cannot hold its spring depends on the neighbours.
    const bool firm = touched[at(pair.spring_end)].firm && touched[at(pair.slider_end)].firm;
    const bool given = !std::isnan(pair.law.force) || !std::isnan(scene.nodes[at(node)].position);
    if (!firm && (given || !holds_at_start(pair, touched[at(pair.spring_end)]))) continue;
    taken[at(touch.spring)] = taken[at(touch.slider)] = 1;
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace rheonet
