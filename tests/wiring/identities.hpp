#pragma once

#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/judge.hpp"

namespace rheonet::test {

/// Identities that hold for every network: the energy account closes, dissipated energy never decreases, friction stays within its bounds,
/// and the same experiment in another view (seen_differently.hpp) gives the same trajectory. The verdict is `refused` if the run ended early,
/// and it must end early in every view.
Judgement check_identities(const Wiring& wiring);

/// Reductions do not change the solution: each reduction alone gives the same trajectory as none, for all records and for a few of them.
Judgement check_reductions(const Wiring& wiring);

}  // namespace rheonet::test
