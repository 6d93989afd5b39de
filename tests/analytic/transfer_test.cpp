// Transfer functions against closed forms: step responses of first and second order, with zeros, and frequency responses.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "tests/support/check.hpp"

namespace rheonet::test::transfer_test {

namespace {

/// y is the answer of a transfer function to a step of `height` at 0.2 s.
std::string transfer_of_step(const std::string& numerator, const std::string& denominator, const std::string& height = "1") {
  return netlist({}, fmt::format("[elements]\nrest = {{ type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1 }}\n"
                                 "push = {{ type = \"force\", at = \"a\", force = {{ block = \"y\" }} }}\n"
                                 "u = {{ type = \"generator\", signal = {{ step = \"{}\", time = 0.2 }} }}\n"
                                 "y = {{ type = \"transfer\", in = \"u\", numerator = {}, denominator = {} }}\n", height, numerator, denominator), 3);
}

}  // namespace

TEST_CASE("transfer functions of first order: a lag, an integrator, a lead with feedthrough, a gain") {
  check_at_all_accuracies(transfer_of_step("[3]", "[\"0.4 s\", 1]"), {{"y.out", from(0.2, [](double t) { return 3 * (1 - std::exp(-t / 0.4)); })}});
  check_at_all_accuracies(transfer_of_step("[3]", "[2, 0]"), {{"y.out", from(0.2, [](double t) { return 1.5 * t; })}});
  check_at_all_accuracies(transfer_of_step("[2, 3]", "[0.4, 1]"),
                          {{"y.out", from(0.2, [](double t) { return 3 + (2 / 0.4 - 3) * std::exp(-t / 0.4); })}});
  check_at_all_accuracies(transfer_of_step("[0, 3]", "[0.4, 1]"), {{"y.out", from(0.2, [](double t) { return 3 * (1 - std::exp(-t / 0.4)); })}});
  check_at_all_accuracies(transfer_of_step("3", "4", "2"), {{"y.out", from(0.2, [](double) { return 1.5; })}});
}

TEST_CASE("transfer functions of second order: underdamped, critical, overdamped, with zeros") {
  constexpr double w = 7.3;
  {
    constexpr double zeta = 0.23;
    const double wd = w * std::sqrt(1 - zeta * zeta);
    const auto step = [=](double t) { return 1 - std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t)); };
    const auto impulse = [=](double t) { return w * w / wd * std::exp(-zeta * w * t) * std::sin(wd * t); };
    const std::string denominator = fmt::format("[1, {}, {}]", 2 * zeta * w, w * w);
    check_at_all_accuracies(transfer_of_step(fmt::format("[{}]", w * w), denominator), {{"y.out", from(0.2, step)}});
    // The zero adds the derivative of the step response.
    check_at_all_accuracies(transfer_of_step(fmt::format("[{}, {}]", 0.3 * w * w, w * w), denominator),
                            {{"y.out", from(0.2, [=](double t) { return step(t) + 0.3 * impulse(t); })}});
    // s^2/(s^2 + 2 zeta w s + w^2): the rest of the denominator is taken from 1.
    check_at_all_accuracies(transfer_of_step("[1, 0, 0]", denominator),
                            {{"y.out", from(0.2, [=](double t) { return 1 - step(t) - 2 * zeta / w * impulse(t); })}});
  }
  check_at_all_accuracies(transfer_of_step(fmt::format("[{}]", w * w), fmt::format("[1, {}, {}]", 2 * w, w * w)),
                          {{"y.out", from(0.2, [=](double t) { return 1 - (1 + w * t) * std::exp(-w * t); })}});
  constexpr double a = 1.9, b = 11.7;
  check_at_all_accuracies(transfer_of_step(fmt::format("[{}]", 2 * a * b), fmt::format("[2, {}, {}]", 2 * (a + b), 2 * a * b)),
                          {{"y.out", from(0.2, [=](double t) { return 1 - (b * std::exp(-a * t) - a * std::exp(-b * t)) / (b - a); })}});
}

TEST_CASE("the frequency response of a transfer function of fourth order") {
  // Two resonances; numerator (s^2 + 5 s + 60)(s + 3).
  const auto response = [](std::complex<double> s) {
    return (s * s + 5.0 * s + 60.0) * (s + 3.0) / ((s * s + 2.0 * s + 20.0) * (s * s + 6.0 * s + 90.0));
  };
  for (const double frequency : {0.11, 0.9, 4.0}) {
    const std::string text = fmt::format(
        "[elements]\nm = {{ type = \"mass\", at = \"a\", mass = 1 }}\nu = {{ type = \"generator\", signal = {{ sine = 2, frequency = {} }} }}\n"
        "y = {{ type = \"transfer\", in = \"u\", numerator = [1, 8, 75, 180], denominator = [1, 8, 122, 300, 1800] }}\n"
        "[simulate]\nstart = 0\nstop = 40\naccuracy = 1e-7\noutput = {{ points = 4001 }}\nrecord = [\"y.out\"]\n", frequency);
    const RunTable run = simulate(text);
    const double omega = 2 * std::numbers::pi * frequency;
    const std::complex<double> gain = response({0, omega});
    double worst = 0;
    for (std::size_t k = 0; k < run.time().size(); ++k) {
      const double t = run.time()[k];
      if (t > 25) worst = std::max(worst, std::abs(run["y.out"][k] - 2 * std::abs(gain) * std::sin(omega * t + std::arg(gain))));  // e^-25: at rest
    }
    CAPTURE(frequency);
    CHECK(worst <= 1e-6 * run.scale("y.out"));
  }
}

TEST_CASE("a transfer function closes a loop, moves a node and passes a delay") {
  // A mass under the force of a double lag of its position: m x'' = -K/(T s + 1)^2 x, against the same from two lags.
  const std::string loop =
      "[elements]\nm = { type = \"mass\", at = \"a\", mass = \"1.3 kg\" }\nc = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = \"4 N*s/m\" }\n"
      "y = { type = \"transfer\", in = \"-a.position\", numerator = \"11 N/m\", denominator = [\"0.01 s^2\", \"0.2 s\", 1] }\n"
      "l1 = { type = \"lag\", in = \"-a.position\", time_constant = \"0.1 s\", gain = \"11 N/m\" }\nl2 = { type = \"lag\", in = \"l1\", time_constant = \"0.1 s\" }\n"
      "f = { type = \"force\", at = \"a\", force = { block = \"FED\" } }\n"
      "late = { type = \"delay\", in = \"y\", delay = \"70 ms\" }\nlate2 = { type = \"delay\", in = \"l2\", delay = \"70 ms\" }\n[nodes]\na = { position = \"0.2 m\" }\n"
      "[simulate]\nstop = 2\nrecord = [\"a.position\", \"y.out\", \"l2.out\", \"late.out\", \"late2.out\"]\n";
  for (const char* fed : {"y", "l2"}) {
    std::string text = loop;
    text.replace(text.find("FED"), 3, fed);
    const RunTable run = simulate(text, 1e-8);
    for (std::size_t k = 0; k < run.time().size(); ++k) {
      CHECK(std::abs(run["y.out"][k] - run["l2.out"][k]) <= 1e-7 * run.scale("y.out"));
      CHECK(std::abs(run["late.out"][k] - run["late2.out"][k]) <= 1e-7 * run.scale("y.out"));
    }
  }
  // Its output as a position: the velocity is its rate.
  const RunTable moved = simulate("[elements]\nu = { type = \"generator\", signal = \"3 mm\" }\n"
                                  "y = { type = \"transfer\", in = \"u\", numerator = 1, denominator = [\"0.04 s^2\", \"0.4 s\", 1] }\n"
                                  "m = { type = \"motion\", at = \"a\", position = { block = \"y\" } }\n"
                                  "c = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1 }\n[simulate]\nstop = 2\n", 1e-8);
  for (std::size_t k = 0; k < moved.time().size(); ++k) {
    const double x = moved.time()[k] / 0.2;
    CHECK(std::abs(moved["a.position"][k] - 0.003 * (1 - (1 + x) * std::exp(-x))) <= 1e-7 * 0.003);
    CHECK(std::abs(moved["a.velocity"][k] - 0.003 / 0.2 * x * std::exp(-x)) <= 1e-7 * 0.015);
  }
}

TEST_CASE("the unit of a transfer function's output, and how it starts") {
  const std::string scene = "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                            "y = { type = \"transfer\", in = \"a.velocity\", numerator = NUM, denominator = DEN }\n"
                            "f = { type = \"force\", at = \"a\", force = { block = \"y\" } }\n[simulate]\nstop = 1\n";
  const auto with = [&](const char* numerator, const char* denominator) {
    std::string text = scene;
    text.replace(text.find("NUM"), 3, numerator);
    return text.replace(text.find("DEN"), 3, denominator);
  };
  CHECK_EQ(refusal(with("[\"2 N*s/m\"]", "[\"0.1 s\", 1]")), "");
  CHECK_EQ(refusal(with("[\"2 N*s^2/m\", \"3 N*s/m\"]", "[1, 5]")), "");
  CHECK_EQ(refusal(with("[\"2 N\"]", "[\"0.1 m\", \"2 m/s\"]")), "");
  CHECK_EQ(refusal(with("[2]", "[0.1, 1]")), "");
  CHECK(refusal(with("[\"2 N\"]", "[\"0.1 s\", 1]")).find("`force` from block `y`: expected a force (N), found a power (W)") != std::string::npos);
  CHECK(refusal(with("[\"2 N*s/m\"]", "[\"0.1 s\", 1]") + "start_from = \"steady\"\n").find("depends on how the network moves") != std::string::npos);
}

TEST_CASE("a transfer function in its steady state") {
  const std::string rest = "m = { type = \"mass\", at = \"a\", mass = 1 }\nu = { type = \"generator\", signal = 3 }\n";
  for (const char* const coefficients : {"numerator = [7], denominator = [2, 3, 5, 4]", "numerator = [2, 1, 6, 7], denominator = [2, 3, 5, 4]", "numerator = [1, 7], denominator = [3, 4]"}) {
    CAPTURE(coefficients);
    const RunTable run = simulate(fmt::format("[elements]\n{}y = {{ type = \"transfer\", in = \"u\", {} }}\nl = {{ type = \"transfer\", in = \"y\", numerator = 2, denominator = [1, 1, 2] }}\n"
                                              "[simulate]\nstop = 2\nstart_from = \"steady\"\nrecord = [\"y.out\", \"l.out\"]\n", rest, coefficients));
    for (std::size_t k = 0; k < run.time().size(); ++k) {
      CHECK(std::abs(run["y.out"][k] - 21.0 / 4) <= 1e-9);
      CHECK(std::abs(run["l.out"][k] - 21.0 / 4) <= 1e-9);
    }
  }
}

}  // namespace rheonet::test::transfer_test
