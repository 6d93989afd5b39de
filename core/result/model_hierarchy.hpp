#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/result/trajectory.hpp"

namespace rheonet {

/// A scene without some of its effects, compared with the full model.
struct Rung {
  std::vector<Effect> without;           ///< in the order of leaving out
  std::string failure;                   ///< error message; if it is not "", the other members are void
  std::vector<Difference> differences;   ///< of each record from the full model
  std::size_t worst = 0;                 ///< index of the largest relative difference
  long steps = 0;
  std::vector<double> cpu_seconds;       ///< of each run, ascending; a model much slower than the full one has one run

  double relative() const { return differences.empty() ? 0 : differences[worst].relative(); }
  double median_cpu() const;
};

struct LadderSettings {
  int runs = 3;  ///< timed runs of each model
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double fraction)> progress = {};  ///< called from time to time with the fraction of runs done
};

/// The models of a scene from the full one to the barest: contribution of each effect to the records, and its cost.
struct ModelHierarchy {
  std::vector<Effect> effects;  ///< effects present in the scene
  Rung full;
  std::vector<Rung> each;       ///< for each effect, the model without that effect alone
  std::vector<Rung> steps;      ///< each without one effect more than the last: first those with the least contribution of
                                ///< their own, last those without which the scene cannot be simulated

  /// The barest model in `steps` whose records all differ from the full model by at most `relative` times their largest
  /// magnitude; nullptr if there is none.
  const Rung* barest_within(double relative) const;
};

/// Runs all models of a scene in turn, each `runs` times. Throws SimulationError if the full model cannot be simulated, or
/// on an interrupt.
ModelHierarchy ladder_of(const Scene& scene, const LadderSettings& settings = {});

/// The effects that elements or feedback bring into the scene and that it does not leave out. Throws SimulationError.
std::vector<Effect> effects_in(const Scene& scene);

}  // namespace rheonet
