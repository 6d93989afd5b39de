#pragma once

#include <vector>

#include "core/solve/mode_cache.hpp"

namespace rheonet {

/// Contacts that the last step has closed, and that end here although they would be thrown back: sliders with a gauge.
///
/// Thrown back with velocity w and pressed with the acceleration a, a contact hops for 2 w/a, and after infinitely many hops, each
/// shorter by the coefficient of restitution e, it rests: 2 w/(a (1 - e)) later. It rests now if the error stays below a share
/// of `accuracy`: w relative to the largest velocity of the contact, and that time relative to the length of the run. The
/// acceleration must go on for that time. An elastic contact (e = 1) hops on for ever, unless something else takes energy: then e is
/// what the last hop has kept of its velocity.
///
/// `closing`: of each slider, the velocity with which its contact has closed before [m/s]; 0 if it has not.
struct Settling { double t, accuracy, length; };
std::vector<int> settling_contacts(System& system, const Tolerances& tolerances, const Settling& at, const std::vector<double>& y,
                                   const std::vector<double>& yp, std::vector<double>& closing);

}  // namespace rheonet
