#include "core/solve/integrator.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "tests/support/probe.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::integrator_test {

namespace {

using Function = std::function<double(double t, const double* y)>;

class Given final : public EventFunctions {
 public:
  explicit Given(std::vector<Function> functions) : functions_(std::move(functions)) {}
  int count() const override { return static_cast<int>(functions_.size()); }
  void evaluate(double t, const double* y, const double*, double* g) override {
    for (std::size_t k = 0; k < functions_.size(); ++k) g[k] = functions_[k](t, y);
  }

 private:
  std::vector<Function> functions_;
};

const Scene oscillator = scene_of(R"([elements]
m = { type = "mass", at = "x", mass = 1.3 }
k = { type = "spring", between = ["x", "ground"], stiffness = 2.1 }
[nodes]
x = { velocity = 0.7 }
[simulate]
stop = 3
)");

struct Met {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< after the start
  std::vector<int> events;
  double velocity = 0;
};

/// The first event of a mass on a spring, from `start` on.
Met first_event(std::vector<Function> functions, double start = 0) {
  Probe probe(oscillator);
  Given given(std::move(functions));
  const std::vector<double> tolerance(probe.y().size(), 1e-9), grain(probe.y().size(), 0);
  Integrator integrator(probe.dae(), given, tolerance, grain, {});
  integrator.restart(start, probe.y(), probe.yp(), 1e-3, start + 3);
  Integrator::Outcome outcome = Integrator::Outcome::step;
  while (outcome == Integrator::Outcome::step) outcome = integrator.step();
  if (outcome != Integrator::Outcome::event) return {};
  return {integrator.time() - start, integrator.events(), integrator.y()[at(probe.dae().indices().velocity[at(1)])]};
}

Function falls_at(double time) {
  return [time](double t, const double*) { return time - t; };
}

}  // namespace

TEST_CASE("a step ends at the first of the events that it goes over") {
  const Met first = first_event({falls_at(0.9), falls_at(0.3), falls_at(0.3 + 1e-7)});
  CHECK(std::abs(first.time - 0.3) < 1e-12);
  CHECK(first.events == std::vector<int>{0, 1, 0});
  const double omega = std::sqrt(2.1 / 1.3);
  CHECK(first.velocity == doctest::Approx(0.7 * std::cos(omega * 0.3)).epsilon(1e-6));
  CHECK(first_event({falls_at(0.3), falls_at(0.9), falls_at(0.3)}).events == std::vector<int>{1, 0, 1});
  CHECK(std::isnan(first_event({falls_at(5)}).time));
  CHECK(std::isnan(first_event({}).time));
}

TEST_CASE("an event is a fall through 0, however steep or flat") {
  for (const double power : {0.2, 1.0, 3.0, 21.0}) {
    CAPTURE(power);
    for (const double scale : {1e-40, 1.0, 1e200}) {
      CAPTURE(scale);
      const auto g = [&](double t, const double*) { return std::copysign(scale * std::pow(std::abs(0.4 - t), power), 0.4 - t); };
      CHECK(std::abs(first_event({g}).time - 0.4) < 1e-12);
    }
  }
  const auto step = [](double t, const double*) { return t < 0.4 ? std::numeric_limits<double>::infinity() : -1.0; };
  CHECK(std::abs(first_event({step}).time - 0.4) < 1e-12);
  const auto touches = [](double t, const double*) { return (t - 0.4) * (t - 0.4) + 1e-9; };
  CHECK(std::isnan(first_event({touches}).time));
}

TEST_CASE("what is 0 or below it at the start has to rise before it falls") {
  const auto from_zero = [](double t, const double*) { return t * (0.8 - t); };
  CHECK(std::abs(first_event({from_zero}).time - 0.8) < 1e-12);
  const auto from_below = [](double t, const double*) { return (t - 0.5) * (1.1 - t); };
  CHECK(std::abs(first_event({from_below}).time - 1.1) < 1e-12);
  CHECK(std::isnan(first_event({[](double, const double*) { return 0.0; }}).time));
  CHECK(std::isnan(first_event({[](double t, const double*) { return -t; }}).time));
}

TEST_CASE("an event of the state is met where the state has it, also late") {
  const double quarter = std::acos(0.0) / std::sqrt(2.1 / 1.3);
  Probe probe(oscillator);
  const int v = probe.dae().indices().velocity[at(1)];
  for (const double start : {0.0, 1e3, 1e6}) {
    CAPTURE(start);
    const Met met = first_event({[v](double, const double* y) { return y[v]; }}, start);
    CHECK(std::abs(met.time - quarter) < 1e-7);
    CHECK(std::abs(met.velocity) < 1e-9);
    CHECK(std::abs(first_event({falls_at(start + 0.3)}, start).time - 0.3) < 1e-12 + 1e-13 * start);
  }
}

}  // namespace rheonet::test::integrator_test
