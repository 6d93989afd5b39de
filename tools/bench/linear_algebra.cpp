// Where does KLU begin to beat dense linear algebra? Chains of n/2 masses, springs and dashpots (n unknowns), each
// integrated with both; prints the medians of the time per step as a table.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/start.hpp"
#include "core/solve/integrator.hpp"

namespace {

using namespace rheonet;

class NoEvents final : public EventFunctions {
 public:
  int count() const override { return 0; }
  void evaluate(double, const double*, const double*, double*) override {}
};

int declaration(const char* type) {
  for (std::size_t i = 0; i < components().size(); ++i) {
    if (components()[i]->declaration.type == type) return static_cast<int>(i);
  }
  return -1;
}

Scene chain(int masses) {
  Scene scene;
  scene.nodes.emplace_back().name = "ground";
  for (int i = 1; i <= masses; ++i) {
    scene.nodes.push_back({.name = fmt::format("n{}", i), .position = not_given, .velocity = 1.0 / i, .spot = {}});
    const auto add = [&](const char* type, std::vector<double> values, bool at) {
      SceneElement e;
      e.name = fmt::format("{}{}", type, i);
      e.declaration = declaration(type);
      values.resize(components()[static_cast<std::size_t>(e.declaration)]->declaration.parameters.size(), not_given);
      e.values = std::move(values);
      e.a = i;
      e.b = at ? ground : i - 1;
      e.at = at;
      scene.elements.push_back(std::move(e));
    };
    add("spring", {1000, 0}, false);
    add("dashpot", {1, 1}, false);
    add("mass", {1e-3}, true);
  }
  return scene;
}

/// Seconds a step, median of several runs.
double time_per_step(int masses, int dense) {
  const Scene scene = chain(masses);
  std::vector<double> times;
  for (int repeat = 0; repeat < 15; ++repeat) {
    const Network network = build_network(scene);
    const Modes modes;  // no slider
    const Structure structure = analyse(network, modes);
    const Structure classified = classify(network);
    Start begin_state(network, classified);
    Dae dae(network, structure, begin_state.drive, std::vector<char>(scene.nodes.size(), 0));
    NoEvents events;
    const std::vector<double> tolerance(static_cast<std::size_t>(dae.size()), 1e-7);
    const std::vector<double> grain(tolerance.size(), 0);
    Integrator integrator(dae, events, tolerance, grain, {.dense = dense});
    std::vector<double> y, yp;
    begin_state.drive.enter(0);
    dae.enter(0, begin_state.state, modes, y);
    Consistency(dae).derivative(0, y, yp);
    const auto begin = std::chrono::steady_clock::now();
    integrator.restart(0, y, yp, 1e-9, 0.1);
    while (integrator.step() == Integrator::Outcome::step) {
    }
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    times.push_back(s / static_cast<double>(integrator.statistics().steps));
  }
  std::nth_element(times.begin(), times.begin() + 7, times.end());
  return times[7];
}

}  // namespace

int main() {
  fmt::print("| unknowns | dense, us a step | KLU, us a step | dense/KLU |\n|---|---|---|---|\n");
  for (int masses : {1, 2, 4, 6, 8, 10, 12, 16, 24, 32, 64}) {
    const double dense = time_per_step(masses, 1000), sparse = time_per_step(masses, 0);
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} |\n", 2 * masses, dense * 1e6, sparse * 1e6, dense / sparse);
  }
}
