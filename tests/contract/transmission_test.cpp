// Every element behind a gear: a network that is driven through gears of one ratio is the same as one that is driven directly,
// with the motions divided by the ratio and the forces multiplied by it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "core/base/index.hpp"
#include "core/network/component.hpp"
#include "tests/contract/compare.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test {

namespace {

bool drives(const SceneElement& element) {
  const Role role = components()[at(element.declaration)]->role;
  return element.at && (role == Role::motion || role == Role::force);
}

/// Starts the node of a drive where the driven node is: a gear keeps the ratio of positions only from where they start.
void start_alike(const SceneElement& drive, SceneNode& driving, SceneNode& driven, double ratio) {
  const Component& component = *components()[at(drive.declaration)];
  const Quantity quantity = component.declaration.parameters[at(drive.signal_parameters[0])].quantity;
  if (quantity == Quantity::position) {
    if (std::isnan(driven.position)) driven.position = drive.signals[0].value(0) / ratio;
    return;
  }
  driving.position = ratio * driven.position;
  if (quantity == Quantity::acceleration) driving.velocity = ratio * driven.velocity;
}

/// The same scene, each of its drives behind a gear of this ratio. The nodes of the drives come first, so that the unit of one of
/// them is the common one, and everything else is converted.
Scene behind_gears(const Scene& scene, double ratio) {
  Scene result = scene;
  std::vector<int> driven;
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    if (drives(scene.elements[e])) driven.push_back(static_cast<int>(e));
  }
  const int added = static_cast<int>(driven.size());
  const auto moved = [added](NodeId node) { return node == ground ? ground : node + added; };
  std::vector<SceneNode> nodes{scene.nodes.front()};
  for (const int e : driven) nodes.push_back({.name = scene.elements[at(e)].name + "_shaft", .spot = {}});
  nodes.insert(nodes.end(), scene.nodes.begin() + 1, scene.nodes.end());
  result.nodes = nodes;
  for (SceneElement& element : result.elements) {
    element.a = moved(element.a);
    element.b = moved(element.b);
  }
  for (Record& record : result.records) {
    if (record.subject == Record::Subject::node) record.index = moved(record.index);
  }
  for (int k = 0; k < added; ++k) {
    SceneElement& drive = result.elements[at(driven[at(k)])];
    const bool motion = components()[at(drive.declaration)]->role == Role::motion;
    drive.signals.own()[0] = transformed(drive.signals[0], motion ? ratio : 1 / ratio);
    SceneElement gear = SceneBuilder::element(drive.name + "_gear", "gear", {{"ratio", ratio}});
    gear.a = k + 1;
    gear.b = std::exchange(drive.a, k + 1);
    start_alike(drive, result.nodes[at(gear.a)], result.nodes[at(gear.b)], ratio);
    result.elements.push_back(gear);
  }
  return result;
}

void check_behind_gears(double ratio) {
  for_each(cases(), [ratio](const Case&, const Situation& situation) {
    const Scene& scene = situation.scene;
    check_related(scene, simulate(scene), simulate(behind_gears(scene, ratio)), [&](const Record& r) {
      const bool of_drive = r.subject == Record::Subject::element && drives(scene.elements[at(r.index)]);
      if (!of_drive) return Relation{};
      return Relation{.factor = r.channel == Record::Channel::force ? 1 / ratio : ratio};
    });
  });
}

}  // namespace

TEST_CASE("contract: what is driven through gears is the same as what is driven directly") { check_behind_gears(2.371); }

TEST_CASE("contract: gears may turn the direction round") { check_behind_gears(-0.413); }

}  // namespace rheonet::test
