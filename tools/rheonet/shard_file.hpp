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

/// What the runs of a sweep follow from, as check sums (CRC-64): the files of the scene; the words of the command line and the file
/// of `--list`, with the version of the program.
struct SweepIdentity {
  std::string scene, command;

  SweepIdentity(const Arguments& arguments, const Sources& sources);
};

/// The file of a shard is the table of its runs, with a remark before it that says which shard of which sweep it is, and one behind
/// it that shows that it is complete.
std::string first_line(const Shard& shard, long runs, const SweepIdentity& identity);
std::string last_line(const Shard& shard);

/// Joins the files of all shards of a sweep of so many runs, whatever their order: `take` gets the header and then the rows, in
/// pieces that end with a line, and returns false to stop. False if it did so. What is wrong with the files instead: shards are
/// missing, there twice, not complete, or of another sweep. Nothing has been taken then unless a file is damaged.
std::variant<bool, NoVariation> merge_shards(const std::vector<std::string>& files, long runs, const SweepIdentity& identity,
                                             const std::string& header, const std::function<bool(const std::string& lines)>& take);

}  // namespace rheonet::tool
