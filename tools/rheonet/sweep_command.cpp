#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "core/netlist/characters.hpp"
#include "core/result/cpu_time.hpp"
#include "core/result/csv.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/design.hpp"
#include "tools/rheonet/engine_script.hpp"
#include "tools/rheonet/in_order.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/shard_file.hpp"
#include "tools/rheonet/statistics.hpp"
#include "tools/rheonet/summary.hpp"
#include "tools/rheonet/sweep_resume.hpp"
#include "tools/rheonet/sweep_runs.hpp"
#include "tools/rheonet/sweep_table.hpp"

namespace rheonet::tool {
namespace {

ExitStatus refuse(const NoVariation& wrong) {
  say("error: {}\n", printable(wrong.message));
  if (!wrong.hint.empty()) say("  {}\n", printable(wrong.hint));
  return wrong_input;
}

/// The part of a sweep that one command simulates or joins, and its output.
class SweepJob {
 public:
  SweepJob(const Arguments& arguments, Sweep& sweep)
      : arguments_(arguments), options_(arguments.sweep), sweep_(sweep), shard_(options_.shard.value_or(Shard{})), runs_(sweep.design().runs()),
        first_(shard_.first(runs_)), behind_(shard_.end(runs_)), identity_(arguments, sweep.sources()) {
    if (!options_.statistics.empty()) statistics_.emplace(sweep.design(), sweep.table(), options_.quantiles);
  }

  ExitStatus go();

 private:
  std::variant<Left, NoVariation> left() const;
  bool take_left(const Left& left);
  bool write(const std::string& text, bool rows = true);
  /// Return false, after a message, if the command fails.
  bool simulate(const Left& left);
  bool merge();
  bool close();
  bool write_statistics();
  void summarize(const Left& left, double wall) const;
  /// The failed runs of the file.
  long failed() const { return earlier_failures_ + sweep_.failed(); }

  const Arguments& arguments_;
  const SweepArguments& options_;
  Sweep& sweep_;
  Shard shard_;
  long runs_, first_, behind_;  ///< Runs first_ .. behind_ - 1, counted from 0.
  SweepIdentity identity_;
  std::optional<Statistics> statistics_;
  std::unique_ptr<Output> statistics_output_;
  std::vector<MeasureStatistics> results_;
  std::unique_ptr<Output> output_;
  int jobs_ = 1;
  std::chrono::steady_clock::time_point flushed_;
  long earlier_failures_ = 0;  ///< Failed runs in merged shards, or in the file that is resumed.
};

/// The rows of an interrupted sweep. The first and the last run are simulated again: equal rows show that the scene and the program have not
/// changed.
std::variant<Left, NoVariation> SweepJob::left() const {
  const std::string& file = arguments_.output;
  if (file == "-") return NoVariation{"`--resume` needs the file to go on with", "-o sweep.csv"};
  auto found = what_is_left(file, {.remark = options_.shard ? first_line(shard_, runs_, identity_) : "",
                                   .header = sweep_.header(),
                                   .end = options_.shard ? last_line(shard_) : "",
                                   .first = first_,
                                   .behind = behind_,
                                   .key = [this](long run) { return sweep_.key(run); }});
  const Left* left = std::get_if<Left>(&found);
  if (!left || left->last == 0) return found;
  SpoolFile spool;
  Spool again(spool);
  const auto changed = [&](long run, long line) {
    return NoVariation{fmt::format("`--resume`: run {} comes out otherwise than in {}:{}: the scene, the command or the program has changed", run + 1,
                                   file, line),
                       "without `--resume` the file is written anew"};
  };
  sweep_.make(left->runs, left->runs + 1, again, false);
  if (const auto difference = first_difference(file, left->bytes, left->last, again)) return changed(left->runs, left->lines + 1 + *difference);
  if (left->runs == first_) return found;
  again.clear();
  sweep_.make(first_, first_ + 1, again, false);
  const std::size_t size = again.size();
  if (const auto difference = first_difference(file, left->head, size, again)) return changed(first_, (options_.shard ? 3 : 2) + *difference);
  return found;
}

/// Adds the existing rows to the statistics. Returns false, after a message, if they cannot be read.
bool SweepJob::take_left(const Left& left) {
  if (!statistics_ || left.bytes == 0) return true;
  std::ifstream in(arguments_.output, std::ios::binary);
  std::string line;
  std::getline(in, line);
  for (long k = 1; k < left.lines && std::getline(in, line); ++k) statistics_->take(line);
  if (in) return true;
  say("error: `{}` cannot be read: {}\n", printable(arguments_.output), std::strerror(errno));
  return false;
}

bool SweepJob::write(const std::string& text, bool rows) {
  constexpr std::chrono::milliseconds between_flushes{250};
  if (std::fwrite(text.data(), 1, text.size(), output_->file()) != text.size()) return false;
  if (const auto now = std::chrono::steady_clock::now(); now - flushed_ > between_flushes) {
    flushed_ = now;
    if (std::fflush(output_->file()) != 0) return false;
  }
  if (statistics_ && rows) statistics_->take(text);
  return true;
}

bool SweepJob::simulate(const Left& left) {
  const std::atomic<bool>& interrupted = end_on_signals();
  Progress progress(!arguments_.quiet && !output_->is_terminal());
  long end = left.runs;
  std::string failure;
  try {
    if (left.bytes > 0 || write((options_.shard ? first_line(shard_, runs_, identity_) : "") + sweep_.header(), false))
      end = do_in_order({.first = left.runs,
                         .end = behind_,
                         .jobs = jobs_,
                         .most_at_once = sweep_.most_at_once(),
                         .make = [&](long first, long behind, Spool& rows, const std::atomic<bool>& stop) { return sweep_.make(first, behind, rows, stop); },
                         .take = [&](const std::string& lines) { return write(lines); },
                         .go_on =
                             [&](long done) {
                               progress.update(static_cast<double>(done) / static_cast<double>(behind_ - left.runs));
                               return !interrupted.load();
                             }});
  } catch (const WriteError& error) {
    failure = error.what();
  }
  progress.erase();
  if (end == behind_ && options_.shard) write(last_line(shard_), false);
  if (!close()) return false;
  if (end == behind_) return true;
  if (failure.empty()) {
    say("error: the sweep was interrupted after {} of {} runs\n{}", end - first_, behind_ - first_, output_->kept("row"));
    interrupt_is_told();
  } else {
    say("error: {}\n{}", failure, output_->kept("row"));
  }
  if (arguments_.output != "-" && !table_format(arguments_.output)) say("  with `--resume` it goes on there\n");
  return false;
}

bool SweepJob::merge() {
  std::error_code failed;
  for (const std::string& file : options_.merge)
    if (std::filesystem::equivalent(file, arguments_.output, failed)) {
      say("error: `--output {}` would overwrite a shard\n", printable(file));
      output_->abandon();
      return false;
    }
  bool is_header = true;
  const auto take = [&](const std::string& lines) {
    if (!is_header)
      for (std::size_t begin = 0, end = 0; (end = lines.find('\n', begin)) != lines.npos; begin = end + 1)
        if (is_of_failed_run(std::string_view(lines).substr(begin, end + 1 - begin))) ++earlier_failures_;
    return write(lines, !std::exchange(is_header, false));
  };
  const auto merged = merge_shards(options_.merge, runs_, identity_, sweep_.header(), [this](long run) { return sweep_.key(run); }, take);
  const NoVariation* wrong = std::get_if<NoVariation>(&merged);
  if (wrong) refuse(*wrong);
  if (wrong && is_header) output_->abandon();
  return close() && !wrong;
}

bool SweepJob::close() {
  const int error = output_->close();
  if (error != 0) say("error: cannot write to {}: {}\n{}", output_->name(), std::strerror(error), output_->kept("row"));
  return error == 0;
}

bool SweepJob::write_statistics() {
  results_ = statistics_->results();
  const SweepArguments& o = options_;
  nlohmann::ordered_json head{{"program", "rheonet " RHEONET_VERSION}, {"scene", arguments_.scene}, {"title", sweep_.title()}, {"runs", runs_}, {"failed", statistics_->failed()}};
  for (const auto& [way, count] : {std::pair{"random", o.random}, {"latin", o.latin}, {"sobol", o.sobol}})
    if (count > 0) head["points"] = {{"kind", way}, {"count", count}, {"seed", o.seed.value_or(1)}};
  return write_all(*statistics_output_, as_json(std::move(head), results_, sweep_.design(), sweep_.table()).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n', "line");
}

void SweepJob::summarize(const Left& left, double wall) const {
  const bool goes_on = left.runs > first_;
  const std::string failures = failed() == 0 ? "" : fmt::format(", of {} failed: `error` says why", goes_on ? fmt::format("all {} runs {}", behind_ - first_, failed()) : fmt::format("which {}", failed()));
  if (!options_.merge.empty()) {
    say("{}: {} runs from {} shard{}{}\n", printable(arguments_.scene), runs_, options_.merge.size(), options_.merge.size() == 1 ? "" : "s", failures);
    say("  rows         {:>12}  to {}\n", output_->rows(), output_->name());
  } else {
    const double cpu = process_cpu_seconds(), simulating = sweep_.simulating();
    const long done = behind_ - left.runs;
    say("{}: {} run{}{}{}{}\n", printable(arguments_.scene), done, done == 1 ? "" : "s",
        options_.shard ? fmt::format(" of shard {}/{}", shard_.number, shard_.of) : "",
        goes_on ? fmt::format(" more, from run {} on", left.runs + 1) : "", failures);
    say("  rows         {:>12}  to {}\n", output_->rows() - (options_.shard ? 2 : 0), output_->name());
    say("  wall time    {:>12}  {} at a time\n", in_time_units(wall), jobs_);
    say("  CPU time     {:>12}  {} in the simulations\n", in_time_units(cpu), in_time_units(simulating));
  }
  if (statistics_) say("{}", in_words(results_, sweep_.design(), sweep_.table()));
}

ExitStatus SweepJob::go() {
  Left left;
  left.runs = first_;
  if (options_.resume) {
    auto found = this->left();
    if (const auto* wrong = std::get_if<NoVariation>(&found)) return refuse(*wrong);
    left = std::get<Left>(std::move(found));
    earlier_failures_ = left.failed - sweep_.failed();  // the run that was simulated to check the file is simulated again
    if (!take_left(left)) return wrong_input;
  }
  if (statistics_) statistics_output_ = open_output(options_.statistics, Output::Writing::complete);
  if (statistics_ && !statistics_output_) return wrong_input;
  const bool as_it_comes = options_.merge.empty() && !table_format(arguments_.output);
  output_ = as_it_comes ? open_output_after(arguments_.output, left.bytes, left.lines)
                        : open_table(arguments_.output, Output::Writing::complete, sweep_.layout());
  if (!output_ || write_to_one_file({{"--output", arguments_.output}, {"--statistics", options_.statistics}})) return wrong_input;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  jobs_ = options_.jobs > 0 ? options_.jobs : processors;
  const auto start = std::chrono::steady_clock::now();
  if (!options_.merge.empty()) {
    if (!merge()) return wrong_input;
  } else if (!simulate(left)) {
    return not_simulated;
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (statistics_ && !write_statistics()) return not_simulated;
  if (!arguments_.quiet) summarize(left, wall);
  return failed() > 0 ? not_simulated : done;
}

/// The error of options that exclude each other.
std::optional<NoVariation> contradiction(const Arguments& arguments, const Design& design) {
  const SweepArguments& s = arguments.sweep;
  const bool merges = !s.merge.empty(), script = s.slurm || s.parallel;
  const auto exclude = [](const char* one, const char* other) { return NoVariation{fmt::format("`{}` and `{}` exclude each other", one, other), ""}; };
  if (s.shard && merges) return exclude("--shard", "--merge");
  if (s.resume && merges) return exclude("--resume", "--merge");
  if (s.slurm && s.parallel) return exclude("--slurm", "--parallel");
  const char* const engine = s.slurm ? "--slurm" : "--parallel";
  if (const TableFormat* format = table_format(arguments.output); format && (s.resume || s.shard))
    return NoVariation{fmt::format("`{}` writes CSV, not {}", s.shard ? "--shard" : "--resume", format->ending),
                       fmt::format("write the shards, or a single one (`--shard 1/1`), as .csv; `--merge` makes {} of them", format->ending)};
  if (script && s.shard) return exclude(engine, "--shard");
  if (script && merges) return exclude(engine, "--merge");
  if (script && arguments.output == "-") return NoVariation{fmt::format("`{}` needs the file for the rows of the whole sweep", engine), "-o sweep.csv"};
  if (s.statistics.empty()) return {};
  if (s.shard) return NoVariation{"`--statistics` is of all runs, not of a shard", "give it to `--merge`"};
  if (s.measures.empty()) return NoVariation{"`--statistics` is of measures, and none is asked for", "--measure 'max(k1.force)'"};
  if (!design.has_distribution()) return NoVariation{"a grid of values has no distribution for `--statistics`", "draw points: --random 1000"};
  return {};
}

}  // namespace

ExitStatus sweep_scene(const Arguments& arguments) {
  auto design = Design::read(arguments.sweep);
  if (const auto* wrong = std::get_if<NoVariation>(&design)) return refuse(*wrong);
  if (const auto wrong = contradiction(arguments, std::get<Design>(design))) return refuse(*wrong);
  auto table = SweepTable::make(std::get<Design>(design).paths(), arguments.sweep.measures);
  if (const auto* wrong = std::get_if<NoVariation>(&table)) return refuse(*wrong);
  Sweep sweep(arguments, std::get<Design>(std::move(design)), std::get<SweepTable>(std::move(table)));
  if (!sweep.begin()) return wrong_input;
  if (is_source(arguments.output, "--output", sweep.sources()) || !can_be_table(arguments.output, "--output", true)) return wrong_input;
  const SweepArguments& options = arguments.sweep;
  if (is_source(options.statistics, "--statistics", sweep.sources()) || !can_be_json(options.statistics, "--statistics")) return wrong_input;
  for (const auto& [option, file] : {std::pair{"--output", &arguments.output}, {"--statistics", &options.statistics}}) {
    std::error_code failed;
    if (options.list.empty() || !std::filesystem::equivalent(options.list, *file, failed)) continue;
    say("error: `{} {}` would overwrite the list of values\n", option, printable(*file));
    return wrong_input;
  }
  if (options.slurm || options.parallel) {
    const Division division = divide_sweep(sweep, options.slurm ? slurm : gnu_parallel);
    fmt::print("{}", options.slurm ? slurm_script(arguments, division) : parallel_script(arguments, division));
    if (!arguments.quiet)
      say("{}: {} runs in {} shard{} of about {} of CPU time\n", printable(arguments.scene), sweep.design().runs(), division.shards,
          division.shards == 1 ? "" : "s", in_time_units(division.shard_seconds));
    return done;
  }
  return SweepJob(arguments, sweep).go();
}

}  // namespace rheonet::tool
