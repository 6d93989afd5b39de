#pragma once

#include <string>

#include "core/netlist/scene.hpp"
#include "tests/support/reference_integrator.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// How the rows of a run lie beside those of the reference. A value of the reference counts if its own estimate of its
/// error is small beside the scale of its record; what it holds to be doubtful is left out.
struct Agreement {
  double worst = 0;     ///< largest deviation, in parts of what the reference's doubt and the accuracy allow: <= 1 is agreement
  double deviation = 0; ///< the same one in parts of the record's scale
  std::string where;    ///< record, time and both values of it
  double judged = 0;    ///< share of the values that count
  std::string unjudged; ///< a record of which no value counts; "" if there is none
  /// Root mean squares, in parts of the scale, of the deviation from the reference and from its longest steps.
  double from_fine = 0, from_coarse = 0;
};

Agreement agreement(const Scene& scene, const RunTable& rows, const ReferenceSolution& reference);

}  // namespace rheonet::test
