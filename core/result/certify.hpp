#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/result/balances.hpp"
#include "core/result/reference_solution.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// Estimated errors of a run.
struct Certificate {
  /// A run to one tolerance, measured by a run to a hundredth of it.
  struct Round {
    double tolerance;  ///< Tolerance of the run that was measured.
    std::size_t worst;  ///< Index of the record with the largest relative error.
    RecordError error;  ///< Error of this record.
  };
  bool holds = false;               ///< Every record is within the scene's accuracy.
  std::vector<Round> rounds;        ///< If a round has shown the accuracy to hold, it is the last one.
  std::size_t kept = 0;             ///< Index of the round whose measured run provides the rows.
  std::vector<RecordError> errors;  ///< For each record in the kept run; empty without a round.
  double until = not_given;         ///< If it does not hold: the first time at which an error exceeds the accuracy [s].
  std::optional<Imbalance> imbalance;  ///< If it does not hold because of forces out of balance: the worst imbalance.
  std::string obstacle;             ///< Error message of a tighter run that could not measure; "" if none was needed, or if
                                    ///< the limit of double precision was reached.
  Summary summary;                  ///< Summary of the run whose rows are kept.
  int runs = 0;
  double cpu_seconds = 0;           ///< CPU time of all completed runs together.

  const Round& result() const { return rounds[kept]; }
};

/// Simulates a scene so that each record is as accurate as the scene asks, and estimates the actual errors. Two runs start
/// at once, one to the scene's accuracy and one to a tolerance a hundred times tighter, which measures the first and reports
/// `progress`. If the first is not accurate enough, the tighter one replaces it and is measured in turn, down to the limit
/// of double precision; finally the tightest possible run measures one a hundred times looser. Imbalances at massless nodes
/// in the written rows count as errors, because all runs may share them. Rows, events and calls of `row` come from the run
/// shown to be accurate; if there is none, from the most accurate run. `tolerance` and `state` of the settings are not used.
///
/// Until they are accepted, rows are in temporary files, and events in memory. Throws SimulationError like `run` if the scene cannot be
/// simulated; the rows up to there have then been written.
Certificate certify(const Scene& scene, const RunSettings& settings = {});

/// The same, to the tolerance of the settings if given. Returns the summary of the kept run, with the CPU time of all runs.
/// Throws SimulationError also if no run is shown to be accurate.
Summary run_certified(const Scene& scene, const RunSettings& settings);

}  // namespace rheonet
