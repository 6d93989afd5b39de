#include "core/network/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/netlist/effects_table.hpp"
#include "core/network/error.hpp"
#include "core/network/limits.hpp"
#include "core/network/network.hpp"

namespace rheonet {

namespace {

const Declaration& declaration_of(const SceneElement& element) { return components()[at(element.declaration)]->declaration; }

double& value_of(const Declaration& declaration, const std::string& name, std::vector<double>& values) {
  const auto found = std::find_if(declaration.parameters.begin(), declaration.parameters.end(),
                                  [&](const Parameter& p) { return p.name == name; });
  return values[static_cast<std::size_t>(found - declaration.parameters.begin())];
}

bool contains(const std::vector<Effect>& effects, Effect effect) {
  return std::find(effects.begin(), effects.end(), effect) != effects.end();
}

[[noreturn]] void refuse(const SceneElement& element, Effect effect, const std::vector<Effect>& stay) {
  std::vector<std::string> others;
  for (const Effect other : stay) others.push_back(in_words(other));
  throw SimulationError(element.spot,
                        fmt::format("the {} of `{}` cannot be left out by itself: a `{}` with {} alone has no law; leave out more of "
                                    "these, or wire it from others",
                                    in_words(effect), element.name, declaration_of(element).type, fmt::join(others, " and ")));
}

}  // namespace

std::vector<Effect> brought_by(const SceneElement& element) {
  const Declaration& declaration = declaration_of(element);
  if (declaration.effects.empty() || !take_limits(components()[at(element.declaration)], element.values).component) return {};
  return declared_effects(declaration, element.values);
}

std::vector<Effect> left_out_of(const Scene& scene, const SceneElement& element) {
  if (scene.without.empty()) return {};
  std::vector<Effect> result = brought_by(element);
  std::erase_if(result, [&](Effect effect) {
    return std::none_of(scene.without.begin(), scene.without.end(),
                        [&](const EffectLeftOut& e) { return e.effect == effect && e.concerns(element.name); });
  });
  return result;
}

void leave_out_effects(const Scene& scene, const SceneElement& element, std::vector<double>& values) {
  const std::vector<Effect> out = left_out_of(scene, element);
  if (out.empty()) return;
  const Declaration& declaration = declaration_of(element);
  const std::vector<Effect> brought_here = brought_by(element);
  std::vector<Effect> stay = brought_here, done;
  std::erase_if(stay, [&](Effect effect) { return contains(out, effect); });
  for (const Brought& brought : declaration.effects) {
    if (!contains(out, brought.effect) || !brought.absent) continue;
    value_of(declaration, brought.parameter, values) = *brought.absent;
    done.push_back(brought.effect);
  }
  for (const Absence& absence : declaration.absences) {
    // An effect that the element lacks at a limit of its parameters counts as left out: the law of that limit applies.
    const auto is_out = [&](Effect e) { return contains(out, e); };
    const auto is_absent = [&](Effect e) { return is_out(e) || !contains(brought_here, e); };
    const std::vector<Effect>& of = absence.effects;
    if (std::none_of(of.begin(), of.end(), is_out) || !std::all_of(of.begin(), of.end(), is_absent)) continue;
    for (const auto& [name, value] : absence.values) value_of(declaration, name, values) = value;
    done.insert(done.end(), absence.effects.begin(), absence.effects.end());
  }
  for (const Effect effect : out) {
    if (!contains(done, effect)) refuse(element, effect, stay);
  }
}

std::vector<char> acting_blocks(const Scene& scene) {
  std::vector<char> acts(scene.blocks.size(), 0);
  std::vector<int> found;
  const auto reach = [&](int block) {
    if (acts[at(block)]) return;
    acts[at(block)] = 1;
    found.push_back(block);
  };
  for (const SceneFeed& feed : scene.feeds) reach(feed.block);
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (const SceneBlock::Input& input : scene.blocks[at(found[k])].inputs) {
      if (input.from_block) reach(input.index);
    }
  }
  return acts;
}

std::vector<int> feedback_of(const Network& network) {
  const Scene& scene = *network.scene;
  const std::vector<char> acts = acting_blocks(scene);
  std::vector<int> result;
  for (std::size_t b = 0; b < acts.size(); ++b) {
    const std::vector<Blocks::Input>& inputs = network.blocks.blocks[b].inputs;
    const bool senses = std::any_of(inputs.begin(), inputs.end(), [&](const Blocks::Input& input) {
      return !input.from_block && network.blocks.sensors[at(input.index)].motion < 0;
    });
    // The motion of its own ends that a law takes in is no feedback.
    if (acts[b] && senses && scene.elements[at(scene.blocks[b].element)].part == SceneElement::Part::none) result.push_back(scene.blocks[b].element);
  }
  return result;
}

}  // namespace rheonet
