#include "core/result/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/component.hpp"
#include "core/network/reductions.hpp"
#include "core/network/resolved.hpp"
#include "core/network/surrogate_laws.hpp"
#include "core/result/explain.hpp"
#include "core/result/run.hpp"

namespace rheonet {

namespace {

const std::string& type_of(const SceneElement& element) { return components()[at(element.declaration)]->declaration.type; }

int index_of_type(const std::string& type) {
  const auto& all = components();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Component* c) { return c->declaration.type == type; });
  return static_cast<int>(found - all.begin());
}

/// The largest velocity of each element that has alternatives [m/s], and whether any event occurs.
struct Glance {
  std::map<int, double> fastest;
  bool switches = false;
};

Glance look(const Scene& scene, const std::atomic<bool>* interrupt) {
  Scene some = scene;
  some.records.clear();
  some.exact.clear();
  some.claims.clear();
  Glance result;
  std::vector<int> elements;
  for (int e = 0; at(e) < scene.elements.size(); ++e) {
    const auto is_its = [&](const SurrogateLaw& a) { return a.type == type_of(scene.elements[at(e)]); };
    const bool varies = !scene.elements[at(e)].signals.empty();  // a surrogate law has constant parameters
    if (varies || std::none_of(surrogate_laws().begin(), surrogate_laws().end(), is_its)) continue;
    elements.push_back(e);
    some.records.push_back({scene.elements[at(e)].name + ".velocity", Record::Subject::element, e, Record::Channel::velocity});
  }
  const auto see = [&](double, const std::vector<double>& values) {
    for (std::size_t k = 0; k < elements.size(); ++k) result.fastest[elements[k]] = std::max(result.fastest[elements[k]], std::abs(values[k]));
  };
  result.switches = run(some, {.state = see, .interrupt = interrupt, .tolerance = numerics::preview_accuracy}).restarts > 1;
  return result;
}

/// Replaces every moving element of the alternative's type by the alternative.
Scene with(const Scene& scene, const SurrogateLaw& alternative, double share, const std::map<int, double>& fastest) {
  Scene result = scene;
  for (const auto& [e, speed] : fastest) {
    SceneElement& element = result.elements[at(e)];
    if (type_of(element) != alternative.type || speed == 0) continue;
    const double small = share * speed;
    element.values = alternative.values(resolved_values(scene, element), small, small * numerics::regularised_distance * (scene.stop - scene.start));
    element.declaration = index_of_type(alternative.becomes);
  }
  return result;
}

/// The names of the reductions that reduce this scene.
std::vector<std::string> worthwhile_reductions(const Scene& scene) {
  const auto size = [](const Scene& of) {
    const Explanation explained = explain(of);
    return std::pair{explained.cost.unknowns, explained.structure.integrations};
  };
  const auto reduced = size(scene);
  std::vector<std::string> result;
  for (const ReductionWords& words : reductions()) {
    Scene kept = scene;
    kept.keep.push_back(words.name);
    if (size(kept) != reduced) result.push_back(words.name);
  }
  return result;
}

}  // namespace

std::vector<SimulationMethod> methods(const Scene& scene, const std::atomic<bool>* interrupt) {
  const Glance glance_at = look(scene, interrupt);
  std::vector<SimulationMethod> result;
  for (const int order : {5, 4, 3, 2}) result.push_back({.name = fmt::format("order up to {}", order), .order = order});
  if (glance_at.switches) result.push_back({.name = "events at the ends of steps", .locate_events = false});
  for (const std::string& reduction : worthwhile_reductions(scene)) {
    SimulationMethod kept{.name = fmt::format("without the reduction `{}`", reduction), .scene = {scene}};
    kept.scene.front().keep.push_back(reduction);
    result.push_back(std::move(kept));
  }
  for (const SurrogateLaw& alternative : surrogate_laws()) {
    const auto moves = [&](const auto& element) {
      return element.second > 0 && type_of(scene.elements[at(element.first)]) == alternative.type;
    };
    if (std::none_of(glance_at.fastest.begin(), glance_at.fastest.end(), moves)) continue;
    for (const double share : numerics::regularised_velocities) {
      result.push_back({.name = fmt::format("every {} {} below {:g} of its fastest motion", alternative.type, alternative.name, share),
                        .scene = {with(scene, alternative, share, glance_at.fastest)}});
    }
  }
  return result;
}

}  // namespace rheonet
