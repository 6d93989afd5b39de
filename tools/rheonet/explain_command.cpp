#include <fmt/format.h>

#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/explanation.hpp"
#include "tools/rheonet/reading.hpp"

namespace rheonet::tool {

ExitStatus explain_scene(const Arguments& arguments) {
  const ReadResult read = read_and_report(arguments.scene, options_of(arguments));
  if (!read.scene) return wrong_input;
  try {
    const Explanation explanation = explain(*read.scene);
    fmt::print("{}", arguments.json ? to_json(*read.scene, explanation) : describe(*read.scene, arguments.scene, explanation));
  } catch (const SimulationError& error) {
    report(error, read.sources);
    return not_simulated;
  }
  return done;
}

}  // namespace rheonet::tool
