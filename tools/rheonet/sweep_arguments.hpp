#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/rheonet/option_values.hpp"
#include "tools/rheonet/shard.hpp"

namespace rheonet::tool {

/// Options of `sweep`; 0 or empty if an option is not given.
struct SweepArguments {
  std::vector<std::string> vary;       ///< PATH=RANGE.
  std::string list;                    ///< CSV file of values.
  long random = 0, latin = 0, sobol = 0;  ///< Number of points drawn from the ranges.
  std::vector<std::string> correlate;  ///< PATH,PATH=COEFFICIENT.
  bool indices = false;                ///< Each point is a group of runs, for Sobol indices.
  std::optional<std::uint64_t> seed;   ///< Seed of the points.
  std::vector<std::string> measures;
  int jobs = 0;  ///< 0: one for each processor.
  bool resume = false;
  std::optional<Shard> shard;
  std::vector<std::string> merge;      ///< Files of shards.
  std::string statistics;              ///< JSON file.
  std::vector<double> quantiles;       ///< Probabilities, each above 0 and below 1.
  bool slurm = false, parallel = false;  ///< Print a script that runs the shards on that engine.
};

/// The numeric options of `sweep`, as they were typed.
struct SweepTexts {
  std::optional<std::string> random, latin, sobol, seed, jobs, shard;
  std::vector<std::string> quantiles;
};

/// Adds the options of `sweep` that no other command has.
void add_sweep_options(CLI::App* command, SweepArguments& sweep, SweepTexts& texts);

/// Converts the numeric options. Throws WrongCommandLine.
void read_sweep_texts(const SweepTexts& texts, SweepArguments& sweep);

}  // namespace rheonet::tool
