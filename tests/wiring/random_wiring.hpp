#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/support/random.hpp"
#include "tests/wiring/tree.hpp"

namespace rheonet::test {

inline constexpr std::array<const char*, 6> law_types = {"spring", "dashpot", "slider", "sfm", "vfm", "cfm"};

std::vector<std::string> random_types(Random& random, std::size_t count);

/// Groups of alternating kinds, of two members or more.
Tree random_tree(Random& random, int leaves);

/// A connected graph in which every branch is on a path from the driven node to ground, and that cannot be reduced to a single branch by
/// merging series and parallel branches.
Graph random_graph(Random& random);

/// As `spring end-n1, slider n1-ground`.
std::string described(const Graph& graph, const std::vector<std::string>& types);

/// `ground`, `end`, `n1`, `n2`, ...
std::string node_name(int node);

}  // namespace rheonet::test
