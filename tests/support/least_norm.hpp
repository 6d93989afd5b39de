#pragma once

#include <vector>

#include "core/nonsmooth/boxed_forces.hpp"

namespace rheonet::test {

/// Whether no change of forces around loops, which leaves every balance as it is, lowers their norm within their boxes (node -1
/// closes loops as well): there are potentials phi with phi_a - phi_b <= f where f may grow, and >= f where f may fall, to `rounding`
/// [N]. Looks for the potentials as Bellman and Ford do.
bool of_least_norm(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& force, double rounding);

}  // namespace rheonet::test
