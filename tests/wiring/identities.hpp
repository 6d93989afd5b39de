#pragma once

#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/judge.hpp"

namespace rheonet::test {

/// What holds for every network, whatever its solution: the energy account closes and nothing gives back what was
/// dissipated, friction stays within its bounds, and the same experiment seen differently (seen_differently.hpp) gives the
/// same trajectory. `refused` where the run ended early, and then so in every view.
Judgement check_identities(const Wiring& wiring);

/// What is left out changes nothing: each reduction by itself gives the trajectory that there is without any, of all records and of a
/// few of them.
Judgement check_reductions(const Wiring& wiring);

}  // namespace rheonet::test
