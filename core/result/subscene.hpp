#pragma once

#include <vector>

#include "core/network/parts.hpp"
#include "core/result/partition.hpp"

namespace rheonet {

/// Divides a scene into `jobs` scenes; `job_of` gives the job of each part. A motion in no part goes to every job at its
/// node, another element in no part to the first of these. Job 0 is added if no job but `unasked` (-1: no such job) is at
/// the node. A block in no part goes nowhere. Each record or claim may need parts of one job only, except that a recorded
/// force is the sum of its terms in all jobs.
std::vector<Subscene> cut(const Scene& scene, const Parts& parts, const std::vector<int>& job_of, int jobs, int unasked);

/// The marked nodes and elements of a scene, with all of its records and claims, which must need no others. The ends of
/// marked elements must be marked; ground always stays.
Scene cut_out(const Scene& scene, const std::vector<char>& nodes, const std::vector<char>& elements);

}  // namespace rheonet
