#include "core/network/assumptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/network/effects.hpp"
#include "core/network/limits.hpp"
#include "core/network/resolved.hpp"

namespace rheonet {

void tell_lost_times(Network& network) {
  for (const SceneElement& element : network.scene->elements) {
    const Declaration& declared = components()[at(element.declaration)]->declaration;
    for (std::size_t k = 0; k < element.values.size(); ++k) {
      if (!is_lost(*network.scene, declared.parameters[k], element.values[k])) continue;
      if (!left_out_of(*network.scene, element).empty()) break;  // left out on request, see tell_left_out
      network.notes.push_back(fmt::format("`{}` of {:.3g} s is left out: it is less than what tells the times of this run apart",
                                          element.name + "." + declared.parameters[k].name, element.values[k]));
    }
  }
}

void tell_left_out(Network& network) {
  const Scene& scene = *network.scene;
  std::vector<std::string> told;
  for (const EffectLeftOut& out : scene.without) {
    const bool concerns = std::any_of(scene.elements.begin(), scene.elements.end(), [&](const SceneElement& e) {
      const std::vector<Effect> brought = brought_by(e);
      return out.concerns(e.name) && std::find(brought.begin(), brought.end(), out.effect) != brought.end();
    });
    if (concerns || (out.effect == Effect::feedback && !scene.feeds.empty())) told.push_back(out.in_words());
  }
  if (!told.empty()) network.notes.push_back(fmt::format("left out of this run: {}", fmt::join(told, ", ")));
}

void tell_meaningless(Network& network, const std::vector<Reduced>& laws) {
  const Scene& scene = *network.scene;
  std::vector<std::pair<std::string, std::vector<std::string>>> told;  // reason, and the paths of the parameters
  for (std::size_t e = 0; e < laws.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    const Component& component = *components()[at(element.declaration)];
    if (!laws[e].limit || element.given.none()) continue;
    const std::vector<double> values = resolved_values(scene, element);
    const Reduced law = take_limits(&component, values);
    for (const std::size_t k : without_meaning(component, values)) {
      if (!element.given.test(k)) continue;
      const std::string why = left_out_of(scene, element).empty() ? law.limit->when : "without what the scene leaves out";
      const std::string reason = fmt::format("to {} ({})", name_of(law), why);
      auto found = std::find_if(told.begin(), told.end(), [&](const auto& t) { return t.first == reason; });
      if (found == told.end()) found = told.insert(found, {reason, {}});
      found->second.push_back(element.name + "." + component.declaration.parameters[k].name_in(domain_of(scene, element)));
    }
  }
  for (const auto& [reason, paths] : told) {
    network.notes.push_back(fmt::format("{} mean{} nothing {}, and {} left out", format_list(paths), paths.size() > 1 ? "" : "s", reason,
                                        paths.size() > 1 ? "are" : "is"));
  }
}

}  // namespace rheonet
