#pragma once

#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"

namespace rheonet {

/// A consistent state and its derivatives.
struct Motion { const std::vector<double>&y, &yp, &ypp; };

/// How large each unknown may be until t + ahead. A velocity that a power law gives at rest may begin with a slope that is
/// infinite but for rounding: there it is what one implicit step of Euler's comes to.
std::vector<double> coming_size(const Dae& dae, Consistency& consistency, double t, const Motion& motion, double ahead);

/// The fastest rate at which a network itself changes at t [1/s]; `horizon` is the time until something is known to happen
/// [s]. A power law at rest has a slope of 0 or infinity: there it is what the forces are a moment later that counts, the
/// time `ahead` [s].
double fastest_rate(const Dae& dae, Consistency& consistency, double t, double horizon, const Motion& motion, double ahead);

/// The longest first step [s] whose error, by the second derivatives of the unknowns, is within their tolerances (E. Hairer,
/// S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, II.4). Infinite where nothing curves.
double first_step(const std::vector<double>& ypp, const std::vector<double>& tolerance);

/// What follows a motion is in no error test, and yet remembered for a delay: between steps of this angle the polynomial through
/// them misses a sine by a tenth of the accuracy [rad].
double remembered_angle(double accuracy);

}  // namespace rheonet
