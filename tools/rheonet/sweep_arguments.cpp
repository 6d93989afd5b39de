#include "tools/rheonet/sweep_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace rheonet::tool {

void add_sweep_options(CLI::App* command, SweepArguments& sweep, SweepTexts& texts) {
  add_list(command, "--vary", sweep.vary, "vary the value at this path; may be repeated", "PATH=RANGE", false);
  command->add_option("--list", sweep.list, "CSV file of values, one run per row")->type_name("FILE");
  command->add_option("--random", texts.random, "draw N random points from the ranges")->type_name("N");
  command->add_option("--latin", texts.latin, "draw N points as a Latin hypercube, which covers each range evenly")->type_name("N");
  command->add_option("--sobol", texts.sobol, "draw N scrambled Sobol points, which cover all ranges together evenly")->type_name("N");
  add_list(command, "--correlate", sweep.correlate, "coefficient of correlation of two ranges; may be repeated", "PATH,PATH=R", false);
  command->add_flag("--sobol-indices", sweep.indices, "make a group of runs of each point, from which Sobol indices follow");
  command->add_option("--seed", texts.seed, "seed of the points (default 1)")->type_name("S");
  add_list(command, "--measure", sweep.measures, "write this measure of each run instead of its rows; may be repeated", "MEASURE", false);
  command->add_option("--statistics", sweep.statistics, "JSON file for mean, deviation, quantiles and Sobol indices of the measures")
      ->type_name("FILE");
  add_list(command, "--quantiles", texts.quantiles, "quantiles for --statistics (default 0.05,0.25,0.5,0.75,0.95)", "Q,...");
  command->add_option("--jobs", texts.jobs, "number of parallel runs (default: the number of processors)")->type_name("J");
  command->add_flag("--resume", sweep.resume, "continue an interrupted sweep into the same file");
  command->add_option("--shard", texts.shard, "simulate the K-th of N parts of the sweep")->type_name("K/N");
  add_list(command, "--merge", sweep.merge, "join these files of shards instead of simulating", "FILE ...", false);
  command->add_flag("--slurm", sweep.slurm, "print a Slurm script that simulates the sweep as a job array");
  command->add_flag("--parallel", sweep.parallel, "print a script that simulates the sweep with GNU parallel, on many hosts if asked to");
}

void read_sweep_texts(const SweepTexts& texts, SweepArguments& sweep) {
  constexpr int most_drawn = 10'000'000;
  if (texts.random) sweep.random = read_whole("--random", *texts.random, 1, most_drawn);
  if (texts.latin) sweep.latin = read_whole("--latin", *texts.latin, 1, most_drawn);
  if (texts.sobol) sweep.sobol = read_whole("--sobol", *texts.sobol, 1, most_drawn);
  if (texts.seed) sweep.seed = static_cast<std::uint64_t>(read_whole("--seed", *texts.seed, 0, 1'000'000'000));
  if (texts.jobs) sweep.jobs = read_whole("--jobs", *texts.jobs, 1, 1024);
  if (texts.shard) sweep.shard = read_shard(*texts.shard);
  for (const std::string& text : texts.quantiles) {
    const double quantile = read_number("--quantiles", text);
    if (!(quantile > 0 && quantile < 1))
      throw WrongCommandLine{fmt::format("`--quantiles` takes numbers above 0 and below 1, not `{}`", text), ""};
    sweep.quantiles.push_back(quantile);
  }
  if (!sweep.quantiles.empty() && sweep.statistics.empty())
    throw WrongCommandLine{"`--quantiles` is for `--statistics FILE.json`", ""};
  if (sweep.quantiles.empty()) sweep.quantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
  std::sort(sweep.quantiles.begin(), sweep.quantiles.end());
}

}  // namespace rheonet::tool
