#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/netlist/characters.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/design.hpp"
#include "tools/rheonet/in_order.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/summary.hpp"
#include "tools/rheonet/sweep_resume.hpp"
#include "tools/rheonet/sweep_table.hpp"

namespace rheonet::tool {
namespace {

double process_cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ExitStatus refuse(const NoVariation& wrong) {
  say("error: {}\n", printable(wrong.message));
  if (!wrong.hint.empty()) say("  {}\n", printable(wrong.hint));
  return wrong_input;
}

bool is_error(const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; }

/// The first mistake of a scene, in a line.
std::string first_mistake(const ReadResult& read) {
  const auto& all = read.diagnostics;
  const auto count = std::count_if(all.begin(), all.end(), is_error);
  const Diagnostic& first = *std::find_if(all.begin(), all.end(), is_error);
  std::string text = first.message;
  if (!first.spot.on_command_line())
    text = fmt::format("{}:{}:{}: {}", read.sources.files[static_cast<std::size_t>(first.spot.file)].path.string(),
                       first.spot.line, first.spot.column, text);
  return count > 1 ? fmt::format("{} (and {} more mistakes)", text, count - 1) : text;
}

/// Makes the rows of each run.
class Sweep {
 public:
  Sweep(const Arguments& arguments, Design design, SweepTable table)
      : arguments_(arguments), design_(std::move(design)), table_(std::move(table)) {}

  const Design& design() const { return design_; }
  std::string header() const { return table_.header({design_.point(0), design_.point(design_.runs() - 1)}); }
  std::string key(long run) const { return SweepTable::key(run + 1, design_.point(run)); }

  /// Reads the first run, with a report if that or every other is refused. False: nothing can be simulated. Then the columns of
  /// rows without measures are known.
  bool begin();

  /// On any thread.
  std::optional<std::string> make(long run, const std::atomic<bool>& stop);

  const Sources& sources() const { return first_.sources; }
  long failed() const { return failed_; }
  double simulating() const { return simulating_; }

 private:
  ReadResult read(const std::vector<std::string>& values);
  /// Whether what is wrong with a run is wrong with every run: the path of a value, or the scene itself.
  bool is_wrong_for_all(const ReadResult& refused);

  const Arguments& arguments_;
  Design design_;
  SweepTable table_;
  FileCache cache_;
  ReadResult first_;
  std::atomic<long> failed_ = 0;
  std::atomic<double> simulating_ = 0;  ///< CPU time of the simulations [s]
};

ReadResult Sweep::read(const std::vector<std::string>& values) {
  ReadOptions options = options_of(arguments_);
  options.claims = false;  // they are about the scene as it stands
  options.cache = &cache_;
  options.measures = table_.record_measures();
  for (std::size_t k = 0; k < values.size(); ++k)
    options.overrides.push_back(design_.paths()[k] + '=' + values[k]);
  if (!values.empty()) options.origins = design_.origins();
  return read_scene(arguments_.scene, declarations(), options);
}

bool Sweep::is_wrong_for_all(const ReadResult& refused) {
  const std::size_t set = arguments_.overrides.size();
  const ReadResult plain = read({});
  for (const Diagnostic& mistake : refused.diagnostics) {
    if (!is_error(mistake)) continue;
    if (mistake.spot.on_command_line()) {
      // Lines of the command line: those of `--set`, of what is varied, of measures.
      const std::size_t line = static_cast<std::size_t>(mistake.spot.line) - 1;
      if (line < set || line >= set + design_.paths().size()) return true;
      const std::size_t path = count_characters(design_.origins()[line - set] + design_.paths()[line - set]);
      if (static_cast<std::size_t>(mistake.spot.column) <= path) return true;
      continue;
    }
    const auto same = [&](const Diagnostic& other) {
      return is_error(other) && other.message == mistake.message && other.spot.file == mistake.spot.file &&
             other.spot.line == mistake.spot.line && other.spot.column == mistake.spot.column;
    };
    if (std::any_of(plain.diagnostics.begin(), plain.diagnostics.end(), same)) return true;
  }
  return false;
}

bool Sweep::begin() {
  first_ = read(design_.point(0));
  if (!first_.scene && is_wrong_for_all(first_)) {
    report_all(first_);
    return false;
  }
  if (first_.scene) {
    report_all(first_);
    table_.set_scene(*first_.scene);
    return true;
  }
  for (long run = 1; run < design_.runs(); ++run)
    if (const ReadResult other = read(design_.point(run)); other.scene) {
      table_.set_scene(*other.scene);
      return true;
    }
  if (table_.measures()) return true;  // each row says why it failed
  report_all(first_);
  return false;
}

std::optional<std::string> Sweep::make(long run, const std::atomic<bool>& stop) {
  const std::string begin = key(run);
  const ReadResult read = this->read(design_.point(run));
  try {
    if (!read.scene) throw SimulationError(first_mistake(read));
    table_.check_records(read.scene->records);
    std::string text;
    RunSettings settings;
    settings.interrupt = &stop;
    settings.account = table_.needs_account();
    if (!table_.measures())
      settings.row = [&](double time, const std::vector<double>& values) { SweepTable::append(text, begin, time, values); };
    const Summary summary = rheonet::run(*read.scene, settings);
    simulating_ += summary.cpu_seconds;
    return table_.measures() ? table_.row(begin, summary) : text;
  } catch (const SimulationError& error) {
    if (stop) return {};
    ++failed_;
    return table_.failed(begin, error.what());
  }
}

/// What was left by an interrupted sweep. Its last run is simulated again: that it comes out the same tells that the scene
/// and the program are still those.
std::variant<Left, NoVariation> resume(Sweep& sweep, const std::string& file) {
  if (file == "-") return NoVariation{"`--resume` needs the file to go on with", "-o sweep.csv"};
  auto found = what_is_left(file, sweep.header(), sweep.design().runs(), [&](long run) { return sweep.key(run); });
  const Left* left = std::get_if<Left>(&found);
  if (!left || left->last.empty()) return found;
  const auto again = sweep.make(left->runs, false);
  if (again && again->starts_with(left->last)) return found;
  const auto differ = std::mismatch(left->last.begin(), left->last.end(), again->begin(), again->end());
  const auto line = left->lines + 1 + std::count(left->last.begin(), differ.first, '\n');
  return NoVariation{fmt::format("`--resume`: run {} comes out otherwise than in {}:{}: the scene, the command or the program "
                                 "has changed",
                                 left->runs + 1, file, line),
                     "without `--resume` the file is written anew"};
}

void summarize(const Sweep& sweep, const Arguments& arguments, long first, long end, int jobs, double wall,
               const Output& output) {
  const double cpu = process_cpu_seconds(), simulating = sweep.simulating();
  say("{}: {} run{}{}{}\n", printable(arguments.scene), end - first, end - first == 1 ? "" : "s", first > 0 ? fmt::format(" more, from run {} on", first + 1) : "",
      sweep.failed() > 0 ? fmt::format(", of which {} failed: `error` says why", sweep.failed()) : "");
  say("  rows         {:>12}  to {}\n", output.rows(), output.name());
  say("  wall time    {:>12}  {} at a time\n", in_time_units(wall), jobs);
  say("  CPU time     {:>12}  {} in the simulations\n", in_time_units(cpu), in_time_units(simulating));
}

}  // namespace

ExitStatus sweep_scene(const Arguments& arguments) {
  auto design = Design::read(arguments.sweep);
  if (const auto* wrong = std::get_if<NoVariation>(&design)) return refuse(*wrong);
  auto table = SweepTable::make(std::get<Design>(design).paths(), arguments.sweep.measures);
  if (const auto* wrong = std::get_if<NoVariation>(&table)) return refuse(*wrong);
  Sweep sweep(arguments, std::get<Design>(std::move(design)), std::get<SweepTable>(std::move(table)));
  if (!sweep.begin()) return wrong_input;
  if (is_source(arguments.output, "--output", sweep.sources()) || !can_be_table(arguments.output, "--output")) return wrong_input;

  const std::atomic<bool>& interrupted = end_on_signals();
  Left left;
  if (arguments.sweep.resume) {
    auto found = resume(sweep, arguments.output);
    if (const auto* wrong = std::get_if<NoVariation>(&found)) return refuse(*wrong);
    left = std::get<Left>(std::move(found));
  }
  const std::unique_ptr<Output> output = open_output_after(arguments.output, left.bytes, left.lines);
  if (!output) return wrong_input;

  const long runs = sweep.design().runs();
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int jobs = arguments.sweep.jobs > 0 ? arguments.sweep.jobs : processors;
  const auto write = [&output](const std::string& text) {
    return std::fwrite(text.data(), 1, text.size(), output->file()) == text.size() && std::fflush(output->file()) == 0;
  };
  Progress progress(!arguments.quiet && !output->is_terminal());
  const auto start = std::chrono::steady_clock::now();
  long end = left.runs;
  if (left.bytes > 0 || write(sweep.header()))
    end = do_in_order({.first = left.runs,
                       .end = runs,
                       .jobs = jobs,
                       .make = [&](long run, const std::atomic<bool>& stop) { return sweep.make(run, stop); },
                       .take = write,
                       .go_on =
                           [&](long done) {
                             progress.update(static_cast<double>(done) / static_cast<double>(runs - left.runs));
                             return !interrupted.load();
                           }});
  progress.erase();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const int error = output->close();
  if (error != 0) {
    say("error: cannot write to {}: {}\n{}", output->name(), std::strerror(error), output->kept("row"));
    return not_simulated;
  }
  if (end < runs) {
    say("error: the sweep was interrupted after {} of {} runs\n{}", end, runs, output->kept("row"));
    interrupt_is_told();
    if (arguments.output != "-") say("  with `--resume` it goes on there\n");
    return not_simulated;
  }
  if (!arguments.quiet) summarize(sweep, arguments, left.runs, end, jobs, wall, *output);
  return sweep.failed() > 0 ? not_simulated : done;
}

}  // namespace rheonet::tool
