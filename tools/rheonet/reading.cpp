#include "tools/rheonet/reading.hpp"

#include <filesystem>
#include <system_error>

#include "core/netlist/characters.hpp"
#include "core/network/advice.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/library.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

ReadOptions options_of(const Arguments& arguments) {
  return {.overrides = arguments.overrides,
          .origins = {},
          .accuracy = arguments.accuracy,
          .without = arguments.without,
          .only = arguments.only,
          .keep = arguments.keep,
          .model_folders = library_folders()};
}

namespace {

void add_advice(ReadResult& result) {
  if (!result.scene) return;
  const std::vector<Diagnostic> advice = advice_on(*result.scene);
  result.diagnostics.insert(result.diagnostics.end(), advice.begin(), advice.end());
}

}  // namespace

ReadResult read_text(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions& options,
                     const std::vector<const FileOffer*>& offers) {
  ReadResult result = read_offered_text(text, name, folder, declarations(), options, offers);
  add_advice(result);
  return result;
}

void report_all(ReadResult& result) {
  add_advice(result);
  int errors = 0;
  for (const Diagnostic& diagnostic : result.diagnostics) {
    std::string text = format(diagnostic, result.sources);
    if (!text.ends_with('\n')) text += '\n';
    say("{}", text);
    if (diagnostic.severity == Severity::error) ++errors;
  }
  if (errors > 1) say("{} errors\n", errors);
}

ReadResult read_and_report(const std::string& scene, const ReadOptions& options) {
  ReadResult result = read_scene(scene, declarations(), options);
  report_all(result);
  return result;
}

bool is_source(const std::string& path, const char* option, const Sources& sources) {
  std::error_code error;
  for (const Sources::File& file : sources.files) {
    if (path == "-" || !std::filesystem::equivalent(path, file.path, error)) continue;
    const char* const what = file.role == Sources::Role::table      ? "a table that the scene reads"
                             : file.role == Sources::Role::included ? "a file that the scene includes"
                                                                    : "the scene itself";
    say("error: `{} {}` would overwrite {}\n", option, printable(path), what);
    return true;
  }
  return false;
}

void report(const SimulationError& error, const Sources& sources) {
  if (error.spot) {
    say("{}\n", format({.severity = Severity::error, .spot = *error.spot, .message = error.what(), .hint = {}}, sources));
  } else {
    say("error: {}\n", error.what());
  }
  interrupt_is_told();
}

}  // namespace rheonet::tool
