#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/contract/compare.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::limits_test {

namespace {

/// The scene with the law of the limit written out in place of the element: another type, or nothing.
Scene with_limit_law(Scene scene, int index, const Limit& limit) {
  SceneElement& e = scene.elements[static_cast<std::size_t>(index)];
  if (!limit.becomes.empty()) {
    e.declaration = SceneBuilder::element("", limit.becomes).declaration;
    std::vector<double> values = limit.values(e.values);
    values.resize(declarations()[static_cast<std::size_t>(e.declaration)]->parameters.size(), not_given);
    e.values = values;
    e.signals = {};  // those of parameters of the law before
    e.signal_parameters = {};
    return scene;
  }
  scene.elements.erase(scene.elements.begin() + index);
  std::erase_if(scene.records,
                [&](const Record& r) { return r.subject == Record::Subject::element && r.index == index; });
  for (Record& r : scene.records) {
    if (r.subject == Record::Subject::element && r.index > index) --r.index;
  }
  return scene;
}

/// Values near the limit: those that are 0 or infinite there, by `small` of or over their generic ones.
std::vector<double> near(const std::vector<double>& limit, const std::vector<double>& generic, double small) {
  std::vector<double> result = limit;
  for (std::size_t k = 0; k < limit.size(); ++k) {
    if (limit[k] == generic[k] || std::isnan(limit[k])) continue;
    const double usual = std::isnan(generic[k]) ? 1 : generic[k];  // In place of a signal or of an optional parameter.
    result[k] = limit[k] == 0 ? small * usual : usual / small;
  }
  return result;
}

/// Initial values are what a law remembers, and a delay is too; at a limit it may have no memory.
std::vector<double> without_initial(const Component& component, std::vector<double> values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Parameter& p = component.declaration.parameters[k];
    if (p.kind == Parameter::Kind::initial) values[k] = not_given;
    if (p.quantity == Quantity::time) values[k] = p.fallback.value_or(values[k]);
  }
  return values;
}

/// The limit is a link that nothing moves.
bool rigid(const Limit& limit, const std::vector<double>& values) {
  return limit.becomes == "slider" && std::isinf(limit.values(values)[0]);
}

/// Removes start velocities: a node that a rigid link joins to ground or to a motion cannot have one.
Scene without_velocities(Scene scene) {
  for (SceneNode& node : scene.nodes) node.velocity = not_given;
  return scene;
}

/// Where the trajectory of values near the limit is not near that of the limit.
std::vector<std::string> misses_of(const Scene& law, const RunTable& nearby, const RunTable& of_limit) {
  constexpr double distance = 1e-5;
  std::vector<std::string> misses;
  for (const Record& r : law.records) {
    // A record that only the element causes is 0 at the limit, and has no scale there.
    const double scale = std::max(of_limit.scale(r.path), factor(law, r, typical));
    double worst = 0;
    for (std::size_t row = 1; row < nearby.time().size(); ++row) {
      worst = std::max(worst, std::abs(nearby[r.path][row] - of_limit[r.path][row]));
    }
    if (!(worst <= distance * (scale + nearby.scale(r.path)))) {
      misses.push_back(fmt::format("{}: {:.3g} from the limit of {:.3g}", r.path, worst, scale));
    }
  }
  return misses;
}

std::string refusal(const Scene& scene) {
  try {
    simulate(scene);
    return "";
  } catch (const SimulationError& refused) {
    return refused.what();
  }
}

}  // namespace

TEST_CASE("contract: at a limit a law is the law of the limit") {
  int tried = 0, compared = 0;
  for_each(cases(), [&](const Case& c, const Situation& situation) {
    const std::vector<double> generic = without_initial(*c.component, c.values);
    for (std::size_t k = 0; k < c.component->limits.size(); ++k) {
      const Limit& limit = c.component->limits[k];
      CAPTURE(limit.when);
      // No netlist can name the law of such a limit: it has tests of its own.
      if (!limit.becomes.empty() && find_component(limit.becomes)->hidden) continue;
      const std::vector<double> values = values_at_limit(*c.component, k, generic);
      REQUIRE_MESSAGE(!values.empty(), "no values within the bounds are at the limit");
      const bool held = rigid(limit, values) && c.place.wiring != Wiring::free;
      Scene of_values = situate(*c.component, values, c.place, c.seed).scene;
      // A law of a limit may be one with others, and one without a force leaves more parts: the last digits would differ.
      of_values.keep = {"parts", "chains"};
      const Scene at_limit = held ? without_velocities(of_values) : of_values;
      const Scene law = with_limit_law(at_limit, situation.element, limit);
      if (rigid(limit, values) && c.place.wiring == Wiring::given) {
        CHECK_NE(refusal(at_limit), "");
        CHECK_EQ(refusal(at_limit), refusal(law));
        continue;
      }
      const RunTable of_limit = simulate(at_limit);
      check_identical(of_limit, simulate(law));

      // The limit is the right law: the trajectory for nearby values is close to it, except at the start, where the change that the limit
      // makes at once takes a moment.
      // A law that sticks is not approached smoothly: a nearly rigid element rings.
      if (limit.becomes == "slider") continue;
      // The difference may fall like a small power of the distance from the limit; then a much smaller distance is needed.
      constexpr double distances[] = {1e-9, 1e-60};
      ++tried;
      std::vector<std::string> misses;
      for (const double small : distances) {
        RunTable nearby;
        try {
          Scene scene = situate(*c.component, near(values, generic, small), c.place, c.seed).scene;
          scene.method = Scene::Method::ida;  // a spring with hardly any inertance rings for ever, which IDA steps over
          nearby = simulate(scene);
        } catch (const SimulationError&) {
          break;  // a velocity that goes with a high power of 1/small is beyond any numbers
        }
        if (small == distances[0]) ++compared;
        misses = misses_of(law, nearby, of_limit);
        if (misses.empty()) break;
      }
      for (const std::string& miss : misses) FAIL_CHECK(miss);
    }
  });
  CHECK_MESSAGE(compared >= 0.95 * tried, compared << " of " << tried << " could be run near the limit");
}

}  // namespace rheonet::test::limits_test
