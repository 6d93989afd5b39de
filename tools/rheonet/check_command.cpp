#include <fmt/format.h>

#include "core/netlist/characters.hpp"
#include "core/result/run.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/demo_text.hpp"
#include "tools/rheonet/network_text.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

ExitStatus check_scene(const Arguments& arguments) {
  const ReadResult read = read_and_report(arguments.scene, options_of(arguments));
  if (!read.scene) return wrong_input;
  const Scene& scene = *read.scene;
  if (arguments.verbose) fmt::print("{}", describe_network(scene));
  try {
    const StartReport start = check(scene);
    if (arguments.verbose && !start.chosen.empty()) fmt::print("chosen at the start:\n");
    for (const std::string& value : start.chosen) {
      if (arguments.verbose) fmt::print("  {}\n", value);
    }
    for (const std::string& note : start.notes) fmt::print("note: {}\n", note);
  } catch (const SimulationError& error) {
    report(error, read.sources);
    return not_simulated;
  }
  if (arguments.verbose) fmt::print("{}", demo_text(read.presentation.demo));
  const std::string claims = scene.claims.empty() ? "" : ", " + count(scene.claims.size(), "claim", "claims");
  // A scene was read, so these are warnings.
  const std::string found = read.diagnostics.empty() ? "no mistake found" : "no error, but " + count(read.diagnostics.size(), "warning", "warnings");
  fmt::print("{}: {} ({}, {}{})\n", printable(arguments.scene), found,
             count(scene.elements.size(), "element", "elements"), count(scene.nodes.size() - 1, "node", "nodes"),
             claims);
  return done;
}

}  // namespace rheonet::tool
