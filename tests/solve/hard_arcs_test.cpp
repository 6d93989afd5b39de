// Scenes that are hard for a closed form: extreme ratios, long times, events that nearly coincide or nearly happen. Each is compared with the
// motion that the textbook gives, and asks for no more than an accuracy of 1e-6: exact arcs have more digits than that.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::hard_arcs_test {

namespace {

struct Found {
  RunTable rows;
  Summary summary;
  std::map<std::string, std::vector<double>> events;  ///< of each element: times
};

Found found(const std::string& elements, const std::string& nodes, double stop, int points = 101, double energy = 1e-11) {
  const Scene scene = scene_of(fmt::format("[elements]\n{}\n[nodes]\n{}\n[simulate]\nstop = {:.17g}\noutput = {{ points = {} }}\n", elements, nodes, stop, points));
  Found result;
  result.rows = simulate(scene, &result.summary);
  run(scene, {.event = [&](double t, const std::string& name, const char*, int) { result.events[name].push_back(t); }});
  CHECK_EQ(result.summary.arc_steps, result.summary.steps);
  CHECK_LE(std::abs(result.summary.missing), energy * result.summary.largest);
  return result;
}

/// A mass on a spring to ground.
std::string oscillator_with(double m, double k) {
  return fmt::format("m = {{ type = \"mass\", at = \"a\", mass = {:.17g} }}\nk = {{ type = \"spring\", between = [\"a\", \"ground\"], stiffness = {:.17g} }}\n", m, k);
}

using Motion = std::function<double(double)>;

}  // namespace

TEST_CASE("arcs: resonance exactly at the natural frequency, over a thousand cycles") {
  constexpr double m = 0.9, F = 1.7, f = 1.3, omega = 2 * M_PI * f;
  const Found of = found(oscillator_with(m, m * omega * omega) + fmt::format("push = {{ type = \"force\", at = \"a\", force = {{ sine = {}, frequency = {} }} }}", F, f), "", 1000 / f);
  // From rest: x = F/(2 m omega^2) (sin(omega t) - omega t cos(omega t)). The rounding of omega^2 detunes it: by 1e-16 of the frequency.
  CHECK_LE(error_of(of.rows, "a.position", [=](double t) { return F / (2 * m * omega * omega) * (std::sin(omega * t) - omega * t * std::cos(omega * t)); }), 1e-10);
}

TEST_CASE("arcs: beats of two frequencies that are nearly one") {
  constexpr double m = 1.1, omega = 5, F = 2, apart = 1e-7;
  for (const double sign : {1.0, -1.0}) {
    const double drive = omega * (1 + sign * apart);
    const Found of = found(oscillator_with(m, m * omega * omega) + fmt::format("push = {{ type = \"force\", at = \"a\", force = {{ cosine = {}, frequency = {:.17g} }} }}", F, drive / (2 * M_PI)), "", 600);
    // F/m (cos(drive t) - cos(omega t))/(omega^2 - drive^2), without its difference of cosines.
    CHECK_LE(error_of(of.rows, "a.position",
                      [=](double t) {
                        const double sum = (omega + drive) / 2, difference = (omega - drive) / 2;
                        return F / m * std::sin(sum * t) * t * (difference * t == 0 ? 1 : std::sin(difference * t) / (difference * t)) / (2 * sum);
                      }),
             1e-9);
  }
}

TEST_CASE("arcs: a force on a free mass, for a million seconds") {
  constexpr double m = 3, F = 0.7, v0 = -2;
  const Found of = found(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = {} }}\nF = {{ type = \"force\", at = \"a\", force = {} }}", m, F), fmt::format("a = {{ velocity = {} }}", v0), 1e6);
  CHECK_LE(error_of(of.rows, "a.position", [=](double t) { return v0 * t + F * t * t / (2 * m); }), 1e-14);
}

TEST_CASE("arcs: masses and stiffnesses from 1e-12 to 1e12") {
  for (const double m : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
    for (const double k : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
      CAPTURE(m);
      CAPTURE(k);
      const double omega = std::sqrt(k / m), v0 = 0.3;
      const Found of = found(oscillator_with(m, k), fmt::format("a = {{ velocity = {} }}", v0), 20 / omega);
      CHECK_LE(error_of(of.rows, "a.position", [=](double t) { return v0 / omega * std::sin(omega * t); }), 1e-13);
    }
  }
}

TEST_CASE("arcs: a stiff coupling between two masses on a soft spring") {
  // k joins two masses, c holds the first: modes far apart.
  for (const double ratio : {1e3, 1e6, 1e9}) {
    CAPTURE(ratio);
    constexpr double m = 0.6, soft = 2.5, x0 = 0.4;
    const double k = ratio * soft;
    const std::string elements = fmt::format(
        "m1 = {{ type = \"mass\", at = \"a\", mass = {0} }}\nm2 = {{ type = \"mass\", at = \"b\", mass = {0} }}\nc = {{ type = \"spring\", between = [\"a\", \"ground\"], stiffness = {1} }}\n"
        "k = {{ type = \"spring\", between = [\"b\", \"a\"], stiffness = {2:.17g} }}",
        m, soft, k);
    const Found of = found(elements, fmt::format("a = {{ position = {0} }}\nb = {{ position = {0} }}", x0), 3, 31, std::max(1e-11, 1e-19 * ratio));
    // m s^4 + (soft + 2 k) s^2 + k soft/m = 0 for s = i omega: the smaller root without cancellation.
    const double half = (soft + 2 * k) / (2 * m), root = std::sqrt(half * half - k * soft / (m * m)), fast2 = half + root, slow2 = k * soft / (m * m) / fast2;
    // b/a of a mode: k/(k - m omega^2); the start is a sum of both.
    const double slow_share = k / (k - m * slow2), fast_share = k / (k - m * fast2), fast = x0 * (1 - slow_share) / (fast_share - slow_share), slow = x0 - fast;
    // The positions are right to the round-off of the stiff force: the fast mode alone has it.
    CHECK_LE(error_of(of.rows, "a.position", [=](double t) { return slow * std::cos(std::sqrt(slow2) * t) + fast * std::cos(std::sqrt(fast2) * t); }), 1e-15 * ratio + 1e-12);
  }
}

TEST_CASE("arcs: the modes of a chain of five masses") {
  constexpr int n = 5;
  constexpr double m = 0.8, k = 75, x0 = 0.1;
  std::string elements;
  for (int i = 1; i <= n; ++i) {
    elements += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = {1} }}\nk{0} = {{ type = \"spring\", between = [\"n{0}\", \"{2}\"], stiffness = {3} }}\n", i, m,
                            i == 1 ? "ground" : fmt::format("n{}", i - 1), k);
  }
  // One end held, the other free: frequencies 2 sqrt(k/m) sin((2 j - 1) pi/(4 n + 2)), shapes sin((2 j - 1) pi i/(2 n + 1)).
  const auto shape = [](int j, int i) { return std::sin((2 * j - 1) * M_PI * i / (2 * n + 1)); };
  const Found of = found(elements, fmt::format("n{} = {{ position = {} }}", n, x0), 40, 201);
  for (const int at : {1, 3, 5}) {
    CHECK_LE(error_of(of.rows, fmt::format("n{}.position", at),
                      [&](double t) {
                        double sum = 0;
                        for (int j = 1; j <= n; ++j) sum += 4.0 / (2 * n + 1) * shape(j, n) * x0 * shape(j, at) * std::cos(2 * std::sqrt(k / m) * std::sin((2 * j - 1) * M_PI / (4 * n + 2)) * t);
                        return sum;
                      }),
             1e-11);
  }
}

TEST_CASE("arcs: friction lets go after a million seconds, to the last digits of the time") {
  constexpr double rate = 1.3e-6, hold = 1.7;
  const Found of = found(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = 2 }}\nF = {{ type = \"force\", at = \"a\", force = {{ ramp = {} }} }}\n"
                                     "f = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = 1.1, breakaway = {} }}", rate, hold),
                         "", 1.4e6);
  REQUIRE_EQ(of.events.at("f").size(), 1);
  CHECK_EQ(of.events.at("f")[0], doctest::Approx(hold / rate).epsilon(1e-10));
}

TEST_CASE("arcs: two events 1e-12 s apart are two events, in their order") {
  constexpr double rate = 2;
  const std::string block = "m{0} = {{ type = \"mass\", at = \"n{0}\", mass = 1 }}\nF{0} = {{ type = \"force\", at = \"n{0}\", force = {{ ramp = {1} }} }}\n"
                            "f{0} = {{ type = \"slider\", between = [\"n{0}\", \"ground\"], coulomb = {2:.17g} }}\n";
  // A soft spring makes them one part of the network.
  const Found of = found(fmt::format(fmt::runtime(block), 1, rate, 1.0) + fmt::format(fmt::runtime(block), 2, rate, 1.0 + 2e-12) +
                             "k = { type = \"spring\", between = [\"n1\", \"n2\"], stiffness = 1e-3 }",
                         "", 1);
  REQUIRE_EQ(of.events.at("f1").size(), 1);
  REQUIRE_EQ(of.events.at("f2").size(), 1);
  CHECK_EQ(of.events.at("f1")[0], doctest::Approx(0.5).epsilon(1e-9));
  CHECK_GE(of.events.at("f2")[0], of.events.at("f1")[0]);
  CHECK_LE(of.events.at("f2")[0] - of.events.at("f1")[0], 1e-9);
  const double rest = 0.5;  // m x'' = rate (t - 1/2) from there on, the spring aside
  CHECK_EQ(of.rows["n1.position"].back(), doctest::Approx(rate * std::pow(1 - rest, 3) / 6).epsilon(1e-6));
}

TEST_CASE("arcs: a mass that just reaches a stop, just not, and just more") {
  constexpr double m = 1, omega = 3, x0 = 0.2, K = 1e5;
  for (const double gap : {1 - 1e-7, 1 + 1e-7}) {
    CAPTURE(gap);
    const Found of = found(oscillator_with(m, m * omega * omega) + fmt::format("stop = {{ type = \"stop\", between = [\"a\", \"ground\"], lower = {:.17g}, stiffness = {} }}", -gap * x0, K),
                           fmt::format("a = {{ position = {} }}", x0), 10);
    CHECK_EQ(of.events.count("stop") > 0, gap < 1);
    // A touch of depth 2e-8 m at almost no speed turns the mass a little early: by the angle between both crossings of the bound, less the short time in contact.
    CHECK_LE(error_of(of.rows, "a.position", [=](double t) { return x0 * std::cos(omega * t); }), gap < 1 ? 5e-3 : 1e-13);
    CHECK_EQ(of.rows.scale("a.position"), doctest::Approx(x0).epsilon(1e-12));
  }
}

TEST_CASE("arcs: a load just below and just above what friction holds") {
  for (const double share : {1 - 1e-9, 1 + 1e-9}) {
    CAPTURE(share);
    const Found of = found(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = 1 }}\nF = {{ type = \"force\", at = \"a\", force = {{ sine = {:.17g}, frequency = 0.7 }} }}\n"
                                       "f = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = 1 }}", share),
                           "", 5);
    CHECK_EQ(of.events.count("f") > 0, share > 1);
    CHECK_LE(of.rows.scale("a.position"), 1e-9);
  }
}

TEST_CASE("arcs: dry friction takes the same off every half swing, until the mass stays") {
  constexpr double m = 1.3, k = 52, Fc = 0.9, x0 = 0.5;
  const double omega = std::sqrt(k / m), D = Fc / k;
  const int halves = static_cast<int>(std::ceil((x0 / D - 1) / 2));
  const Found of = found(oscillator_with(m, k) + fmt::format("f = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = {} }}", Fc), fmt::format("a = {{ position = {} }}", x0), (halves + 2) * M_PI / omega);
  const std::vector<double>& turns = of.events.at("f");
  REQUIRE_EQ(static_cast<int>(turns.size()), halves);
  for (int i = 0; i < halves; ++i) CHECK_EQ(turns[static_cast<std::size_t>(i)], doctest::Approx((i + 1) * M_PI / omega).epsilon(1e-12));
  CHECK_EQ(of.rows["a.position"].back(), doctest::Approx((halves % 2 == 0 ? 1 : -1) * (x0 - 2 * halves * D)).epsilon(1e-11));
  CHECK_EQ(of.rows["a.velocity"].back(), 0);
}

TEST_CASE("arcs: a hundred thousand seconds of stick-slip keep their period") {
  // Pulled at v through k: it sticks until the spring has gained 2 (Fs - Fc), and slips in between.
  constexpr double m = 1, k = 10, v = 0.1, Fc = 1, Fs = 1.5;
  const Found of = found(fmt::format("drive = {{ type = \"motion\", at = \"p\", velocity = {} }}\nk = {{ type = \"spring\", between = [\"p\", \"b\"], stiffness = {} }}\nm = {{ type = \"mass\", at = \"b\", mass = {} }}\n"
                                     "f = {{ type = \"slider\", between = [\"b\", \"ground\"], coulomb = {}, breakaway = {} }}", v, k, m, Fc, Fs),
                         "", 2e4);
  const double omega = std::sqrt(k / m), D = (Fs - Fc) / k;
  // In the frame of the drive the block starts at D ahead of its equilibrium with velocity v, and slips until it moves with -v there.
  const double slip = 2 * (M_PI - std::atan(omega * D / v)) / omega, period = slip + 2 * D / v;
  const std::vector<double>& times = of.events.at("f");
  for (const std::size_t n : {0UL, 10UL, 1000UL, 8000UL}) {
    REQUIRE_LT(2 * n, times.size());
    CHECK_EQ(times[2 * n], doctest::Approx(Fs / k / v + static_cast<double>(n) * period).epsilon(1e-11));
  }
}

TEST_CASE("arcs: a ball comes to rest after infinitely many bounces") {
  constexpr double g = 9.81, h = 0.4;
  for (const double e : {0.1, 0.6, 0.9}) {
    CAPTURE(e);
    const double t0 = std::sqrt(2 * h / g), rest = t0 * (1 + e) / (1 - e);
    const Found of = found(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = 0.2 }}\nw = {{ type = \"force\", at = \"a\", force = {:.17g} }}\n"
                                       "floor = {{ type = \"stop\", between = [\"a\", \"ground\"], lower = 0, stiffness = \"inf\", restitution = {} }}", -0.2 * g, e),
                           fmt::format("a = {{ position = {} }}", h), 1.5 * rest);
    const std::vector<double>& times = of.events.at("floor");
    double expected = t0;
    for (std::size_t n = 0; n < std::min<std::size_t>(times.size(), 8); ++n, expected += 2 * t0 * std::pow(e, static_cast<double>(n))) CHECK_EQ(times[n], doctest::Approx(expected).epsilon(1e-11));
    CHECK_LE(std::abs(times.back() - rest), 1e-6 * 1.5 * rest);
    CHECK_EQ(of.rows["a.position"].back(), 0);
    CHECK_EQ(of.rows["a.velocity"].back(), 0);
  }
}

TEST_CASE("arcs: forces that nearly cancel, beside a decay within a millionth of a second, take no short steps") {
  // At first the position of the motion, (1 - cos(w t))/w, is a small difference, and the force of the blocks with it.
  const Found of = found(R"(drive = { type = "motion", at = "a", velocity = { sine = 1, frequency = 1 } }
k = { type = "spring", between = ["b", "ground"], stiffness = 1000 }
c = { type = "dashpot", between = ["b", "ground"], damping = 1e-3 }
push = { type = "force", at = "b", force = { block = "g" } }
g = { type = "gain", in = "a.position", gain = "3 N/m" })", "", 0.5, 51, 1e-10);
  constexpr double w = 2 * M_PI, k = 1000, c = 1e-3, gain = 3;
  // k x + c x' = (gain/w) (1 - cos(w t))
  const auto x = [=](double t) {
    const double size = k * k + c * c * w * w, end = gain / w / k, cosine = gain / w * k / size, sine = gain / w * c * w / size;
    return end - cosine * std::cos(w * t) - sine * std::sin(w * t) - (end - cosine) * std::exp(-k / c * t);
  };
  CHECK_LE(error_of(of.rows, "b.position", x), 1e-12);
  CHECK_LE(of.summary.steps, 1000);
}

TEST_CASE("arcs: nodes without masses in a loop of springs and dashpots") {
  // A bridge: between a driven node and ground stand k1 + c1 in series and c2 + k2 in series; a spring joins their middles.
  const std::string elements = R"(drive = { type = "motion", at = "top", position = { step = 0.1, time = 0.2 } }
k1 = { type = "spring", between = ["top", "left"], stiffness = 30 }
c1 = { type = "dashpot", between = ["left", "ground"], damping = 4 }
c2 = { type = "dashpot", between = ["top", "right"], damping = 4 }
k2 = { type = "spring", between = ["right", "ground"], stiffness = 30 }
k3 = { type = "spring", between = ["left", "right"], stiffness = 50 })";
  const Found of = found(elements, "", 2, 41);
  // After the step, s = left + right - top decays at k/c, because k3 takes no part. The difference d = left - right
  // decays at (k + 2 k3)/c from its value just after the step. By symmetry left + right = top always; just after the step left = 0 and right = top.
  constexpr double k = 30, c = 4, k3 = 50, X = 0.1;
  const double rate = (k + 2 * k3) / c, end = k * X / (k + 2 * k3);
  const auto apart = [=](double t) { return t < 0.2 ? 0 : end + (-X - end) * std::exp(-rate * (t - 0.2)); };
  CHECK_LE(error_of(of.rows, "left.position", [=](double t) { return t < 0.2 ? 0 : (X + apart(t)) / 2; }), 1e-12);
  CHECK_LE(error_of(of.rows, "right.position", [=](double t) { return t < 0.2 ? 0 : (X - apart(t)) / 2; }), 1e-12);
}

TEST_CASE("arcs: a sampled controller, as its difference equation has it") {
  constexpr double m = 0.8, T = 0.013, kp = 9, kd = 3, x0 = 0.3;
  const Found of = found(fmt::format(R"(m = {{ type = "mass", at = "a", mass = {} }}
x = {{ type = "sample", in = "a.position", period = {} }}
v = {{ type = "sample", in = "a.velocity", period = {} }}
p = {{ type = "gain", in = "x.out", gain = {} }}
d = {{ type = "gain", in = "v.out", gain = {} }}
u = {{ type = "sum", in = ["p.out", "d.out"] }}
push = {{ type = "force", at = "a", force = {{ block = "u" }} }})", m, T, T, -kp, -kd),
                         fmt::format("a = {{ position = {} }}", x0), 1000 * T, 1001);
  double x = x0, v = 0;
  for (std::size_t k = 0; k + 1 < of.rows.time().size(); ++k) {
    const double u = -kp * x - kd * v;
    x += v * T + u / m * T * T / 2;
    v += u / m * T;
    REQUIRE_LE(std::abs(of.rows["a.position"][k + 1] - x), 1e-12 * x0);
  }
}

TEST_CASE("arcs: a square force on a spring and a dashpot side by side") {
  constexpr double k = 12, c = 1.5, F = 0.6, f = 2;
  const Found of = found(fmt::format("k = {{ type = \"spring\", between = [\"a\", \"ground\"], stiffness = {} }}\nc = {{ type = \"dashpot\", between = [\"a\", \"ground\"], damping = {} }}\n"
                                     "F = {{ type = \"force\", at = \"a\", force = {{ square = {}, frequency = {} }} }}", k, c, F, f),
                         "", 3, 61);
  const auto exact = [=](double t) {
    double x = 0, begin = 0, sign = 1;
    while (t > begin) {
      const double length = std::min(t - begin, 0.5 / f);
      x = sign * F / k + (x - sign * F / k) * std::exp(-k / c * length);
      begin += 0.5 / f;
      sign = -sign;
    }
    return x;
  };
  CHECK_LE(error_of(of.rows, "a.position", exact), 1e-12);
}

TEST_CASE("arcs: a swing a million metres from the origin keeps the digits that its position has") {
  constexpr double far = 1e6, x0 = 0.01, omega = 7;
  const std::string elements = fmt::format("drive = {{ type = \"motion\", at = \"p\", position = {} }}\nm = {{ type = \"mass\", at = \"a\", mass = 1 }}\nk = {{ type = \"spring\", between = [\"a\", \"p\"], stiffness = {} }}", far, omega * omega);
  const Found of = found(elements, fmt::format("a = {{ position = {:.17g} }}", far + x0), 30);
  CHECK_LE(error_of(of.rows, "k.displacement", [=](double t) { return (far + x0 - far) * std::cos(omega * t); }), 1e-12);
  CHECK_LE(error_of(of.rows, "a.position", [=](double t) { return far + x0 * std::cos(omega * t); }), 3e-16);
}

TEST_CASE("arcs: pairs of springs and sliders in a bundle, behind a mass") {
  // Three Jenkins elements beside each other: a bundle is one law with three kinks. Wired apart, they are three springs and three sliders.
  std::string elements = "m = { type = \"mass\", at = \"a\", mass = 0.7 }\ndrive = { type = \"force\", at = \"a\", force = { sine = 5, frequency = 0.9 } }\nk = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 20 }\n";
  for (int i = 1; i <= 3; ++i)
    elements += fmt::format("s{0} = {{ type = \"spring\", between = [\"a\", \"n{0}\"], stiffness = {1} }}\nf{0} = {{ type = \"slider\", between = [\"n{0}\", \"ground\"], coulomb = {2} }}\n", i, 40.0 * i, 0.6 * i * i);
  const std::string text = fmt::format("[elements]\n{}[simulate]\nstop = 5\noutput = {{ points = 201 }}\nrecord = [\"a.position\", \"a.velocity\", \"s1.force\", \"s3.force\"]\n", elements);
  Scene bundled = scene_of(text), apart = scene_of(text);
  apart.keep = {"bundles"};
  Summary of_bundle, of_parts;
  const RunTable a = simulate(bundled, &of_bundle), b = simulate(apart, &of_parts);
  CHECK_EQ(of_bundle.arc_steps, of_bundle.steps);
  CHECK_EQ(of_parts.arc_steps, of_parts.steps);
  CHECK_LE(largest_error(a, b), 1e-10);
}

TEST_CASE("arcs: sines so slow that they are hardly more than straight lines") {
  // Sines of 1e-6 to 0.1 Hz push a damped oscillator from rest, and let it follow. Each has its closed form.
  constexpr double m = 1, k = 100, c = 2, F = 1.4;
  const double decay = c / (2 * m), own = std::sqrt(k / m - decay * decay);
  for (const double f : {1e-6, 1e-4, 1e-3, 1e-2, 0.02, 0.03, 0.1}) {
    CAPTURE(f);
    const double w = 2 * M_PI * f, spring = k - m * w * w, square = spring * spring + c * c * w * w;
    const double S = F * spring / square, C = -F * c * w / square;  // S sin(w t) + C cos(w t) at the end
    const Found of = found(oscillator_with(m, k) + fmt::format("c = {{ type = \"dashpot\", between = [\"a\", \"ground\"], damping = {} }}\nF = {{ type = \"force\", at = \"a\", force = {{ sine = {}, frequency = {:.17g} }} }}", c, F, f), "", 3);
    CHECK_LE(error_of(of.rows, "a.position",
                      [=](double t) { return S * std::sin(w * t) + C * std::cos(w * t) - std::exp(-decay * t) * (C * std::cos(own * t) + (decay * C + w * S) / own * std::sin(own * t)); }),
             f < 1e-5 ? 3e-11 : 3e-12);
  }
}

TEST_CASE("arcs: an elastic ball that friction slows comes to rest, after infinitely many bounces") {
  // It falls at (F - Fc)/m, and rises at (F + Fc)/m: each bounce keeps r = (F - Fc)/(F + Fc) of the height.
  constexpr double m = 1.1, F = 2.2, Fc = 1, h = 0.9;
  const double down = (F - Fc) / m, up = (F + Fc) / m, r = down / up, fall = std::sqrt(2 * h / down);
  // After a fall from height H it rises for sqrt(2 r H/up) and falls for sqrt(2 r H/down).
  const double rest = fall + fall * (std::sqrt(r) * std::sqrt(down / up) + std::sqrt(r)) / (1 - std::sqrt(r));
  const Found of = found(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = {} }}\nw = {{ type = \"force\", at = \"a\", force = {} }}\n"
                                     "floor = {{ type = \"stop\", between = [\"a\", \"ground\"], lower = 0, stiffness = \"inf\", restitution = 1 }}\n"
                                     "f = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = {} }}", m, -F, Fc),
                         fmt::format("a = {{ position = {} }}", h), 2 * rest);
  CHECK_LE(std::abs(of.events.at("floor").back() - rest), 1e-6 * 2 * rest);
  CHECK_EQ(of.rows["a.velocity"].back(), 0);
  CHECK_EQ(of.rows["f.force"].back(), -Fc);  // the floor carries the rest
}

}  // namespace rheonet::test::hard_arcs_test
