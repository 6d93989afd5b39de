#pragma once

#include <vector>

#include "core/result/row_store.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// A much more accurate run against which others are measured, with details between its rows.
struct ReferenceSolution {
  /// An event near a row, with the records on both sides, which may jump. An interval between two events counts as one such
  /// event if it is short compared with the intervals before and after it: a steep ramp of a signal, say.
  struct Instant {
    double time;                        ///< of an interval: its end
    std::vector<double> before, after;
    double lasts = 0;                   ///< length of the interval, 0 for a single event [s]
  };
  RowStore rows;
  Summary summary;
  std::vector<double> largest;    ///< magnitude of each record, including times between rows
  std::vector<Instant> instants;  ///< sorted by time
};

/// Simulates; `row` and `state` of the settings are replaced. Keeps the events within `near` [s] of a row. Throws SimulationError.
ReferenceSolution run_as_reference(const Scene& scene, double near, RunSettings settings = {});
/// The same into `result`, which has the rows up to there if SimulationError is thrown.
void run_as_reference(const Scene& scene, double near, RunSettings settings, ReferenceSolution& result);

/// The error of a record in a run, as the accuracy of a scene is defined: at a row, the distance from the true value. Near a
/// jump, within `shift` [s] of the row, the value on either side of the jump counts as true. During a steep change within
/// that time, every value on the way counts as true.
struct RecordError {
  double largest = 0;    ///< SI
  double time = 0;       ///< time of the largest error [s]
  double scale = 0;      ///< largest magnitude of the record in the run, SI
  double beyond = not_given;  ///< first time at which the error exceeds `allowed` x scale [s]; NaN if it never does

  double relative() const { return scale > 0 ? largest / scale : 0; }
};

/// Parameters of the error measure.
struct ErrorMeasure {
  double allowed = 1e-6;  ///< relative limit, for RecordError::beyond
  double shift = 0;       ///< allowed displacement of a jump [s]
  double factor = 1;      ///< multiplies each distance, to allow for the error of the yardstick
};

/// The error of each record of the scene in the rows of a run; both runs may have more records after these. Rows at times that only one of
/// the runs has (events) are ignored.
std::vector<RecordError> record_errors(const Scene& scene, const RowStore& rows, const ReferenceSolution& truth,
                                       const ErrorMeasure& measure);

/// Index of the largest relative error; 0 if there is none.
std::size_t worst_of(const std::vector<RecordError>& errors);

}  // namespace rheonet
