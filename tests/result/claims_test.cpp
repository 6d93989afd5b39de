// Claims on results against closed forms: figures do not depend on where the rows are.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/claims.hpp"
#include "core/result/run.hpp"

namespace rheonet::test::claims_test {

namespace {

std::vector<Finding> findings(const std::string& toml) {
  const ReadResult read = read_scene_text(toml, "scene.toml", {}, declarations());
  for (const Diagnostic& diagnostic : read.diagnostics) FAIL_CHECK(format(diagnostic, read.sources));
  REQUIRE(read.scene);
  return run(*read.scene).findings;
}

void check_all_hold(const std::string& toml) {
  const auto all = findings(toml);
  CHECK_GT(all.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i)
    CHECK_MESSAGE(all[i].holds, fmt::format("claim {}: {:.12g}, tolerance {:.3g}", i, all[i].found, all[i].tolerance));
}

}  // namespace

TEST_CASE("Claims: a sine, prescribed, in rows too few to show it") {
  // 3 sin(2 pi 0.7 t + 0.4) from 0.2 s to 2.9 s
  const auto x = [](double t) { return 3 * std::sin(2 * std::numbers::pi * 0.7 * t + 0.4); };
  const auto crossed = [](double level, int period) {
    return (std::numbers::pi * (2 * period + 1) - std::asin(level / 3) - 0.4) / (2 * std::numbers::pi * 0.7);
  };
  const double w = 2 * std::numbers::pi * 0.7;
  const double mean = 3 / w * (std::cos(w * 0.5 + 0.4) - std::cos(w * 2.1 + 0.4)) / 1.6;
  const double squares =
      9.0 / 2 * (1 - (std::sin(2 * (w * 2.1 + 0.4)) - std::sin(2 * (w * 0.5 + 0.4))) / (2 * w) / 1.6);
  for (const int points : {28, 400}) {
    CAPTURE(points);
    check_all_hold(fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "a", position = {{ sine = 3, frequency = 0.7, phase = 0.4 }} }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = 2 }}
[simulate]
start = 0.2
stop = 2.9
accuracy = 1e-7
output = {{ points = {} }}
[expect]
"a.position" = [
  {{ at = 1.2345, value = {:.15g} }}, {{ at = 0.2, value = {:.15g} }}, {{ final = {:.15g} }}, {{ at = 2.9, value = {:.15g} }},
  {{ max = 3 }}, {{ min = -3 }}, {{ mean = {:.15g}, from = 0.5, to = 2.1 }},
  {{ rms = {:.15g}, from = 0.5, to = 2.1 }}, {{ crosses = 1.1, at = {:.15g} }},
  {{ crosses = 1.1, at = {:.15g}, from = 1.7 }},
]
"k.force" = {{ rms = 2, per = "a.position" }}
)",
                               points, x(1.2345), x(0.2), x(2.9), x(2.9), mean, std::sqrt(squares), crossed(1.1, 0),
                               crossed(1.1, 1)));
  }
}

TEST_CASE("Claims: extremes of a sine in three rows, and a level just below its top") {
  check_all_hold(R"(
[elements]
drive = { type = "motion", at = "a", position = { sine = "1 m", frequency = "1 Hz" } }
k = { type = "spring", between = ["a", "ground"], stiffness = "1 N/m" }
[simulate]
stop = 1
output = { points = 3 }
[expect]
"a.position" = [{ max = 1 }, { min = -1 }, { mean = 0.6366197723675814, to = 0.5 }, { rms = 0.7071067811865476 }]
"k.force" = [{ max = 1 }, { crosses = 0.99999999, at = 0.24997749, within = 1e-8 }]
)");
}

TEST_CASE("Claims: jumps count on both sides, and cross a level in no time") {
  check_all_hold(R"(
[elements]
hand = { type = "motion", at = "grip", position = { step = 2, time = 1.0 } }
k1 = { type = "spring", between = ["grip", "mid"], stiffness = 3 }
c1 = { type = "dashpot", between = ["mid", "ground"], damping = 1.5 }
[simulate]
stop = 2
output = { points = 7 }
[expect]
"k1.force" = [
  { max = 6 }, { at = 1, value = 6 }, { at = 0.999999, value = 0 }, { crosses = 5, at = 1, within = "1 ns" },
  { min = 0.81201169941967606, from = 1 }, { max = 0, to = 0.99 }, { mean = 2.593994, from = 1, within = "1 uN" },
  { crosses = 3, from = 1, at = 1.3465735902799727 },
]
"grip.position" = { mean = 1, within = 1e-12 }
)");
}

TEST_CASE("Claims: what is not so fails, by as little as the tolerance says, and does on both sides") {
  const auto claim = [](const std::string& text) {
    return findings(R"([elements]
drive = { type = "motion", at = "a", velocity = 2 }
c = { type = "dashpot", between = ["a", "ground"], damping = 1 }
[simulate]
stop = 1
[expect]
"a.position" = )" + text +
                    "\n")
        .at(0);
  };
  for (const auto& [text, holds] : std::initializer_list<std::pair<const char*, bool>>{
           {"{ final = 2.0101, within = \"0.01 m\" }", false},
           {"{ final = 2.0099, within = \"0.01 m\" }", true},
           {"{ final = 1.9901, within = \"0.01 m\" }", true},
           {"{ final = 1.9899, within = \"0.01 m\" }", false},
           {"{ final = 2.0101, within = 0.005 }", false},
           {"{ final = 2.0099, within = 0.005 }", true},
           {"{ max = [1.99, 2.01] }", true},
           {"{ max = [2.01, 2.02] }", false},
           {"{ max = [1.98, 1.99] }", false},
           {"{ crosses = 1, at = 0.5009, within = 0.001 }", true},
           {"{ crosses = 1, at = 0.5011, within = 0.001 }", false},
           {"{ crosses = 3, at = 0.5 }", false},
           {"{ crosses = 0, at = 0 }", false},
           {"{ mean = 0.5005, per = \"c.velocity\", within = 2e-3 }", true},
           {"{ mean = 0.5005, per = \"c.velocity\", within = 0.5e-3 }", false}}) {
    CAPTURE(text);
    const Finding finding = claim(text);
    CHECK_MESSAGE(finding.holds == holds, finding.found);
  }
}

namespace {

/// Claims on one record of a run from 0 s to 1 s that is looked at in pieces of 0.5 s, followed as far as `end`.
Finding of_course(const Claim& claim, const std::function<double(double)>& x, double end = 1, double accuracy = 1e-6) {
  Scene scene;
  scene.accuracy = accuracy;
  scene.stop = 1;
  scene.output_every = 0.5;
  scene.claimed.push_back({"a.position", Record::Subject::node, 1, Record::Channel::position});
  scene.claims.push_back(claim);
  scene.claims.back().to = 1;
  Claims claims(scene);
  std::vector<double> row{x(0)};
  claims.begin(0, row);
  claims.step(0, end, [&](double t) -> const std::vector<double>& {
    row[0] = x(t);
    return row;
  });
  return claims.findings().at(0);
}

Claim claim_of(Claim::Figure figure) {
  Claim claim;
  claim.figure = figure;
  return claim;
}

Claim crossing(double level) {
  Claim claim = claim_of(Claim::Figure::crossing);
  claim.level = level;
  return claim;
}

}  // namespace

TEST_CASE("Claims: a level that is reached between the places where a record is looked at, and one just beyond") {
  // The top, 1 at 0.29 s, lies between two of them, where the record is at most 0.95.
  const auto hump = [](double t) { return 1 - 9 * (t - 0.29) * (t - 0.29) * (1 + 0.1 * (t - 0.29)); };
  const Finding under = of_course(crossing(0.9999), hump);
  CHECK(hump(under.found) == doctest::Approx(0.9999).epsilon(1e-12));
  CHECK(under.found < 0.29);
  CHECK(std::isnan(of_course(crossing(1.0001), hump).found));
  CHECK(std::abs(of_course(claim_of(Claim::Figure::max), hump).found - 1) <= 1e-12);
  // The same downwards, and only from the start of the interval.
  const auto dip = [&](double t) { return -hump(t); };
  CHECK(of_course(crossing(-0.9999), dip).found == under.found);
  CHECK(std::abs(of_course(claim_of(Claim::Figure::min), dip).found + 1) <= 1e-12);
  Claim later = crossing(0.9999);
  later.from = 0.29;
  CHECK(of_course(later, hump).found > 0.29);
}

TEST_CASE("Claims: of a sine that output intervals hardly show all figures are exact to the accuracy") {
  // 1.5 periods in each of the two intervals; the one at phase 0 is odd about their middles.
  for (const double accuracy : {1e-3, 1e-6, 1e-9, 1e-12})
    for (const double phase : {0.0, 0.43, 1.9}) {
      CAPTURE(accuracy);
      CAPTURE(phase);
      const double w = 6 * std::numbers::pi;
      long reads = 0;
      const auto x = [&](double t) {
        ++reads;
        return 2.3 * std::sin(w * t + phase);
      };
      const auto found = [&](const Claim& claim) { return of_course(claim, x, 1, accuracy).found; };
      CHECK(std::abs(found(claim_of(Claim::Figure::max)) - 2.3) <= accuracy * 2.3);
      CHECK(std::abs(found(claim_of(Claim::Figure::min)) + 2.3) <= accuracy * 2.3);
      CHECK(std::abs(found(claim_of(Claim::Figure::mean))) <= accuracy * 2.3);
      CHECK(std::abs(found(claim_of(Claim::Figure::rms)) - 2.3 / std::sqrt(2)) <= accuracy * 2.3);
      for (const int side : {-1, 1}) {
        // Just below the top and just above the bottom, closer than the accuracy shows; then as far beyond.
        const double first = found(crossing(side * 2.3 * (1 - 4 * accuracy)));
        CHECK(first > 0);
        CHECK(first < 1.0 / 3);
        CHECK(std::isnan(found(crossing(side * 2.3 * (1 + 4 * accuracy)))));
      }
      CHECK(reads < 8 * 40 * std::pow(accuracy, -0.25));
    }
}

TEST_CASE("Claims: rounding is not followed: a record without a course costs no more than a few halvings") {
  long reads = 0;
  const auto noise = [&](double t) {
    ++reads;
    return 1e-18 * std::sin(1e9 * t);
  };
  of_course(claim_of(Claim::Figure::max), noise);
  CHECK(reads > 100);
  CHECK(reads < 1000);
}

TEST_CASE("Claims: a level is reached by what comes to it as by what jumps to it or over it") {
  const auto slide = [](double t) { return std::min(0.7, 2 * t); };
  CHECK(of_course(crossing(0.7), slide).found == doctest::Approx(0.35).epsilon(1e-12));
  CHECK(std::isnan(of_course(crossing(0.70001), slide).found));
  for (const auto& [level, reached] : {std::pair(2.0, true), {1.3, true}, {2.0001, false}}) {
    CAPTURE(level);
    Scene scene;
    scene.stop = 1;
    scene.output_every = 0.5;
    scene.claimed.push_back({"a.position", Record::Subject::node, 1, Record::Channel::position});
    scene.claims.push_back(crossing(level));
    scene.claims.back().to = 1;
    Claims claims(scene);
    claims.begin(0, {1});
    claims.begin(0.25, {2});
    CHECK_EQ(claims.findings().at(0).found == 0.25, reached);
  }
}

TEST_CASE("Claims: a time that a run has not come to has no value, but for rounding of its end") {
  const auto x = [](double t) { return 3 * t; };
  Claim at = claim_of(Claim::Figure::at);
  at.time = 1;
  CHECK(of_course(at, x).found == 3);
  CHECK(of_course(at, x, 1 - 1e-13).found == doctest::Approx(3));
  CHECK(std::isnan(of_course(at, x, 0.999).found));
  at.time = 0.4;
  CHECK(of_course(at, x).found == 3 * 0.4);
}

TEST_CASE("Claims: what a drive does many times between two rows is not missed") {
  for (const double frequency : {0.3, 5.3, 7.0, 14.5, 29.0, 38.0, 47.0, 123.0}) {
    for (const double phase : {0.0, 5.0}) {
      CAPTURE(frequency);
      CAPTURE(phase);
      // First half as large a peak, and slower: after that larger ones may come.
      const auto found = findings(fmt::format(R"([elements]
one = {{ type = "motion", at = "a", velocity = {{ table = [[0, 0], [0.5, -0.5], [1, 0]] }} }}
two = {{ type = "motion", at = "b", velocity = {{ sine = 1, frequency = {0}, phase = {1}, time = 1 }} }}
c = {{ type = "dashpot", between = ["b", "a"], damping = 1 }}
[simulate]
stop = 5
accuracy = 1e-6
output = {{ every = 1 }}
record = ["c.force"]
[expect]
"c.force" = [{{ max = 1 }}, {{ min = -1 }}, {{ crosses = 0.9, from = 1.0001, at = 2, within = 1 }}]
)",
                                               frequency, phase));
      CHECK(std::abs(found.at(0).found - 1) <= 1e-6);
      CHECK(std::abs(found.at(1).found + 1) <= 1e-6);
      const double pi = std::numbers::pi, top = std::asin(0.9);
      // Angles at which the sine is at the level: top and pi - top, and a turn later.
      double first = std::numeric_limits<double>::infinity();
      for (int turn = -1; turn < 3; ++turn) {
        for (const double angle : {top, pi - top}) {
          const double t = 1 + (angle + 2 * pi * turn - phase) / (2 * pi * frequency);
          if (t > 1.0001) first = std::min(first, t);
        }
      }
      CHECK(std::abs(found.at(2).found - first) <= 1e-9);
    }
  }
}

}  // namespace rheonet::test::claims_test
