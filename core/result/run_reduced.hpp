#pragma once

#include <functional>

#include "core/network/series_parallel_reduction.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// Runs the reduced scene of a merging by `go`, and converts its rows to the records of the whole scene.
Summary run_reduced(const Scene& whole, const SeriesParallelReduction& reduction, const RunSettings& settings,
                   const std::function<Summary(const Scene&, const RunSettings&)>& go);

}  // namespace rheonet
