#pragma once

#include <complex>

namespace rheonet {

/// Auxiliary function of the Fresnel integrals, free of their oscillation; for z >= 0
///
///     G(z) = integral from 0 to infinity of exp(i (z s + s^2/2)) ds
///
/// Falls monotonically from sqrt(pi/2) exp(i pi/4) towards i/z. The relative error is a few units of round-off at any z.
std::complex<double> fresnel_tail(double z);

/// Integral of sin(phase + omega t + chirp t^2/2) from a to b, for chirp != 0; the cost does not depend on the number of
/// turns. The error is the round-off of the angle at each end, divided by the angle's rate of change there.
double integral_of_chirp(double phase, double omega, double chirp, double a, double b);

/// The same for the integral of (b - t) sin(phase + omega t + chirp t^2/2), which is that of the integral above over its upper end. Over more than
/// a turn it loses digits where the frequency hardly changes: as many as the ratio of the frequency to its change has.
double area_of_chirp(double phase, double omega, double chirp, double a, double b);

}  // namespace rheonet
