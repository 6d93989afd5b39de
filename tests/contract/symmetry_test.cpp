#include <doctest/doctest.h>

#include "tests/contract/compare.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test::symmetry_test {

namespace {

/// Records that tell where something is, not how far two things are apart.
bool absolute(const Scene& scene, const Record& record) {
  return record.subject == Record::Subject::node ||
         (record.subject == Record::Subject::element && scene.elements[static_cast<std::size_t>(record.index)].at);
}

bool place(const Record& record) {
  return record.channel == Record::Channel::position || record.channel == Record::Channel::displacement;
}

}  // namespace

TEST_CASE("contract: nothing depends on where the origin is") {
  for_each(cases(true), [](const Case& c, const Situation& situation) {
    const double dx = -3.3 * typical.of(Quantity::position, c.place.domain);
    const Scene& scene = situation.scene;
    check_related(scene, simulate(scene), simulate(shifted(scene, dx)),
                  [&](const Record& r) { return Relation{.offset = absolute(scene, r) && place(r) ? dx : 0}; });
  });
}

TEST_CASE("contract: a node that rests is as good as ground") {
  for_each(cases(), [](const Case& c, const Situation& situation) {
    Place place = c.place;
    place.moving_base = true;
    const Scene based = situate(*c.component, c.values, place, c.seed).scene;
    check_related(situation.scene, simulate(situation.scene), simulate(based),
                  [](const Record&) { return Relation{}; });
  });
}

TEST_CASE("contract: nothing depends on the velocity of the frame") {
  for_each(cases(true, true), [](const Case& c, const Situation& situation) {
    const double v = 2.3 * typical.of(Quantity::velocity, c.place.domain);
    const Scene& scene = situation.scene;
    check_related(scene, simulate(scene), simulate(boosted(scene, v)), [&](const Record& r) {
      if (!absolute(scene, r) || r.channel == Record::Channel::force) return Relation{};
      return place(r) ? Relation{.drift = v} : Relation{.offset = v};
    });
  });
}

TEST_CASE("contract: a world with left and right exchanged is the same") {
  for_each(cases(), [](const Case&, const Situation& situation) {
    const Scene& scene = situation.scene;
    check_related(scene, simulate(scene), simulate(negated(scene)),
                  [&](const Record& r) {
                    const bool turned = r.subject == Record::Subject::element && one_way(scene.elements[static_cast<std::size_t>(r.index)]);
                    return Relation{.factor = turned ? 1.0 : -1.0};
                  });
  });
}

TEST_CASE("contract: an element the other way round is the same with its signs changed") {
  for_each(cases(), [](const Case&, const Situation& situation) {
    const Scene& scene = situation.scene;
    const SceneElement& element = scene.elements[static_cast<std::size_t>(situation.element)];
    if (element.at || one_way(element)) return;
    check_related(scene, simulate(scene), simulate(exchanged(scene, situation.element)), [&](const Record& r) {
      const bool own = r.subject == Record::Subject::element && r.index == situation.element;
      return Relation{.factor = own ? -1.0 : 1.0};
    });
  });
}

TEST_CASE("contract: nothing depends on the units") {
  for_each(cases(), [](const Case&, const Situation& situation) {
    const Scene& scene = situation.scene;
    for (const Scaling units : {Scaling{39.37, 0.0173, 7.233}, Scaling{0.0031, 261.7, 1.9e-5}}) {
      check_related(
          scene, simulate(scene), simulate(rescaled(scene, units)),
          [&](const Record& r) { return Relation{.factor = factor(scene, r, units)}; }, units.time);
    }
  });
}

}  // namespace rheonet::test::symmetry_test
