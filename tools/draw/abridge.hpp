#pragma once

#include "tools/draw/network_tree.hpp"

namespace rheonet::draw {

/// Leaves out of parts that are the same many times, in a row or in parallel, all but the first two and the last. The
/// same means the same types, wired alike, whatever their values. How many elements are left out.
std::size_t abridge(Forest& forest, const Scene& scene);

}  // namespace rheonet::draw
