// A slider at a massless node holds loads up to its force. A larger load is refused, with the names of the overloaded elements and the time,
// because the velocity would be undetermined.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "core/network/error.hpp"
#include "core/result/run.hpp"
#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::slider_refusal_test {

namespace {

constexpr double Fc = 2.71;

std::string scene(const std::string& force, const std::string& elements, double stop = 1) {
  return netlist({{"Fc", Fc}},
                 "[elements]\npush = { type = \"force\", at = \"end\", force = " + force + " }\n" + elements, stop,
                 101);
}
const std::string slider = "block = { type = \"slider\", between = [\"end\", \"ground\"], coulomb = \"Fc\" }\n";
const std::string sticky =
    "block = { type = \"slider\", between = [\"end\", \"ground\"], coulomb = \"Fc\", breakaway = \"1.43*Fc\" }\n";

bool names_one_of(const std::string& text, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (text.find("`" + name + "`") != std::string::npos) return true;
  }
  return false;
}

/// The time that a message gives, or NaN.
double time_in(const std::string& text) {
  const std::size_t at = text.find("t = ");
  return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + 4, nullptr);
}

template <class Try>
std::string error_of(Try attempt) {
  try {
    attempt();
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

/// A run that is refused at t [s] < 1, and whose check at the start says nothing.
void check_refused(const std::string& toml, double t, const std::vector<std::string>& names) {
  INFO(toml);
  const Scene scene = scene_of(toml);
  CHECK_EQ(error_of([&] { check(scene); }), "");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> csv(std::tmpfile(), &std::fclose);
  const std::string text = error_of([&] { run(scene, {.csv = csv.get(), .interrupt = nullptr, .progress = {}}); });
  CAPTURE(text);
  CHECK(names_one_of(text, names));
  // A message gives six digits.
  CHECK_LE(std::abs(time_in(text) - t), 1e-6);
  // The rows up to there have been written, and nothing has moved.
  const RunTable rows = read_rows(csv.get());
  CHECK_EQ(rows.time().size(), std::size_t(t / scene.output_every) + 1);
  check_exactly(rows, "end.velocity", 0);
}

void check_refused_at_once(const std::string& toml, const std::vector<std::string>& names) {
  INFO(toml);
  const Scene scene = scene_of(toml);
  for (const std::string& text : {error_of([&] { check(scene); }), error_of([&] { run(scene); })}) {
    CAPTURE(text);
    CHECK(names_one_of(text, names));
    CHECK((std::isnan(time_in(text)) || time_in(text) == 0));
  }
}

}  // namespace

TEST_CASE("A force that outgrows a slider without mass is refused, with its name and the time") {
  for (const double s : {1.0, -1.0}) {
    const double slope = s * 4.3137;
    check_refused(scene(fmt::format("{{ ramp = {} }}", slope), slider), Fc / 4.3137, {"block", "end"});
    check_refused(scene(fmt::format("{{ ramp = {} }}", slope), sticky), 1.43 * Fc / 4.3137, {"block", "end"});
    const double frequency = 0.37, amplitude = s * 1.19 * Fc;
    check_refused(scene(fmt::format("{{ sine = {:.17g}, frequency = {} }}", amplitude, frequency), slider),
                  std::asin(1 / 1.19) / (2 * std::numbers::pi * frequency), {"block", "end"});
    check_refused(scene(fmt::format("{{ step = {:.17g}, time = 0.3137 }}", s * 1.0001 * Fc), slider), 0.3137,
                  {"block", "end"});
    // Two peaks just within, then one beyond.
    check_refused(scene(fmt::format("{{ table = [[0, 0], [0.2, {0}], [0.4, 0], [0.5, {1}], [0.7, {2}], [1, 0]] }}",
                                    s * 2.7, s * -2.7, s * 3.7),
                        slider),
                  0.5 + 0.2 * (2.7 + Fc) / (2.7 + 3.7), {"block", "end"});
  }
}

TEST_CASE("A force that outgrows a slider behind others is refused") {
  const std::string ramp = "{ ramp = 4.3137 }";
  const double t = Fc / 4.3137;
  const std::string weak = "coulomb = \"Fc\" }\n", strong = "coulomb = \"1.37*Fc\" }\n";
  check_refused(scene(ramp, "s1 = { type = \"slider\", between = [\"mid\", \"end\"], " + strong +
                                "s2 = { type = \"slider\", between = [\"mid\", \"ground\"], " + weak),
                t, {"s2", "mid"});
  check_refused(scene(ramp, "s1 = { type = \"slider\", between = [\"mid\", \"end\"], " + weak +
                                "s2 = { type = \"slider\", between = [\"mid\", \"ground\"], " + strong),
                t, {"s1", "end"});
  check_refused(scene(ramp,
                      "s1 = { type = \"slider\", between = [\"end\", \"ground\"], coulomb = \"0.37*Fc\" }\n"
                      "s2 = { type = \"slider\", between = [\"ground\", \"end\"], coulomb = \"0.63*Fc\" }\n"),
                t, {"s1", "s2", "end"});
}

// A spring before the slider moves a little until then, and does not help.
TEST_CASE("A force that outgrows a slider behind a spring is refused") {
  const std::string toml = scene("{ ramp = 4.3137 }",
                                 "spring = { type = \"spring\", between = [\"end\", \"mid\"], stiffness = 137.3 }\n"
                                 "block = { type = \"slider\", between = [\"mid\", \"ground\"], coulomb = \"Fc\" }\n");
  const std::string text = refusal(toml);
  CAPTURE(text);
  CHECK(names_one_of(text, {"block", "mid"}));
  CHECK_LE(std::abs(time_in(text) - Fc / 4.3137), 1e-6);
}

TEST_CASE("A force beyond a slider without mass from the start is refused before anything is run") {
  for (const double s : {1.0, -1.0}) {
    check_refused_at_once(scene(fmt::format("{:.17g}", s * 1.000001 * Fc), slider), {"block", "end"});
    check_refused_at_once(scene(fmt::format("{:.17g}", s * 1.4300001 * Fc), sticky), {"block", "end"});
    check_refused_at_once(scene(fmt::format("{{ cosine = {:.17g}, frequency = 1 }}", s * 1.37 * Fc), slider),
                          {"block", "end"});
  }
}

TEST_CASE("A force that a slider without mass just holds is not refused") {
  for (const double s : {1.0, -1.0}) {
    CHECK_EQ(refusal(scene(fmt::format("{:.17g}", s * Fc), slider)), "");
    CHECK_EQ(refusal(scene(fmt::format("{:.17g}", s * 0.999999 * Fc), slider)), "");
    CHECK_EQ(refusal(scene(fmt::format("{:.17g}", s * 1.4299999 * Fc), sticky)), "");
    CHECK_EQ(refusal(scene(fmt::format("{{ sine = {:.17g}, frequency = 2.7 }}", s * Fc), slider)), "");
    CHECK_EQ(refusal(scene(fmt::format("{:.17g}", s * 1.37 * Fc),
                           slider + "inertia = { type = \"mass\", at = \"end\", mass = 0.1 }\n")),
             "");
    CHECK_EQ(refusal(scene(fmt::format("{:.17g}", s * 1.37 * Fc),
                           slider + "drag = { type = \"dashpot\", between = [\"end\", \"ground\"], damping = 0.1 }\n")),
             "");
  }
}

TEST_CASE("A breakaway force below the sliding force is refused") {
  const std::string text = refusal(scene(
      "1",
      "block = { type = \"slider\", between = [\"end\", \"ground\"], coulomb = \"Fc\", breakaway = \"0.99*Fc\" }\n"));
  CAPTURE(text);
  CHECK(text.find("breakaway") != std::string::npos);
  CHECK(text.find("coulomb") != std::string::npos);
}

TEST_CASE("A slider of no force is none") {
  const std::string mass = "inertia = { type = \"mass\", at = \"end\", mass = 0.713 }\n";
  const std::string none = "block = { type = \"slider\", between = [\"end\", \"ground\"], coulomb = 0 }\n";
  const Expectations free = {{"end.velocity", [](double t) { return 1.13 / 0.713 * t; }},
                             {"block.force", [](double) { return 0; }}};
  check_at_all_accuracies(scene("1.13", mass + none), free);
}

}  // namespace rheonet::test::slider_refusal_test
