#pragma once

#include <string>

#include "core/netlist/scene.hpp"
#include "tests/support/reference_integrator.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// How the rows of a run lie beside those of the reference. A value of the reference counts if its own estimate of its
/// error is small beside the scale of its record; what it holds to be doubtful is left out.
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
