#pragma once

#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Finds how far the massless nodes that dashpots hold move at steps of prescribed positions. A step is the limit of a ramp
/// over a time tau that goes to 0: a dashpot f = B |w|^n resists it with B |dx|^n/tau^n. In this limit masses stay, springs and
/// friction are negligible, and dashpots of larger n outweigh those of smaller n: they are rigid as far as the others give way.
///
/// `dx` holds the steps of known nodes and 0 for masses; it receives the steps of viscous nodes. Returns false if they cannot
/// be found.
bool go_with_dashpots(const Network& network, const Structure& structure, std::vector<double>& dx);

/// Whether the steps of two nodes differ by no more than round-off.
bool step_together(double a, double b);

/// The momentum that such steps give to each node [N s]. In the limit the impulse of a dashpot, B |dx|^n tau^(1-n), is B dx for
/// n = 1, 0 for n < 1 and infinite for n > 1. A rigid dashpot of n > 1 passes on the impulses at its massless end. Throws
/// SimulationError if a mass would get an infinite impulse, or an impulse whose share is undetermined.
std::vector<double> momentum_through_dashpots(const Network& network, const Structure& structure,
                                              const std::vector<double>& dx, double t);

}  // namespace rheonet
