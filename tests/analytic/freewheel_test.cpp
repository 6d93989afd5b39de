// Freewheels: the first node runs ahead of the second freely, and never falls behind it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"
#include "tests/support/random.hpp"

namespace rheonet::test::freewheel_test {

namespace {

constexpr double pi = std::numbers::pi;

/// Where a function that is positive at `low` and negative at `high` becomes 0.
double zero(const Exact& function, double low, double high) {
  REQUIRE_GT(function(low), 0);
  REQUIRE_LT(function(high), 0);
  for (int k = 0; k < 200 && low < high; ++k) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (function(middle) > 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

// J w' = -c w once the drive slows down faster than the drag does: wd' = -c/J wd. With wd = w0 + A sin(Wt) that is where
// A (W cos Wt + c/J sin Wt) = -c/J w0.
TEST_CASE("freewheel: a rotor overruns its drive, and is caught up") {
  const double J = 0.213, c = 0.137, w0 = 3.1, A = 2.3, W = 2 * pi * 0.41, stop = 6.3, decay = c / J, period = 2 * pi / W;
  const auto drive = [=](double t) { return w0 + A * std::sin(W * t); };
  const double amplitude = A * std::hypot(W, decay), lag = std::atan2(decay, W);
  const double first = (lag + std::acos(-decay * w0 / amplitude)) / W;
  const double caught = zero([=](double t) { return drive(first) * std::exp(-decay * (t - first)) - drive(t); }, first + 0.3 * period, first + 1.1 * period);
  std::vector<double> slips, sticks;
  for (double from = 0; first + from < stop; from += period) {
    slips.push_back(first + from);
    if (caught + from < stop) sticks.push_back(caught + from);
  }
  REQUIRE_GE(sticks.size(), 2);
  const auto overrun = [=](double t) {
    double u = std::fmod(t, period);
    if (u < first && t > period && u + period < caught) u += period;
    return u >= first && u < caught ? u - first : -1.0;
  };
  const auto rotor = [=](double t) { return overrun(t) < 0 ? drive(t) : drive(first) * std::exp(-decay * overrun(t)); };
  const auto force = [=](double t) { return overrun(t) < 0 ? -(J * A * W * std::cos(W * t) + c * drive(t)) : 0; };
  for (const double s : {1.0, -1.0}) {
    // The mirror image has the nodes the other way round.
    const std::string toml = fmt::format(R"(
domain = "rotation"
[elements]
drive = {{ type = "motion", at = "d", velocity = {{ sine = {:.17g}, frequency = 0.41, offset = {:.17g} }} }}
wheel = {{ type = "inertia", at = "w", inertia = {:.17g} }}
drag  = {{ type = "dashpot", between = ["w", "ground"], damping = {:.17g} }}
free  = {{ type = "freewheel", between = [{}] }}
[nodes]
w = {{ velocity = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 421 }}
)",
                                         s * A, s * w0, J, c, s > 0 ? "\"w\", \"d\"" : "\"d\", \"w\"", s * w0, stop);
    check_at_all_accuracies(toml, {{"w.velocity", [&](double t) { return s * rotor(t); }}});
    // The force of the mirror image is that at the other end: the same sign.
    check_between(toml, {{"free.force", force}, {"drive.force", [&](double t) { return -s * force(t); }}}, sticks);
    std::string with_events = toml;
    with_events.replace(with_events.find("points = 421"), 12, "points = 2, events = true");
    std::vector<double> all = slips;
    all.insert(all.end(), sticks.begin(), sticks.end());
    check_events(with_events, all);
  }
}

// The node goes as far as the spring has ever pulled it, and no way back.
TEST_CASE("freewheel: a spring that pulls a held node") {
  const double k = 143, load = 57, stop = 2.3;
  const std::vector<std::pair<double, double>> hand = {{0, 0}, {0.31, 0.083}, {0.57, -0.061}, {0.83, 0.037}, {1.17, 0.127}, {1.6, 0.013}, {stop, 0.171}};
  const auto hand_at = [&](double t) {
    std::size_t j = 0;
    while (j + 2 < hand.size() && hand[j + 1].first <= t) ++j;
    return hand[j].second + (hand[j + 1].second - hand[j].second) * (t - hand[j].first) / (hand[j + 1].first - hand[j].first);
  };
  const auto farthest = [&](double t) {
    double most = std::max(0.0, hand_at(t));
    for (const auto& [s, x] : hand) {
      if (s <= t) most = std::max(most, x);
    }
    return k / (k + load) * most;
  };
  std::string points;
  for (const auto& [t, x] : hand) points += fmt::format("[{:.17g}, {:.17g}], ", t, x);
  const std::string toml = fmt::format(R"(
[elements]
hand = {{ type = "motion", at = "h", position = {{ table = [{}] }} }}
k1   = {{ type = "spring", between = ["h", "n"], stiffness = {:.17g} }}
k2   = {{ type = "spring", between = ["n", "ground"], stiffness = {:.17g} }}
free = {{ type = "freewheel", between = ["n", "ground"] }}
[simulate]
stop = {:.17g}
output = {{ points = 231 }}
)",
                                       points, k, load, stop);
  check_at_all_accuracies(toml, {{"n.position", farthest},
                                 {"k1.force", [&](double t) { return k * (hand_at(t) - farthest(t)); }},
                                 {"free.force", [&](double t) { return std::min(0.0, k * (hand_at(t) - farthest(t)) - load * farthest(t)); }}});
  for (const double accuracy : accuracies) {
    const Summary summary = outcome(toml, accuracy).summary;
    CHECK_LE(std::abs(summary.dissipated), 10 * accuracy * summary.largest);  // it only holds
    CHECK_LE(std::abs(summary.missing), 10 * accuracy * summary.largest);
  }
}

// A jack: each stroke of the hand first takes up the load, then lifts it; on the way back one freewheel holds the load, the other
// lets the pawl go back.
TEST_CASE("freewheel: a ratchet of two freewheels and a spring, without mass") {
  const double k = 143, load = 37, tick = 0.31;
  const std::vector<double> turns = {0.083, -0.011, 0.097, 0.041, 0.113, -0.037, 0.031, -0.021, 0.107};
  struct State { double force = 0, pawl = 0, lifted = 0; };
  const auto moved = [=](State s, double hand) {
    if (hand > 0) {
      const double taken = std::clamp((load * s.lifted - s.force) / k, 0.0, hand), rest = hand - taken;
      s.force += k * taken;
      s.lifted += k / (k + load) * rest;
      s.pawl += k / (k + load) * rest;
      if (rest > 0) s.force = load * s.lifted;
    } else {
      const double released = std::min(s.force / k, -hand);
      s.force -= k * released;
      s.pawl -= -hand - released;
    }
    return s;
  };
  const auto state = [=](double t) {
    State s;
    double hand = 0;
    for (std::size_t j = 0; j < turns.size(); ++j) {
      const double share = std::clamp(t / tick - double(j), 0.0, 1.0);
      s = moved(s, share * (turns[j] - hand));
      hand = turns[j];
    }
    return s;
  };
  std::string points = "[0, 0], ";
  for (std::size_t j = 0; j < turns.size(); ++j) points += fmt::format("[{:.17g}, {:.17g}], ", double(j + 1) * tick, turns[j]);
  const std::string toml = fmt::format(R"(
[elements]
hand = {{ type = "motion", at = "h", position = {{ table = [{}] }} }}
k1   = {{ type = "spring", between = ["h", "pawl"], stiffness = {:.17g} }}
lift = {{ type = "freewheel", between = ["top", "pawl"] }}
hold = {{ type = "freewheel", between = ["top", "ground"] }}
k2   = {{ type = "spring", between = ["top", "ground"], stiffness = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 271 }}
)",
                                       points, k, load, double(turns.size()) * tick);
  CHECK_GT(state(9 * tick).lifted, 0.2);  // farther than the hand ever goes
  check_at_all_accuracies(toml, {{"top.position", [&](double t) { return state(t).lifted; }},
                                 {"pawl.position", [&](double t) { return state(t).pawl; }},
                                 {"k1.force", [&](double t) { return state(t).force; }},
                                 {"lift.force", [&](double t) { return -state(t).force; }},
                                 {"hold.force", [&](double t) { return state(t).force - load * state(t).lifted; }}});
}

namespace {

/// Masses in a row, and freewheels between neighbours: `way` 1 keeps the next one from falling behind, -1 from running ahead, 0 for
/// none. The same for each mass and ground in `to_ground`.
struct Row {
  std::vector<double> mass, velocity;
  std::vector<int> way, to_ground;
};

std::string toml_of(const Row& row) {
  std::string elements, nodes;
  const auto free = [&](std::size_t k, const std::string& a, const std::string& b, int way) {
    if (way == 0) return;
    elements += fmt::format("f{} = {{ type = \"freewheel\", between = [\"{}\", \"{}\"] }}\n", k, way > 0 ? a : b, way > 0 ? b : a);
  };
  for (std::size_t k = 0; k < row.mass.size(); ++k) {
    elements += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = {1:.17g} }}\n", k, row.mass[k]);
    nodes += fmt::format("n{} = {{ velocity = {:.17g} }}\n", k, row.velocity[k]);
    if (k + 1 < row.mass.size()) free(k, fmt::format("n{}", k + 1), fmt::format("n{}", k), row.way[k]);
    free(k + 10, fmt::format("n{}", k), "ground", row.to_ground[k]);
  }
  return "[elements]\n" + elements + "[nodes]\n" + nodes + "[simulate]\nstop = 0.7\noutput = { points = 8 }\n";
}

/// Velocities after the impact: those of least energy relative to the ones before among all that are permitted. Each set of freewheels
/// that hold makes groups of masses; the best permitted one of all sets is the answer.
std::vector<double> after_impact(const Row& row) {
  const std::size_t n = row.mass.size();
  struct Link { std::size_t a, b; int way; };  // way (v[a] - v[b]) >= 0; n is ground
  std::vector<Link> links;
  for (std::size_t k = 0; k < n; ++k) {
    if (k + 1 < n && row.way[k] != 0) links.push_back({k + 1, k, row.way[k]});
    if (row.to_ground[k] != 0) links.push_back({k, n, row.to_ground[k]});
  }
  std::vector<double> best;
  double least = HUGE_VAL;
  for (std::size_t set = 0; set < std::size_t{1} << links.size(); ++set) {
    std::vector<std::size_t> group(n + 1);
    for (std::size_t k = 0; k <= n; ++k) group[k] = k;
    for (std::size_t l = 0; l < links.size(); ++l) {
      if (set >> l & 1) std::replace(group.begin(), group.end(), std::size_t(group[links[l].a]), std::size_t(group[links[l].b]));
    }
    std::vector<double> mass(n + 1, 0), momentum(n + 1, 0), v(n + 1, 0);
    for (std::size_t k = 0; k < n; ++k) mass[group[k]] += row.mass[k], momentum[group[k]] += row.mass[k] * row.velocity[k];
    for (std::size_t k = 0; k < n; ++k) v[k] = group[k] == group[n] ? 0 : momentum[group[k]] / mass[group[k]];
    const bool permitted = std::all_of(links.begin(), links.end(), [&](const Link& l) { return l.way * (v[l.a] - v[l.b]) >= -1e-12; });
    double energy = 0;
    for (std::size_t k = 0; k < n; ++k) energy += row.mass[k] * std::pow(v[k] - row.velocity[k], 2) / 2;
    if (!permitted || energy >= least) continue;
    least = energy;
    best.assign(v.begin(), v.begin() + std::ptrdiff_t(n));
  }
  return best;
}

void check_impact(const Row& row) {
  const std::string toml = toml_of(row);
  INFO(toml);
  const std::vector<double> after = after_impact(row);
  double before_energy = 0, after_energy = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    before_energy += row.mass[k] * row.velocity[k] * row.velocity[k] / 2;
    after_energy += row.mass[k] * after[k] * after[k] / 2;
  }
  const Outcome found = outcome(toml, 1e-9);
  for (std::size_t k = 0; k < after.size(); ++k) {
    for (const double v : found.rows[fmt::format("n{}.velocity", k)]) CHECK(std::abs(v - after[k]) <= 1e-12);
    CHECK(std::abs(found.rows[fmt::format("n{}.position", k)].back() - 0.7 * after[k]) <= 1e-9);
  }
  const double lost = before_energy - after_energy;
  // The account begins after the impact, which a note tells.
  CHECK(std::abs(found.summary.dissipated) <= 1e-9 * before_energy);
  CHECK(std::abs(found.summary.missing) <= 1e-9 * before_energy);
  const bool collides = lost > 1e-9 * before_energy;
  const auto tells = std::count_if(found.summary.notes.begin(), found.summary.notes.end(),
                                   [](const std::string& note) { return note.find("backwards") != std::string::npos; });
  CHECK_EQ(tells > 0, collides);  // one for each independent part
}

TEST_CASE("freewheel: its power, taken in by a block, is 0 through all stops") {
  const RunTable rows = simulate(R"([elements]
push = { type = "force", at = "a", force = { sine = 4, frequency = 1, phase = 3 } }
m = { type = "mass", at = "a", mass = 2 }
free = { type = "freewheel", between = ["a", "ground"] }
heat = { type = "integrator", in = "free.power" }
[simulate]
stop = 3
)", 1e-6);
  for (const double heat : rows["heat.out"]) CHECK_EQ(heat, 0);
  CHECK(rows.scale("a.velocity") > 0.1);
  CHECK(rows.scale("free.force") > 0.1);
}

}  // namespace

TEST_CASE("freewheel: masses that start with velocities that it forbids go on together") {
  check_impact({{1.3}, {-0.7}, {}, {1}});
  check_impact({{1.3}, {0.7}, {}, {1}});
  check_impact({{1.3}, {0.7}, {}, {-1}});
  check_impact({{1.3, 2.9}, {1.1, 0.3}, {1}, {0, 0}});
  check_impact({{1.3, 2.9}, {0.3, 1.1}, {1}, {0, 0}});
  check_impact({{1.3, 2.9}, {1.1, -0.3}, {-1}, {0, 0}});
  // The first pair may part again from a third that they run into.
  check_impact({{1.3, 2.9, 0.7}, {1.1, 2.1, 1.7}, {1, 1}, {0, 0, 0}});
  check_impact({{1.3, 0.2, 5.7}, {1.1, 0.9, -3.7}, {1, 1}, {0, 0, 0}});
  check_impact({{1.3, 0.2, 5.7}, {1.1, 0.9, 3.7}, {1, -1}, {0, 0, 0}});
}

TEST_CASE("freewheel: impacts of random rows of masses have the least energy") {
  Random random(20261125);
  for (int trial = 0; trial < 120; ++trial) {
    Row row;
    const int n = 2 + random.below(5);
    for (int k = 0; k < n; ++k) {
      row.mass.push_back(random.around(1, 5));
      row.velocity.push_back(random.uniform(-2, 2));
      if (k + 1 < n) row.way.push_back(random.below(8) == 0 ? 0 : random.below(2) == 0 ? 1 : -1);
      row.to_ground.push_back(random.below(5) > 0 ? 0 : random.below(2) == 0 ? 1 : -1);
    }
    check_impact(row);
  }
}

TEST_CASE("freewheel: two of them back to back are a rigid link") {
  const double m1 = 1.3, m2 = 0.7, A = 3.7, W = 2 * pi * 0.83, stop = 2.9;
  for (const double v0 : {0.0, 0.9}) {
    const std::string toml = fmt::format(R"(
[elements]
m1   = {{ type = "mass", at = "a", mass = {:.17g} }}
m2   = {{ type = "mass", at = "b", mass = {:.17g} }}
push = {{ type = "force", at = "a", force = {{ sine = {:.17g}, frequency = 0.83 }} }}
f1   = {{ type = "freewheel", between = ["a", "b"] }}
f2   = {{ type = "freewheel", between = ["b", "a"] }}
[nodes]
a = {{ velocity = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 231 }}
)",
                                         m1, m2, A, v0, stop);
    const double start = m1 * v0 / (m1 + m2);
    const auto velocity = [=](double t) { return start + A / W / (m1 + m2) * (1 - std::cos(W * t)); };
    const auto passed = [=](double t) { return m2 / (m1 + m2) * A * std::sin(W * t); };
    check_at_all_accuracies(toml, {{"a.velocity", velocity},
                                   {"b.velocity", velocity},
                                   {"f1.force", [=](double t) { return std::min(0.0, passed(t)); }},
                                   {"f2.force", [=](double t) { return -std::max(0.0, passed(t)); }}});
    const double stored = (m1 + m2) * (std::pow(velocity(stop), 2) - start * start) / 2;
    check_account(toml, {stored, stored, 0});
  }
}

// An oscillating belt drives a mass in one direction through friction: m v' = Fc while the belt is faster, otherwise v' = 0.
TEST_CASE("freewheel: in series with a slider it drives one way") {
  const double m = 1.7, Fc = 2.3, V = 1.9, half = 1 / (2 * 0.71), stop = 8 * half;
  const auto velocity = [=](double t) {
    const double halves = std::floor(t / half), pushed = std::ceil(halves / 2) * half + (std::fmod(halves, 2) == 0 ? t - halves * half : 0);
    return std::min(V, Fc * pushed / m);
  };
  REQUIRE_EQ(velocity(stop), V);
  const double reaches = m * V / Fc;  // of the time that it is pushed
  REQUIRE_GT(reaches, half);
  const double until = reaches - half + 2 * half;
  REQUIRE_LT(reaches, 2 * half);
  for (const bool slider_first : {true, false}) {
    const std::string toml = fmt::format(R"(
[elements]
belt  = {{ type = "motion", at = "s", velocity = {{ square = {:.17g}, frequency = 0.71 }} }}
grip  = {{ type = "slider", between = ["{}", "{}"], coulomb = {:.17g} }}
free  = {{ type = "freewheel", between = ["{}", "{}"] }}
m1    = {{ type = "mass", at = "a", mass = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 317 }}
)",
                                         V, slider_first ? "s" : "n", slider_first ? "n" : "a", Fc, slider_first ? "a" : "n",
                                         slider_first ? "n" : "s", m, stop);
    check_at_all_accuracies(toml, {{"a.velocity", velocity}});
    std::vector<double> jumps = {until};
    for (int k = 1; k <= 8; ++k) jumps.push_back(k * half);
    const auto force = [=](double t) { return t < until && std::fmod(std::floor(t / half), 2) == 0 ? Fc : 0; };
    check_between(toml, {{"grip.force", force}, {"free.force", [=](double t) { return -force(t); }}}, jumps);
  }
}

// The step of the dashpot's end gives the impulse B d.
TEST_CASE("freewheel: a position step throws a mass back, and the next one with it") {
  const double m1 = 1.3, m2 = 0.7, B = 2.9, at = 0.31, stop = 2.1;
  for (const double d : {0.23, -0.31}) {
    for (const bool grounded : {false, true}) {
      const std::string toml = fmt::format(R"(
[elements]
hand = {{ type = "motion", at = "h", position = {{ step = {:.17g}, time = {:.17g} }} }}
c1   = {{ type = "dashpot", between = ["h", "a"], damping = {:.17g} }}
m1   = {{ type = "mass", at = "a", mass = {:.17g} }}
m2   = {{ type = "mass", at = "b", mass = {:.17g} }}
free = {{ type = "freewheel", between = ["a", "{}"] }}
[simulate]
stop = {:.17g}
output = {{ points = 212 }}
)",
                                           d, at, B, m1, m2, grounded ? "ground" : "b", stop);
      // Then the dashpot slows the first one down, and the second one goes on.
      const double inertia = d > 0 ? m1 : m1 + m2, v0 = d < 0 && grounded ? 0 : B * d / inertia, rate = B / m1;
      const Exact velocity = from(at, [=](double t) { return v0 * std::exp(-rate * t); });
      const double scale = B * std::abs(d) / m1;
      check_between(toml, {{"a.velocity", velocity, scale},
                           {"a.position", from(at, [=](double t) { return -v0 / rate * std::expm1(-rate * t); }), std::abs(d)},
                           {"b.velocity", [=](double t) { return t < at || d > 0 || grounded ? 0 : v0; }, scale}}, {at});
    }
  }
}

TEST_CASE("freewheel: a motion that it forbids is refused when it begins") {
  const auto moved = [](const std::string& velocity, const std::string& ends) {
    return refusal("[elements]\nhand = { type = \"motion\", at = \"h\", velocity = " + velocity +
                   " }\nk1 = { type = \"spring\", between = [\"h\", \"ground\"], stiffness = 5 }\nfree = { type = \"freewheel\", between = [" + ends +
                   "] }\n[simulate]\nstop = 1\n");
  };
  const std::string forwards = "\"h\", \"ground\"", backwards = "\"ground\", \"h\"";
  CHECK_EQ(moved("{ sine = 1.3, frequency = 0.49 }", forwards), "");
  CHECK(moved("{ sine = 1.3, frequency = 0.49 }", backwards).find("at t = 0 s `free` forbids the motion of node") != std::string::npos);
  CHECK(moved("{ sine = 1.3, frequency = 1 }", forwards).find("at t = 0.5 s `free` forbids the motion of node") != std::string::npos);
  CHECK(moved("{ square = 1.3, frequency = 1 }", forwards).find("at t = 0.5 s `free` forbids the motion of node") != std::string::npos);
  CHECK(moved("-0.3", forwards).find("at t = 0 s `free` forbids the motion of node") != std::string::npos);
  CHECK_EQ(moved("-0.3", backwards), "");
}

}  // namespace rheonet::test::freewheel_test
