#pragma once

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// Judges the forces of the sliders that stick, of rows that hold every force and velocity: every node where one ends balances, to
/// the accuracy of the run, and of all forces within the bounds that balance the same, theirs have the least norm. "" or what is
/// wrong.
std::string wrong_sticking(const Scene& scene, const Trajectory& rows);

}  // namespace rheonet::test
