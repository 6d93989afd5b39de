#include "tools/rheonet/engine_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/result/cpu_time.hpp"

namespace rheonet::tool {
namespace {

/// A word, quoted for a shell if necessary.
std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || std::string_view("-_./:=,+").find(static_cast<char>(c)) != std::string_view::npos; };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

/// The command that simulates this sweep, without the options for the shard and the output.
std::string command_of(const Arguments& arguments) {
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  std::string text = "\"${RHEONET:-" + (failed ? "rheonet" : program.string()) + "}\" sweep " + quoted(arguments.scene);
  const auto add = [&text](const char* option, const std::string& value) { text += fmt::format(" {} {}", option, quoted(value)); };
  const auto add_each = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) add(option, value);
  };
  const SweepArguments& sweep = arguments.sweep;
  add_each("--set", arguments.overrides);
  add_each("--without", arguments.without);
  if (arguments.only) add_each("--only", arguments.only->empty() ? std::vector<std::string>{"none"} : *arguments.only);
  add_each("--keep", arguments.keep);
  if (arguments.accuracy) add("--accuracy", fmt::format("{}", *arguments.accuracy));
  if (!sweep.list.empty()) add("--list", sweep.list);
  add_each("--vary", sweep.vary);
  for (const auto& [option, count] : {std::pair{"--random", sweep.random}, {"--latin", sweep.latin}, {"--sobol", sweep.sobol}})
    if (count > 0) add(option, std::to_string(count));
  if (sweep.seed) add("--seed", std::to_string(*sweep.seed));
  add_each("--correlate", sweep.correlate);
  if (sweep.indices) text += " --sobol-indices";
  add_each("--measure", sweep.measures);
  return text;
}

/// "results/sweep.csv" -> "results/sweep.shard-".
std::string shard_stem(const std::string& output) { return std::filesystem::path(output).replace_extension().string() + ".shard-"; }

/// The command that simulates one shard. `number` is the shell expression for the number of the shard.
std::string simulate_command(const Arguments& arguments, const Division& division, const std::string& number) {
  return fmt::format("{} --shard {}/{} --resume --jobs 1 -q -o {}{}.csv", command_of(arguments), number, division.shards,
                     quoted(shard_stem(arguments.output)), number);
}

std::string merge_command(const Arguments& arguments, const Division& division) {
  std::string text = command_of(arguments);
  if (!arguments.sweep.statistics.empty()) {
    text += " --statistics " + quoted(arguments.sweep.statistics) + " --quantiles ";
    for (std::size_t k = 0; k < arguments.sweep.quantiles.size(); ++k) text += fmt::format("{}{}", k == 0 ? "" : ",", arguments.sweep.quantiles[k]);
  }
  const std::string numbers = division.shards == 1 ? "1" : fmt::format("{{1..{}}}", division.shards);
  return fmt::format("{} -o {} --merge {}{}.csv", text, quoted(arguments.output), quoted(shard_stem(arguments.output)), numbers);
}

}  // namespace

Division divide_sweep(Sweep& sweep, const Engine& engine) {
  constexpr long most_shards_of_array = 1000, most_measured = 50;
  constexpr double least_share = 100, longest_measurement = 2;  // s
  const long runs = sweep.design().runs(), measured = std::min(runs, most_measured);
  const double start = thread_cpu_seconds();
  double spent = 0;
  long done = 0;
  SpoolFile file;
  for (; done < measured && spent < longest_measurement; ++done) {
    Spool rows(file);
    const long run = runs * (2 * done + 1) / (2 * measured);
    sweep.make(run, run + 1, rows, false);
    spent = thread_cpu_seconds() - start;
  }
  const double all = spent / static_cast<double>(done) * static_cast<double>(runs);
  const double worthwhile = std::min(all / (least_share * engine.task_cost), static_cast<double>(most_shards_of_array));
  const long shards = std::clamp(static_cast<long>(worthwhile), 1L, runs);
  return {shards, all / static_cast<double>(shards)};
}

std::string slurm_script(const Arguments& arguments, const Division& division) {
  return fmt::format(R"(#!/bin/bash
#SBATCH --job-name=rheonet
#SBATCH --array=1-{0}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output={1}%a.log
# Submit this file with `sbatch FILE`, from a folder that all hosts share. Each task simulates a shard of the sweep. A task that
# was killed goes on where it was when it is queued again. After all tasks, join the shards: `bash FILE merge`, or, to queue that
# too, `sbatch --array=1 --dependency=afterany:JOB FILE merge`.
set -eu
if [ "${{1:-}}" = merge ]; then
  exec {2}
fi
exec {3}
)",
                     division.shards, shard_stem(arguments.output), merge_command(arguments, division),
                     simulate_command(arguments, division, "\"$SLURM_ARRAY_TASK_ID\""));
}

std::string parallel_script(const Arguments& arguments, const Division& division) {
  const std::string numbers = division.shards == 1 ? "1" : fmt::format("{{1..{}}}", division.shards);
  return fmt::format(R"(#!/bin/bash
# Run this file with `bash FILE`; on hosts that share this folder, with `bash FILE --sshlogin host1,host2`, or any other options of
# GNU parallel. Run it again after an interrupt: each shard goes on where it was.
set -u
parallel --retries 3 --workdir "$PWD" -I '{{shard}}' "$@" {0} ::: {1}
exec {2}
)",
                     quoted(simulate_command(arguments, division, "{shard}")), numbers, merge_command(arguments, division));
}

}  // namespace rheonet::tool
