#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/network/component.hpp"
#include "tests/support/random.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test {

/// Magnitudes of everything in a contract network: one length, time and force, from which each quantity has its own
/// typical value, so that no part of a network is negligible beside the others.
inline constexpr Scaling typical{.length = 0.0137, .time = 0.193, .force = 2.71};  // m | rad, s, N | N*m

/// How the values of an element are chosen from its declaration.
enum class Choice {
  fallbacks,  ///< typical values, defaults where there are any
  random,     ///< within the bounds, generic; initial values too
  lowest,     ///< pure numbers at their lower bound if that is included, else random
  highest,    ///< pure numbers at their upper bound if that is finite, else random
};
inline constexpr Choice choices[] = {Choice::fallbacks, Choice::random, Choice::lowest, Choice::highest};

/// One value for each declared parameter, accepted by the component's own check. Positions of nodes are for the network
/// to choose, so that initial values that are positions are not given. Some of those that may vary are not given: a signal takes
/// their place (see Surroundings::add_signals).
std::vector<double> draw_values(const Component& component, Domain domain, Choice choice, Random& random);

/// A signal of the given quantity: `kind` 0 to 5 chooses its shape. Positions and (if asked) everything else go without
/// jumps and start from 0.
inline constexpr int signal_kinds = 6;
Signal draw_signal(Quantity quantity, Domain domain, int kind, Random& random, bool jumps = true);

/// Values at which a limit of the component applies, by trying 0 and infinity wherever the bounds allow; empty if none.
std::vector<double> values_at_limit(const Component& component, std::size_t limit, const std::vector<double>& generic);

}  // namespace rheonet::test
