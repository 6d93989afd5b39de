#include "core/network/component.hpp"

#include <algorithm>

#include "core/netlist/scene.hpp"

namespace rheonet {

namespace {

struct Registry {
  std::vector<std::unique_ptr<Component>> owned;
  std::vector<const Component*> sorted;
  std::vector<const Declaration*> declarations;
};

// A local static: components register before static objects of other files may exist.
Registry& registry() {
  static Registry instance;
  return instance;
}

}  // namespace

RegisterComponent::RegisterComponent(Component component) {
  Registry& r = registry();
  r.owned.push_back(std::make_unique<Component>(std::move(component)));
  if (r.owned.back()->hidden) return;
  const Component* added = r.owned.back().get();
  r.sorted.insert(std::upper_bound(r.sorted.begin(), r.sorted.end(), added,
                                   [](const Component* a, const Component* b) { return a->declaration.type < b->declaration.type; }),
                  added);
  r.declarations.clear();
  for (const Component* c : r.sorted) r.declarations.push_back(&c->declaration);
}

std::optional<MotionExpression> over_velocity(const Component& component, const LawValues& values) {
  return component.over_velocity ? component.over_velocity(values) : std::nullopt;
}

Box constant_box(const Component& component, std::span<const double> values) {
  std::vector<Dual> constant(component.declaration.parameters.size(), not_given);
  std::copy(values.begin(), values.end(), constant.begin());
  return component.box(constant);
}

const std::vector<const Component*>& components() { return registry().sorted; }

Declarations declarations() { return registry().declarations; }

const Component* find_component(const std::string& type) {
  for (const auto& c : registry().owned) {
    if (c->declaration.type == type) return c.get();
  }
  return nullptr;
}

}  // namespace rheonet
