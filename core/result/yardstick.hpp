#pragma once

#include <vector>

#include "core/result/course.hpp"

namespace rheonet {

/// A run that others are measured by: a much more accurate one, and what its rows do not show.
struct Yardstick {
  /// An instant near a row at which a record may jump, and the records on both sides of it. A stretch between two events is
  /// taken for one as well, if it is short beside those on both sides of it: a signal that goes over as if it jumped.
  struct Instant {
    double time;                        ///< of a stretch that of its end
    std::vector<double> before, after;
    double lasts = 0;                   ///< s
  };
  Course course;
  std::vector<double> largest;    ///< magnitude of each record, between rows too
  std::vector<Instant> instants;  ///< in order of time
};

/// Simulates, with settings of which `state` is taken. Instants are kept that are within `near` [s] of a row.
/// Throws SimulationError.
Yardstick run_as_yardstick(const Scene& scene, double near, RunSettings settings = {});

/// The error of a record in a run, as the accuracy of a scene is defined: at a row the distance from the true value, or,
/// where the record jumps no further away than `shift` [s], from its value on either side of the jump; where it takes some of
/// that time for it, from its values on the way.
struct RecordError {
  /// A record of less than this share of the accuracy, of the largest of its kind, of which no digit is certain, is nothing
  /// but the error of the others: it has no size of its own.
  static constexpr double share_of_kind = 1e-4;

  double largest = 0;    ///< SI
  double time = 0;       ///< of that [s]
  double scale = 0;      ///< largest magnitude of the record in the run, SI
  double beyond = not_given;  ///< the first time at which it is more than `allowed` of the scale [s]; NaN if it never is

  double relative() const { return scale > 0 ? largest / scale : 0; }
};

/// How to take a distance for an error.
struct ErrorMeasure {
  double allowed = 1e-6;  ///< relative
  double shift = 0;       ///< s
  double factor = 1;      ///< enlarges each distance, for what the yardstick itself may be wrong
};

/// One for each record of the scene, though the runs may have more records behind these. Rows at times that only one of the runs has
/// (events) are left out.
std::vector<RecordError> record_errors(const Scene& scene, const Course& course, const Yardstick& truth,
                                       const ErrorMeasure& measure);

/// Position of the largest relative error; 0 if there is none.
std::size_t worst_of(const std::vector<RecordError>& errors);

}  // namespace rheonet
