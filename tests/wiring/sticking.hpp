#pragma once

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// Judges the printed forces of sliders that stick: the nodes at their ends balance to the accuracy of the run, and the forces are
/// those of least norm within the bounds. The rows must have every force and velocity. Returns "" or the error.
std::string wrong_sticking(const Scene& scene, const RunTable& rows);

}  // namespace rheonet::test
