#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/result/course.hpp"

namespace rheonet {

/// A scene without some of its effects, beside the full one.
struct Rung {
  std::vector<Effect> without;           ///< in the order in which they were left out
  std::string failure;                   ///< why it cannot be simulated; "" if it can: else the rest means nothing
  std::vector<Difference> differences;   ///< of each record, from the full model
  std::size_t worst = 0;                 ///< position of the largest relative difference
  long steps = 0;
  std::vector<double> cpu_seconds;       ///< of each run, ascending; of a model much slower than the full one a single run

  double relative() const { return differences.empty() ? 0 : differences[worst].relative(); }
  double median_cpu() const;
};

struct LadderSettings {
  int runs = 3;  ///< of each model, whose CPU time is taken
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double fraction)> progress = {};  ///< called now and then, with the share of the runs that are done
};

/// The models of a scene from the full one to the barest: what each effect contributes to its records, and what it costs.
struct Ladder {
  std::vector<Effect> effects;  ///< that the scene has
  Rung full;
  std::vector<Rung> each;       ///< of each effect, the model without it alone
  std::vector<Rung> steps;      ///< the next is always that without one more: those first that contribute least by themselves, last
                                ///< those that the scene cannot do without

  /// The barest model on the ladder of which every record is within this of the full one's, relative to its largest magnitude;
  /// nullptr if there is none but the full one.
  const Rung* barest_within(double relative) const;
};

/// Runs all models of a scene, each `runs` times, in turn. Throws SimulationError if the full one cannot be simulated, or on an
/// interrupt.
Ladder ladder_of(const Scene& scene, const LadderSettings& settings = {});

/// The effects that something in the scene brings and that it does not leave out already. Throws SimulationError.
std::vector<Effect> effects_in(const Scene& scene);

}  // namespace rheonet
