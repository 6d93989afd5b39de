#pragma once

#include <vector>

#include "core/network/parts.hpp"
#include "core/result/division.hpp"

namespace rheonet {

/// Cuts a scene up into `jobs` scenes; `job_of` says into which one each part goes. What belongs to no part goes to all at whose
/// nodes it stands if it is a motion, else to the first of those; what stands nowhere else, or beside nothing but the job `unasked`
/// (-1: there is none), to the first of all; a block that belongs to no part to none. Records and claims must each need parts of one
/// job alone, but for recorded forces: these are sums of what each job has of them.
std::vector<Excerpt> cut(const Scene& scene, const Parts& parts, const std::vector<int>& job_of, int jobs, int unasked);

/// The marked nodes and elements of a scene, with all of its records and claims, which need no others. Ends of marked elements are
/// marked; ground always stays.
Scene cut_out(const Scene& scene, const std::vector<char>& nodes, const std::vector<char>& elements);

}  // namespace rheonet
