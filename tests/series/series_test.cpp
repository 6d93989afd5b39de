// Elements in series without a mass between them have one force.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/network/error.hpp"
#include "core/result/certify.hpp"
#include "tests/series/chain.hpp"

namespace rheonet::test::series_test {

namespace {

constexpr double accuracies[] = {1e-3, 1e-6, 1e-9};
// Allowed error of a run that is not certified, as a multiple of the accuracy.
constexpr double plain_share = 10;

struct Rows {
  std::vector<double> times;
  std::vector<std::vector<double>> values;
  void operator()(double t, const std::vector<double>& row) {
    times.push_back(t);
    values.push_back(row);
  }
};

double worst_of(const Chain& chain, const Rows& rows) {
  const double apart = stages_apart(chain, rows.values);
  return chain.kind == Chain::Kind::steady ? std::max(apart, off_closed_form(chain, rows.times, rows.values)) : apart;
}

struct Tally { int refused = 0, not_certified = 0, slow = 0; };

// Steps of a run beyond which it is not waited for. Most chains take less than 1,000.
constexpr long most_steps = 100000;

/// Settings of a run that is interrupted after so many steps.
struct Limited {
  std::atomic<bool> stop = false;
  long steps = 0;

  RunSettings settings(Rows& rows) {
    steps = 0;
    return {.row = std::ref(rows), .interrupt = &stop, .progress = [this](double) { stop = stop || ++steps > most_steps; }};
  }
};

/// Runs a chain as it is, and certified.
void judge(const Chain& chain, Tally& tally) {
  CAPTURE(chain.toml);
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const Scene scene = scene_of(chain.toml, accuracy);
    Limited limited;
    try {
      Rows plain, certified;
      run(scene, limited.settings(plain));
      CHECK(worst_of(chain, plain) <= plain_share * accuracy);
      if (certify(scene, limited.settings(certified)).holds) {
        CHECK(worst_of(chain, certified) <= accuracy);
      } else {
        ++tally.not_certified;
      }
    } catch (const SimulationError& error) {
      // A node that is pushed by more than friction can take moves without bound.
      CHECK_MESSAGE((limited.stop || chain.kind == Chain::Kind::pushed), error.what());
      ++(limited.stop ? tally.slow : tally.refused);
    }
  }
}

void judge_all(int first, int count) {
  Tally tally;
  for (int number = first; number < first + count; ++number) judge(random_chain(number), tally);
  MESSAGE(count << " chains: " << tally.not_certified << " runs not certified, " << tally.refused << " refused, " << tally.slow
                << " too slow");
  CHECK(tally.not_certified <= count / 5);
  CHECK(tally.slow <= count / 20);
}

struct Pair { const char* what; const char* toml; };

const Pair pairs[] = {
    {"friction that relaxes rises between two steps of the integrator, in series with a dashpot to ground", R"([elements]
push = { type = "motion", at = "end", position = { ramp = 9.65, time = 0.189 } }
oil = { type = "dashpot", between = ["mid", "ground"], damping = 3.41e3 }
grip = { type = "cfm", between = ["end", "mid"], coulomb = 0.000233, stiffness = 0.144, damping = 2.59e5, exponent = 1 }
[simulate]
stop = 1
output = { points = 201 }
record = ["oil.force", "grip.force"]
)"},
    {"a slider holds so little that both ends of the dashpot move alike to nine digits", R"([elements]
pull = { type = "motion", at = "end", velocity = { step = 558, time = 0.1 } }
oil = { type = "dashpot", between = ["end", "mid"], damping = 2.2e3 }
grip = { type = "slider", between = ["mid", "ground"], coulomb = 1.44e-6 }
[simulate]
stop = 1
output = { points = 401 }
record = ["oil.force", "grip.force"]
)"},
};

}  // namespace

TEST_CASE("two elements in series have one force, certified or not") {
  for (const auto& [what, toml] : pairs) {
    CAPTURE(what);
    for (const double accuracy : accuracies) {
      CAPTURE(accuracy);
      const Scene scene = scene_of(toml, accuracy);
      Rows plain, certified;
      run(scene, {.row = std::ref(plain)});
      const bool holds = certify(scene, {.row = std::ref(certified)}).holds;
      CHECK(holds);
      for (const auto& [rows, share] : {std::pair{&plain, plain_share}, std::pair{&certified, 1.0}}) {
        double scale = 0, apart = 0;
        for (const std::vector<double>& row : rows->values) {
          scale = std::max(scale, std::abs(row[1]));
          apart = std::max(apart, std::abs(row[0] - row[1]));
        }
        CHECK(scale > 0);
        CHECK(apart <= share * accuracy * scale);
      }
    }
  }
}

// The error of a deflection that the accuracy allows is a velocity of 100 m/s by the balance of a weak dashpot. Friction beside it
// was held at rest by forces far above its bound.
TEST_CASE("friction beside a weak dashpot is not held above its bound") {
  Tally tally;
  judge(random_chain(476), tally);
}

TEST_CASE("random chains in series have one force, that of the closed form where there is one") {
  // Which: see README.md.
  int first = 3, last = 14;
  if (const char* wanted = std::getenv("RHEONET_CHAINS")) REQUIRE(std::sscanf(wanted, "%d-%d", &first, &last) == 2);
  judge_all(first, last - first + 1);
}

// In the first four chains a slider sticks for 1e-12 s to 1e-8 s from the start. In the next six the slopes that decide which element
// begins to move differ by more than 16 decades; so they do at a reversal in 221 and 400.
TEST_CASE("chains of which friction is about to slip have an answer") {
  Tally tally;
  for (const int number : {209, 374, 382, 556, 428, 591, 652, 683, 690, 695, 221}) judge(random_chain(number), tally);
  CHECK(tally.refused + tally.not_certified + tally.slow == 0);
  judge(random_chain(400), tally);
  CHECK(tally.refused + tally.slow == 0);
}

// Dashpots between a mass or a motion and a massless node that moves almost alike; then friction that has slid far and turns.
TEST_CASE("forces of chains keep their digits where velocities are almost equal, or deflections large") {
  Tally tally;
  for (const int number : {255, 507, 538, 622, 676, 760, 76, 515, 615, 98}) judge(random_chain(number), tally);
  CHECK(tally.refused + tally.not_certified + tally.slow == 0);
}

// Each chain failed by a mechanism of its own:
//   290, 338, 541  the force of a dashpot between a fast motion and a node that springs and friction hold was the difference of two velocities;
//   363            in closed form the deflection of a stiff spring was the difference of those of two soft ones;
//   367            the terms of a dashpot that a sticking slider bridges counted in the round-off of a balance that they are not in;
//   430            a pseudoplastic dashpot beside a law that is held at rest had slope 0 to all digits;
//   531            round-off of the mode selection hid the motion of a law, and the guard of its start was re-armed although violated;
//   707            a soft spring far along the chain held a node less than the regularising slope of the slider there;
//   992            friction that yields was pulled back from its bound by an error of the steps, and yielded again, without end.
TEST_CASE("chains that failed have forces in balance") {
  Tally tally;
  for (const int number : {290, 338, 363, 367, 430, 531, 541, 707, 992}) judge(random_chain(number), tally);
  CHECK(tally.refused + tally.slow == 0);
}

// At the tightest tolerance round-off keeps the third run at order 1, in steps of 1e-10 s from 0.10806 s on.
TEST_CASE("a certificate gives up runs that take a hundred times the steps of another") {
  std::string toml = random_chain(129).toml;
  const std::string whole = "stop = 1\n";
  REQUIRE(toml.find(whole) != std::string::npos);
  toml.replace(toml.find(whole), whole.size(), "stop = 0.1085\n");
  const Certificate certificate = certify(scene_of(toml, 1e-9), {});
  CHECK_FALSE(certificate.holds);
  CHECK(certificate.obstacle.find("was given up after") != std::string::npos);
}

// At 1e-12 and order 4, e1 reverses every 1e-15 s from 0.3217 s on: its velocity is that of a dilatant dashpot beside it, of forces that are round-off.
TEST_CASE("events that come within the round-off of time, over and over, end the run") {
  std::string toml = random_chain(860).toml;
  const std::string whole = "stop = 1\n";
  REQUIRE(toml.find(whole) != std::string::npos);
  toml.replace(toml.find(whole), whole.size(), "stop = 0.35\n");
  CHECK_THROWS_WITH_AS(run(scene_of(toml, 1e-12), {.order = 4}), doctest::Contains("`e1` switches over and over"), SimulationError);
}

}  // namespace rheonet::test::series_test
