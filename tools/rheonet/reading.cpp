#include "tools/rheonet/reading.hpp"

#include "core/network/component.hpp"
#include "tools/rheonet/library.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

ReadResult read_and_report(const Arguments& arguments) {
  ReadResult result =
      read_scene(arguments.scene, declarations(),
                 {.overrides = arguments.overrides, .accuracy = arguments.accuracy, .model_folders = library_folders()});
  int errors = 0;
  for (const Diagnostic& diagnostic : result.diagnostics) {
    std::string text = format(diagnostic, result.sources);
    if (!text.ends_with('\n')) text += '\n';
    say("{}", text);
    if (diagnostic.severity == Severity::error) ++errors;
  }
  if (errors > 1) say("{} errors\n", errors);
  return result;
}

void report(const SimulationError& error, const Sources& sources) {
  if (error.spot) {
    say("{}\n", format({.severity = Severity::error, .spot = *error.spot, .message = error.what(), .hint = {}}, sources));
  } else {
    say("error: {}\n", error.what());
  }
}

}  // namespace rheonet::tool
