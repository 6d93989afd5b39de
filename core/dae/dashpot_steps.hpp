#pragma once

#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Where steps of positions take the massless nodes that dashpots hold. A step is the limit of a ramp over a time tau
/// that goes to 0: a dashpot f = B |w|^n resists it with B |dx|^n/tau^n. Masses stay, springs and friction do not count
/// beside that, and dashpots of a larger n outweigh those of a smaller one: they are rigid as far as the others give
/// way.
///
/// `dx` holds the steps of known nodes and 0 for masses; it receives those of viscous nodes. False if they cannot be
/// found.
bool go_with_dashpots(const Network& network, const Structure& structure, std::vector<double>& dx);

/// Two nodes whose steps differ by no more than rounding.
bool step_together(double a, double b);

/// The momentum that such steps give to each node [N s]. In the limit the impulse of a dashpot, B |dx|^n tau^(1-n), is
/// B dx for n = 1 and 0 below. Above it is infinite; where such a dashpot is rigid it passes on what comes to a
/// massless end. Throws SimulationError where a mass would get an infinite impulse, or one of which the share is left
/// open.
std::vector<double> momentum_through_dashpots(const Network& network, const Structure& structure,
                                              const std::vector<double>& dx, double t);

}  // namespace rheonet
