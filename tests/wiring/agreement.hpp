#pragma once

#include <string>

#include "core/netlist/scene.hpp"
#include "tests/support/reference_integrator.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// Allowed deviation as a multiple of the accuracy; the simulator promises 1 for each run.
constexpr double of_accuracy = 20;

/// Agreement between the rows of a run and those of the reference. A value of the reference is judged only if its error estimate is small
/// relative to the scale of its record.
struct Agreement {
  double worst = 0;     ///< Largest deviation relative to the tolerance from the reference's doubt and the accuracy: <= 1 is agreement.
  double deviation = 0; ///< The same deviation relative to the record's scale.
  std::string where;    ///< Its record, time and both values.
  double judged = 0;    ///< Fraction of the values that are judged.
  std::string unjudged; ///< A record without any judged value; "" if there is none.
  /// Root mean square deviations, relative to the scale, from the reference and from its run with the longest steps.
  double from_fine = 0, from_coarse = 0;
};

Agreement agreement(const Scene& scene, const RunTable& rows, const ReferenceSolution& reference);

}  // namespace rheonet::test
