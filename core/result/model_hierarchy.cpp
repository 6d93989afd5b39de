#include "core/result/model_hierarchy.hpp"

#include <algorithm>
#include <set>

#include "core/base/numerics.hpp"
#include "core/network/effects.hpp"
#include "core/network/network.hpp"

namespace rheonet {

namespace {

std::size_t furthest(const std::vector<Difference>& differences) {
  const auto worst = std::max_element(differences.begin(), differences.end(),
                                      [](const Difference& a, const Difference& b) { return a.relative() < b.relative(); });
  return static_cast<std::size_t>(worst - differences.begin());
}

class Climber {
 public:
  Climber(const Scene& scene, const LadderSettings& settings) : scene_(scene), settings_(settings) {
    ladder_.effects = effects_in(scene);
  }

  ModelHierarchy climb() {
    reference_ = run_to_memory(scene_, run_settings());
    ladder_.full = compare(reference_);
    told();
    for (const Effect effect : ladder_.effects) ladder_.each.push_back(model({effect}));
    std::vector<Effect> out;
    for (const Rung* rung : by_contribution()) {
      out.push_back(rung->without.front());
      ladder_.steps.push_back(out.size() == 1 ? *rung : model(out));
    }
    time_all();
    return std::move(ladder_);
  }

 private:
  Scene without(const std::vector<Effect>& effects) const {
    Scene bare = scene_;
    for (const Effect effect : effects) bare.without.push_back({effect});
    return bare;
  }

  RunSettings run_settings() const {
    RunSettings settings;
    settings.interrupt = settings_.interrupt;
    return settings;
  }
  bool interrupted() const { return settings_.interrupt && *settings_.interrupt; }

  Rung compare(const Trajectory& trajectory) const {
    Rung rung;
    for (std::size_t k = 0; k < scene_.records.size(); ++k) rung.differences.push_back(difference(reference_, k, trajectory, k));
    rung.worst = furthest(rung.differences);
    rung.steps = trajectory.summary.steps;
    rung.cpu_seconds = {trajectory.summary.cpu_seconds};
    return rung;
  }

  Rung model(const std::vector<Effect>& effects) {
    Rung rung;
    try {
      rung = compare(run_to_memory(without(effects), run_settings()));
    } catch (const SimulationError& error) {
      if (interrupted()) throw;
      rung.failure = error.what();
    }
    rung.without = effects;
    told();
    return rung;
  }

  /// Sorts the single omissions by their effect on the records; those that failed come last.
  std::vector<const Rung*> by_contribution() const {
    std::vector<const Rung*> order;
    for (const Rung& rung : ladder_.each) order.push_back(&rung);
    std::stable_sort(order.begin(), order.end(), [](const Rung* a, const Rung* b) {
      return a->failure.empty() != b->failure.empty() ? a->failure.empty() : a->relative() < b->relative();
    });
    return order;
  }

  /// Times all models in turn, so that disturbances of the machine affect all of them.
  void time_all() {
    std::vector<Rung*> rungs{&ladder_.full};
    for (auto* list : {&ladder_.each, &ladder_.steps}) {
      for (Rung& rung : *list) {
        if (rung.failure.empty()) rungs.push_back(&rung);
      }
    }
    const double slow = numerics::slow_model_ratio * ladder_.full.cpu_seconds.front();
    for (int k = 1; k < settings_.runs; ++k) {
      for (Rung* rung : rungs) {
        if (rung->cpu_seconds.front() > slow) continue;
        rung->cpu_seconds.push_back(run(without(rung->without), run_settings()).cpu_seconds);
        told();
      }
    }
    for (Rung* rung : rungs) std::sort(rung->cpu_seconds.begin(), rung->cpu_seconds.end());
  }

  void told() {
    const double all = static_cast<double>(2 * ladder_.effects.size() + 1) * settings_.runs;
    if (settings_.progress) settings_.progress(std::min(1.0, ++done_ / all));
  }

  const Scene& scene_;
  const LadderSettings& settings_;
  Trajectory reference_;
  ModelHierarchy ladder_;
  double done_ = 0;  ///< number of runs done
};

}  // namespace

double Rung::median_cpu() const { return cpu_seconds.empty() ? 0 : cpu_seconds[cpu_seconds.size() / 2]; }

const Rung* ModelHierarchy::barest_within(double relative) const {
  const Rung* barest = nullptr;
  for (const Rung& rung : steps) {
    if (rung.failure.empty() && rung.relative() <= relative) barest = &rung;
  }
  return barest;
}

std::vector<Effect> effects_in(const Scene& scene) {
  std::set<Effect> found;
  for (const SceneElement& element : scene.elements) {
    const std::vector<Effect> out = left_out_of(scene, element);
    for (const Effect effect : brought_by(element)) {
      if (std::find(out.begin(), out.end(), effect) == out.end()) found.insert(effect);
    }
  }
  if (!feedback_of(build_network(scene)).empty()) found.insert(Effect::feedback);
  return {found.begin(), found.end()};
}

ModelHierarchy ladder_of(const Scene& scene, const LadderSettings& settings) { return Climber(scene, settings).climb(); }

}  // namespace rheonet
