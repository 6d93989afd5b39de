#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "core/netlist/characters.hpp"
#include "core/result/run.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/summary.hpp"

namespace rheonet::tool {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

// The first signal asks the run to end; the handler is then gone, so that a second one ends the process.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A reader that goes away is then an error of write, with a message, instead of a silent death.
  std::signal(SIGPIPE, SIG_IGN);
}

// What the scene was read from must not be overwritten by its results.
bool is_source(const std::string& path, const Sources& sources) {
  std::error_code error;
  for (const Sources::File& file : sources.files) {
    if (fs::equivalent(path, file.path, error)) return true;
  }
  return false;
}

std::string rows_kept(const Output& output) {
  if (output.rows() == 0) return fmt::format("no row was written to {}", output.name());
  if (output.rows() == 1) return fmt::format("the one row up to there is in {}", output.name());
  return fmt::format("the {} rows up to there are in {}", output.rows(), output.name());
}

ExitStatus cannot_write(const Output& output, int error) {
  say("error: cannot write to {}: {}\n  {} rows were written before\n", output.name(), std::strerror(error),
      output.rows());
  return not_simulated;
}

}  // namespace

ExitStatus run_scene(const Arguments& arguments) {
  const ReadResult read = read_and_report(arguments);
  if (!read.scene) return wrong_input;
  if (arguments.output != "-" && is_source(arguments.output, read.sources)) {
    say("error: `--output {}` would overwrite the scene itself\n", printable(arguments.output));
    return wrong_input;
  }

  stop_on_signals();
  std::unique_ptr<Output> output;
  try {
    output = std::make_unique<Output>(arguments.output);
  } catch (const std::system_error& error) {
    say("error: cannot write to `{}`: {}\n", printable(arguments.output), error.code().message());
    return wrong_input;
  }

  // Rows that scroll by on the same terminal say enough.
  Progress progress(!arguments.quiet && !output->is_terminal());
  const auto on_progress = [&progress](double fraction) { progress.update(fraction); };
  try {
    const Summary summary = run(*read.scene, {.csv = output->file(), .interrupt = &stop, .progress = on_progress});
    progress.erase();
    if (const int error = output->close(); error != 0) return cannot_write(*output, error);
    if (!arguments.quiet) {
      say("{}: {:g} s to {:g} s\n{}", printable(arguments.scene), read.scene->start, read.scene->stop,
          describe(summary, output->rows(), output->name()));
    }
    return done;
  } catch (const SimulationError& error) {
    progress.erase();
    if (const int write_error = output->close(); write_error != 0) return cannot_write(*output, write_error);
    report(error, read.sources);
    say("  {}\n", rows_kept(*output));
    return not_simulated;
  }
}

}  // namespace rheonet::tool
