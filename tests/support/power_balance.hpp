#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// Power, dissipated power and energy of every element of a scene, in rows at `intervals` equal intervals: of element e in the
/// columns 3 e, 3 e + 1 and 3 e + 2.
std::vector<std::vector<double>> power_rows(Scene scene, int intervals);

/// Checks that power = d(energy)/dt + dissipated over each pair of intervals, by Simpson's rule, for all elements but motions and
/// forces. At events and corners of inputs the rule does not apply: the few pairs with the largest defects do not count.
/// `allowed` is a share of the work and the energy of the element.
void check_storage(const Scene& scene, const std::vector<std::vector<double>>& rows, double allowed);

/// Checks that the power that motions and forces supply is what all other elements take up, at every time (Tellegen's theorem).
/// `allowed` is a share of the largest power.
void check_supply(const Scene& scene, const std::vector<std::vector<double>>& rows, double allowed);

}  // namespace rheonet::test
