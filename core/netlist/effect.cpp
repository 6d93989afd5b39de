#include "core/netlist/effect.hpp"

#include <algorithm>
#include <utility>

namespace rheonet {

namespace {

const std::vector<std::pair<Effect, std::string>> names{
    {Effect::inertia, "inertia"},           {Effect::elasticity, "elasticity"}, {Effect::viscosity, "viscosity"},
    {Effect::dry_friction, "dry_friction"}, {Effect::contact, "contact"},       {Effect::delay, "delay"},
    {Effect::feedback, "feedback"}};

}  // namespace

const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = [] {
    std::vector<Effect> result;
    for (const auto& [effect, name] : names) result.push_back(effect);
    return result;
  }();
  return all;
}

const std::string& name_of(Effect effect) {
  return std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.first == effect; })->second;
}

std::string in_words(Effect effect) {
  std::string words = name_of(effect);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::optional<Effect> find_effect(std::string name) {
  for (char& c : name) c = c == ' ' || c == '-' ? '_' : c;
  const auto found = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.second == name; });
  return found == names.end() ? std::nullopt : std::optional(found->first);
}

bool EffectLeftOut::concerns(const std::string& element) const {
  return of.empty() || element == of || (element.starts_with(of) && element[of.size()] == '.');
}

std::string EffectLeftOut::in_words() const {
  return rheonet::in_words(effect) + (of.empty() ? "" : " of `" + of + "`");
}

}  // namespace rheonet
