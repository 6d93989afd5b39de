#pragma once

#include <functional>

#include "core/network/merge.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// Runs the reduced scene of a merging by `go`, and converts its rows to the records of the whole scene.
Summary run_merged(const Scene& whole, const Merging& merging, const RunSettings& settings,
                   const std::function<Summary(const Scene&, const RunSettings&)>& go);

}  // namespace rheonet
