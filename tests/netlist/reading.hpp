#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/netlist/read.hpp"
#include "tests/support/program.hpp"

namespace rheonet::test {

/// Reads a scene, called scene.toml, with the fake declarations. A line break at its very start is taken off (raw
/// strings begin on a line of their own), and a [simulate] that stops at 1 s is added if it has none.
ReadResult read(const std::string& netlist, const ReadOptions& options = {},
                const std::filesystem::path& folder = "no-such-folder");

/// All that a user would see, each message ending in a line break; "" for a sound scene.
std::string messages(const ReadResult& result);

/// The scene of a sound netlist; fails the test with its messages otherwise.
Scene sound_scene(const std::string& netlist, const ReadOptions& options = {},
               const std::filesystem::path& folder = "no-such-folder");

struct BadNetlist {
  const char* what;
  const char* netlist;   ///< begins with a line break, as do the messages
  const char* messages;  ///< exactly
  std::vector<std::string> overrides = {};
};

/// Checks that each is refused with exactly its messages.
void check_all(const std::vector<BadNetlist>& netlists);

}  // namespace rheonet::test
