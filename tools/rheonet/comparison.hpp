#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet::tool {

/// What is compared: for each scene the path of its record.
using Pairing = std::vector<std::string>;

/// Why scenes cannot be compared; "" if they can: the same domain, and runs that begin together and overlap.
std::string obstacle(const std::vector<Scene>& scenes);

/// Gives all scenes the output times of the first, as far as the shortest run goes.
void to_one_time_base(std::vector<Scene>& scenes);

/// Where among a scene's records each path is.
using Columns = std::unordered_map<std::string, std::size_t>;
Columns record_columns(const Scene& scene);

/// The paths that all scenes record, in the order of the first; `columns` are those of each.
std::vector<Pairing> shared_records(const Scene& first, const std::vector<Columns>& columns);

}  // namespace rheonet::tool
