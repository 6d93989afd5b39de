#pragma once

#include <complex>

namespace rheonet {

/// The auxiliary function of the Fresnel integrals, without their oscillation: for z >= 0
///
///     G(z) = integral from 0 to infinity of exp(i (z s + s^2/2)) ds
///
/// It falls monotonically from sqrt(pi/2) exp(i pi/4) towards i/z. Relative error: some units of round-off, at any z.
std::complex<double> fresnel_tail(double z);

/// Integral of sin(phase + omega t + chirp t^2/2) from a to b, for chirp != 0, at a cost that does not grow with the number
/// of turns. The error is that of the rounded angle at both ends, divided by its rate of change there.
double integral_of_chirp(double phase, double omega, double chirp, double a, double b);

}  // namespace rheonet
