#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/result/balances.hpp"
#include "core/result/run.hpp"
#include "core/result/yardstick.hpp"

namespace rheonet {

/// What is known of the errors of a run.
struct Certificate {
  /// How much tighter the tolerance of a run is that measures another. Two runs that differ too little share their error:
  /// over the scenes in netlists/ at accuracies from 1e-3 to 1e-8 a tolerance 10 times tighter leaves between 0.02 and 2.0
  /// of the error (0.14 in the median), one 100 times tighter between 0.002 and 0.23 (0.02), for about twice the steps.
  static constexpr double factor = 100;
  /// What the measuring run may be wrong itself, as a share of the error that it measures: the worst of those.
  static constexpr double own_error = 0.25;
  /// At this tolerance and below rounding may be what a measuring run is wrong by, which no tolerance makes smaller. Then a
  /// third run measures too, to the same tolerance but of another order: other steps, other formulas, other roundings. Of
  /// three runs a, b, c whose errors are independent the mean of (a - b)(a - c) is that of the square of the error of a (J. E.
  /// Gray and D. W. Allan, 28th Symposium on Frequency Control (1974) 243): the error is taken for no less.
  static constexpr double rounding_shows = 1e-9;

  /// A run to one tolerance, measured by one to a hundredth of that.
  struct Round {
    double tolerance;  ///< of the run that was measured
    std::size_t worst;  ///< position of the record with the largest relative error
    RecordError error;  ///< of that
  };
  bool holds = false;               ///< every record is within the scene's accuracy
  std::vector<Round> rounds;        ///< the last one first measured to hold, if one does
  std::size_t kept = 0;             ///< the round of whose run the rows are
  std::vector<RecordError> errors;  ///< of that run, of each record of the scene; empty without a round
  double until = not_given;         ///< if it does not hold: the first time at which an error is more than asked for [s]
  std::optional<Imbalance> imbalance;  ///< if it does not hold because forces at a node are out of balance: the worst
  std::string obstacle;             ///< why no tighter run could measure: what ended it; "" if none was needed, or the
                                    ///< limit of double precision has been reached
  Summary summary;                  ///< of the run whose rows are kept
  int runs = 0;
  double cpu_seconds = 0;           ///< of all runs that came to their end, together

  const Round& result() const { return rounds[kept]; }
};

/// Simulates a scene so that each recorded quantity is as accurate as the scene asks, and estimates the errors actually
/// made. Rows, events and calls of `row` are those of one run, which another, to a tolerance a hundred times tighter, has
/// shown to be as accurate as that; they go on at once, `progress` being told of the tighter. Where it is not, the tighter
/// run takes its place, and is measured by one tighter still, down to the limit of double precision; at last the tightest one
/// there can be measures one a hundred times looser. Forces that do not balance at a massless node, in the rows that are
/// written, are errors too: all runs may share them. If none ever is, the rows are those of the most accurate run. `tolerance`
/// and `state` of the settings are not used.
///
/// Rows are held in memory until they are known to be good. Throws SimulationError as `run` does where the scene itself
/// cannot be simulated; the rows up to there have then been written.
Certificate certify(const Scene& scene, const RunSettings& settings = {});

/// The same to the tolerance of the settings in place of the scene's accuracy. Returns the summary of the run whose rows are
/// kept, with the CPU time of all runs. Throws SimulationError also where they are not known to be as accurate.
Summary run_certified(const Scene& scene, const RunSettings& settings);

}  // namespace rheonet
