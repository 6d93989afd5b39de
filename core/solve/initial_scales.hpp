#pragma once

#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"

namespace rheonet {

/// A consistent state and its derivatives.
struct Motion { const std::vector<double>&y, &yp, &ypp; };

/// Estimates the largest magnitude of each unknown until t + ahead. The initial slope of a velocity that follows from a
/// power law at rest may be infinite but for round-off: there the estimate is one step of the implicit Euler method.
std::vector<double> coming_size(Dae& dae, Consistency& consistency, double t, const Motion& motion, double ahead);

/// The fastest rate of change of the network itself at t [1/s]; `horizon` is the time until the next known discontinuity
/// [s]. A power law at rest has slope 0 or infinity: there the rate is that of the state at t + `ahead` [s].
double fastest_rate(const Dae& dae, Consistency& consistency, double t, double horizon, const Motion& motion, double ahead);

/// The longest first step [s] whose error, estimated from second derivatives, is within the tolerances (E. Hairer, S. P.
/// Norsett, G. Wanner, Solving Ordinary Differential Equations I, II.4). Infinite where all second derivatives are 0.
double first_step(const std::vector<double>& ypp, const std::vector<double>& tolerance);

/// True if two motions from t on stay closer to each other than the tolerances until t + ahead, to second order. The curvatures
/// count: one long step across a corner between symmetric arcs can pass IDA's error test with any error.
bool stay_close(const Motion& a, const Motion& b, double ahead, const std::vector<double>& tolerance);

/// Longest step on which nothing is missed that no error test sees [s]: reversals of sliders that stick (`sticks`) or follow the
/// inputs directly (`slips_along`), and the history that delays interpolate. Infinite if there is no limit.
double longest_step(const Inputs& inputs, bool sticks, bool slips_along, double accuracy);

}  // namespace rheonet
