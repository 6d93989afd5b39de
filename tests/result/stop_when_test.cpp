// `simulate.stop_when`: a run that ends at an event.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/network/component.hpp"
#include "core/result/certify.hpp"
#include "core/result/run.hpp"
#include "tests/netlist/reading.hpp"
#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::stop_when_test {

namespace {

/// A body under a constant force: x = t^2.
std::string falling(const std::string& simulate, const std::string& elements = "") {
  return "[parameters]\nxmax = \"0.5 m\"\nvmax = \"2.4 m/s\"\ntau = \"0.5 s\"\nfmax = \"1 N\"\npmax = \"12 W\"\nt1 = \"1.3 s\"\n[elements]\nm = { type = \"mass\", at = \"a\", mass = \"2 kg\" }\n"
         "f = { type = \"force\", at = \"a\", force = \"4 N\" }\n" + elements + "[simulate]\nstop = \"2 s\"\noutput = { every = \"0.1 s\" }\n" + simulate;
}

Scene read_at(const std::string& text, double accuracy = 0) { return scene_of(text, accuracy); }

bool notes_contain(const Summary& summary, const std::string& text) {
  return std::any_of(summary.notes.begin(), summary.notes.end(), [&](const std::string& note) { return note.find(text) != note.npos; });
}

std::string messages_of(const std::string& text) {
  return messages(read_scene_text(text, "scene.toml", "no-such-folder", declarations(), {}));
}

}  // namespace

TEST_CASE("stop_when: the run ends at the event, with a row there") {
  for (const double accuracy : accuracies) {
    const Attempt run = attempt(read_at(falling("stop_when = \"a.position > xmax\"\n"), accuracy));
    REQUIRE_EQ(run.refusal, "");
    REQUIRE(run.summary.ended);
    CHECK(std::abs(*run.summary.ended - std::sqrt(0.5)) <= accuracy);
    REQUIRE_EQ(run.rows.time().size(), 9);  // 0 to 0.7 s, and the end
    CHECK_EQ(run.rows.time().back(), *run.summary.ended);
    CHECK(std::abs(run.rows["a.position"].back() - 0.5) <= 10 * accuracy);
    CHECK(notes_contain(run.summary, "the run ended at 0.7071"));
    CHECK(notes_contain(run.summary, "`a.position > xmax` came true (`stop_when`)"));
    CHECK_EQ(run.rows.header.size(), 5);  // time, position, velocity, two forces: no column for the condition
  }
}

TEST_CASE("stop_when: one row where the end is an output time, a pair with output.events") {
  const std::string signal = "u = { type = \"generator\", signal = { step = 2, time = 0.5 } }\n";
  const Attempt run = attempt(read_at(falling("stop_when = \"u.out > 1\"\n", signal)));
  REQUIRE_EQ(run.refusal, "");
  CHECK_EQ(run.rows.time().size(), 6);
  CHECK_EQ(run.rows.time().back(), 0.5);
  CHECK_EQ(run.rows["u.out"].back(), 2);
  std::string text = falling("stop_when = \"a.position > xmax\"\n");
  text.replace(text.find("\"0.1 s\""), 7, "\"0.1 s\", events = true");
  const Attempt pair = attempt(read_at(text));
  REQUIRE_EQ(pair.rows.time().size(), 10);
  CHECK_EQ(pair.rows.time()[8], pair.rows.time()[9]);
}

TEST_CASE("stop_when: a condition that never comes true is a note, one that holds at the start is refused") {
  const Attempt run = attempt(read_at(falling("stop_when = \"a.position < -xmax\"\n")));
  CHECK_FALSE(run.summary.ended);
  CHECK_EQ(run.rows.time().size(), 21);
  CHECK(notes_contain(run.summary, "`a.position < -xmax` (`stop_when`) did not come true: the run went on to its stop"));
  CHECK_EQ(refusal(falling("stop_when = \"a.position < xmax\"\n")),
           "the condition of `stop_when`, `a.position < xmax`, holds at the start: the run would end before it begins; "
           "`stop_when` is what is to happen later");
}

TEST_CASE("stop_when: conditions of several comparisons, and of every kind of record") {
  // Beside it an oscillator: x = 2 (1 - cos t).
  const std::string more = "m2 = { type = \"mass\", at = \"b\", mass = \"2 kg\" }\nf2 = { type = \"force\", at = \"b\", force = \"4 N\" }\n"
                           "k = { type = \"spring\", between = [\"b\", \"ground\"], stiffness = \"2 N/m\" }\n"
                           "g = { type = \"gain\", in = \"a.velocity\", gain = 3 }\n";
  const auto ends_at = [&](const std::string& condition, double expected) {
    CAPTURE(condition);
    const Attempt run = attempt(read_at(falling("stop_when = \"" + condition + "\"\nrecord = [\"m.power\", { name = \"twice\", value = \"2*a.position\" }, { name = \"more\", value = \"twice + xmax\" }]\n", more), 1e-7));
    CHECK_EQ(run.refusal, "");
    REQUIRE(run.summary.ended);
    CHECK(std::abs(*run.summary.ended - expected) <= 1e-6);
  };
  ends_at("a.velocity > vmax && a.position > xmax && xmax > 0", 1.2);  // v = 2t
  ends_at("a.position > xmax || a.velocity > 4*xmax/tau", std::sqrt(0.5));
  ends_at("m.velocity >= vmax", 1.2);
  ends_at("k.force > fmax", std::acos(0.75));
  ends_at("k.displacement >= 2*xmax", std::acos(0.5));
  ends_at("k.power > 0*pmax && k.velocity < 0.77*vmax && b.position > 2.5*xmax", std::numbers::pi - std::asin(0.924));
  ends_at("f.power > pmax", 1.5);  // 8t
  ends_at("g.out > 3*vmax", 1.2);
  ends_at("twice > 2*xmax", std::sqrt(0.5));
  ends_at("more > 2.5*xmax", std::sqrt(0.375));
  ends_at("t > t1 && a.position > 0*xmax", 1.3);
  ends_at("abs(a.position - xmax) > 2*xmax", std::sqrt(1.5));
}

TEST_CASE("stop_when: independent parts end together, and what the condition needs is not left out") {
  const std::string others = "m2 = { type = \"mass\", at = \"b\", mass = 1 }\nk2 = { type = \"spring\", between = [\"b\", \"ground\"], stiffness = 100 }\n"
                             "p = { type = \"motion\", at = \"c\", velocity = { sine = 1, frequency = 2 } }\ns = { type = \"slider\", between = [\"c\", \"d\"], coulomb = 1 }\n"
                             "m3 = { type = \"mass\", at = \"d\", mass = 0.3 }\n";
  const Attempt run = attempt(read_at(falling("stop_when = \"a.position > xmax\"\nrecord = [\"b.velocity\", \"d.velocity\"]\n", others)));
  REQUIRE(run.summary.ended);
  CHECK(std::abs(*run.summary.ended - std::sqrt(0.5)) <= 1e-6);
  CHECK_EQ(run.rows.time().size(), 9);
  CHECK_EQ(run.summary.parts, 1);
}

TEST_CASE("stop_when: behind a gear, beside merged springs, and certified") {
  const std::string text = "[elements]\nj = { type = \"inertia\", at = \"shaft\", inertia = 2 }\nt = { type = \"torque\", at = \"shaft\", torque = 4 }\n"
                           "g = { type = \"gear\", between = [\"shaft\", \"drum\"], ratio = 4 }\n"
                           "c = { type = \"spring\", between = [\"far\", \"ground\"], stiffness = 1, repeat = { count = 5 } }\n"
                           "d = { type = \"dashpot\", between = [\"drum\", \"far\"], damping = 1e-9 }\n"
                           "[simulate]\nstop = 2\nstop_when = \"drum.position > 0.125\"\nrecord = [\"shaft.position\"]\n";
  const Scene scene = read_at(text);
  Summary summary;
  const RunTable run = simulate(scene, &summary);
  REQUIRE(summary.ended);
  CHECK(std::abs(*summary.ended - std::sqrt(0.5)) <= 1e-6);
  CHECK(std::abs(run["shaft.position"].back() - 0.5) <= 1e-6);
  const Certificate certificate = certify(read_at(falling("stop_when = \"a.position > xmax\"\n")), {});
  CHECK(certificate.holds);
  REQUIRE(certificate.summary.ended);
  CHECK(std::abs(*certificate.summary.ended - std::sqrt(0.5)) <= 1e-6);
}

TEST_CASE("stop_when: claims hold for the part that was run") {
  const Attempt run = attempt(read_at(falling("stop_when = \"a.position > xmax\"\n[expect]\n\"a.position\" = [{ final = 0.5 }, { max = 0.5 }, { at = 1, value = 1 }]\n"
                                               "\"a.velocity\" = { mean = 0.70710678 }\n")));
  REQUIRE(run.summary.findings.size() == 4);
  CHECK(run.summary.findings[0].holds);
  CHECK(run.summary.findings[1].holds);
  CHECK_FALSE(run.summary.findings[2].holds);
  CHECK(std::isnan(run.summary.findings[2].found));
  CHECK(run.summary.findings[3].holds);
}

TEST_CASE("stop_when: mistakes") {
  const auto of = [](const std::string& condition, const std::string& more = "") {
    return messages_of("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\ns = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = 1 }\n"
                       "[simulate]\nstop = 1\nstop_when = " + condition + "\n" + more);
  };
  CHECK_EQ(of("\"a.position > 0 && a.velocity > 0\""), "");
  CHECK_EQ(of("3"), R"~(scene.toml:6:13: error: `stop_when` must be a string, but is the number 3
    6 | stop_when = 3
      |             ^
  stop_when = "a.position > xmax"
)~");
  CHECK_EQ(of("\"a.position\""), R"~(scene.toml:6:13: error: `stop_when` must be a comparison, but is the string "a.position"
    6 | stop_when = "a.position"
      |             ^
  stop_when = "a.position > xmax"
)~");
  CHECK_EQ(of("\"0 < a.position < 1\""), R"~(scene.toml:6:29: error: `stop_when`: a comparison has two sides
    6 | stop_when = "0 < a.position < 1"
      |                             ^
  two of them are joined with `&&`: "0 < a.position && a.position < xmax"
)~");
  CHECK_EQ(of("\"3 > 2\""), R"~(scene.toml:6:13: error: `stop_when` depends on no record
    6 | stop_when = "3 > 2"
      |             ^
  `stop` says when a run ends in any case; stop_when = "a.position > xmax"
)~");
  CHECK_EQ(of("\"a.position > b.position\""), R"~(scene.toml:6:27: error: nothing is called `b`
    6 | stop_when = "a.position > b.position"
      |                           ^
)~");
  CHECK_EQ(of("\"gap > 1\""), R"~(scene.toml:6:14: error: `stop_when`: unknown name `gap`
    6 | stop_when = "gap > 1"
      |              ^
  it must be a parameter
)~");
  CHECK_EQ(of("\"a.position > a.velocity\""), R"~(scene.toml:6:27: error: `stop_when`: `a.position` is a length (m), `a.velocity` is a velocity (m/s): they cannot be compared
    6 | stop_when = "a.position > a.velocity"
      |                           ^
)~");
  CHECK_EQ(of("\"a.position > xmax\""), R"~(scene.toml:6:27: error: `stop_when`: unknown name `xmax`
    6 | stop_when = "a.position > xmax"
      |                           ^
  it must be a parameter
)~");
  CHECK_EQ(of("\"a.acceleration > 0\""), R"~(scene.toml:6:14: error: `stop_when` cannot depend on `a.acceleration`
    6 | stop_when = "a.acceleration > 0"
      |              ^
  it may depend on positions, velocities, displacements, forces, powers of elements, and outputs of blocks
)~");
  CHECK(refusal("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\ns = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = 1 }\n"
                "[simulate]\nstop = 1\nstop_when = \"s.force > 0\"\n").find("`stop_when` cannot depend on `s.force`") != std::string::npos);
}

}  // namespace rheonet::test::stop_when_test
