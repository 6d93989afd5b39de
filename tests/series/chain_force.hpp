#pragma once

#include <vector>

#include "tests/series/chain.hpp"

namespace rheonet::test {

/// The force at these times in a chain whose ends move apart at a constant velocity V from rest, by quadrature. All elements have the same
/// force f, and their velocities sum to V: f' C(f) + r(f) = V. C is the sum of the compliances: 1/k of a spring or a viscous friction model,
/// (1 - f/Fc)^-i / sigma of solid friction. r is the sum of the velocities of the dashpots. Hence
///
///     t(f) = integral of C / (V - r) from 0 to f.
///
/// f rises to the lesser of the weakest friction and the force with r = V, and stays there.
std::vector<double> force_of_steady_chain(const Chain& chain, const std::vector<double>& times);

}  // namespace rheonet::test
