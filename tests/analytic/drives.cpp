#include "tests/analytic/drives.hpp"

#include <fmt/format.h>

#include <numbers>

namespace rheonet::test {

namespace {

constexpr double frequency = 2.3;  // Hz: a few periods in a run of about 1 s
constexpr double omega = 2 * std::numbers::pi * frequency;

std::string motion(const std::string& what, const std::string& signal) {
  return fmt::format("[elements.drive]\ntype = \"motion\"\nat = \"end\"\n{} = {{ {}, time = {:.17g} }}\n", what, signal,
                     drive_start);
}

std::string sine_signal(const char* kind, double amplitude) {
  return fmt::format("{} = {:.17g}, frequency = {:.17g}", kind, amplitude, frequency);
}

}  // namespace

std::vector<Strain> smooth_strains() {
  const double speed = 0.173, amplitude = 0.0619;
  return {
      {"step of velocity", motion("velocity", fmt::format("step = {:.17g}", speed)), 0, Response::constant(speed)},
      {"ramp of position", motion("position", fmt::format("ramp = {:.17g}", -speed)), 0, Response::constant(-speed)},
      {"sine of velocity", motion("velocity", sine_signal("sine", speed)), 0, Response::sine(speed, omega)},
      {"sine of position", motion("position", sine_signal("sine", amplitude)), 0,
       Response::sine(amplitude, omega).derivative()},
  };
}

std::vector<Strain> sudden_strains() {
  const double jump = 0.0417;
  return {
      {"step of position", motion("position", fmt::format("step = {:.17g}", jump)), jump, Response()},
      {"cosine of position", motion("position", sine_signal("cosine", -jump)), -jump,
       Response::sine(-jump, omega, std::numbers::pi / 2).derivative()},
  };
}

std::vector<Load> loads() {
  const double force = 3.71;
  const auto element = [](const std::string& signal) {
    return fmt::format("[elements.drive]\ntype = \"force\"\nat = \"end\"\nforce = {{ {}, time = {:.17g} }}\n", signal,
                       drive_start);
  };
  return {
      {"step of force", element(fmt::format("step = {:.17g}", force)), Response::constant(force)},
      {"sine of force", element(sine_signal("sine", -force)), Response::sine(-force, omega)},
  };
}

}  // namespace rheonet::test
