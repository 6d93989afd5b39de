#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/shard.hpp"
#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// Check sums (CRC-64) of everything that determines the runs of a sweep. `scene`: the files of the scene. `command`: the command line,
/// the file of `--list` and the version of the program.
struct SweepIdentity {
  std::string scene, command;

  SweepIdentity(const Arguments& arguments, const Sources& sources);
};

/// The file of a shard is the table of its runs between two remarks: the first identifies the sweep and the shard, the last shows that the
/// file is complete.
std::string first_line(const Shard& shard, long runs, const SweepIdentity& identity);
std::string last_line(const Shard& shard);

/// Joins the files of all shards of a sweep, given in any order. `key` gives the cells that each row of a run, counted from 0, begins with. `take` gets the header and then the rows, in pieces of complete lines, and
/// returns false to stop; the result is false if it did. Returns a NoVariation if a shard is missing, duplicate, incomplete or of another
/// sweep; `take` has not been called then, unless a file is damaged.
std::variant<bool, NoVariation> merge_shards(const std::vector<std::string>& files, long runs, const SweepIdentity& identity,
                                             const std::string& header, const std::function<std::string(long run)>& key,
                                             const std::function<bool(const std::string& lines)>& take);

}  // namespace rheonet::tool
