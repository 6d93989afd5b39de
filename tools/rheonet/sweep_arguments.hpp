#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/rheonet/option_values.hpp"
#include "tools/rheonet/shard.hpp"

namespace rheonet::tool {

/// Of `sweep`; 0 and empty where an option is not given.
struct SweepArguments {
  std::vector<std::string> vary;       ///< PATH=RANGE
  std::string list;                    ///< a CSV file of values
  long random = 0, latin = 0, sobol = 0;  ///< number of points that are drawn from the ranges
  std::vector<std::string> correlate;  ///< PATH,PATH=COEFFICIENT
  bool indices = false;                ///< each point is a group of runs from which Sobol indices follow
  std::optional<std::uint64_t> seed;   ///< of the points
  std::vector<std::string> measures;
  int jobs = 0;  ///< 0: one for each processor
  bool resume = false;
  std::optional<Shard> shard;
  std::vector<std::string> merge;      ///< files of shards
  std::string statistics;              ///< a JSON file
  std::vector<double> quantiles;       ///< each above 0 and below 1
  bool slurm = false, parallel = false;  ///< print how to run the shards on that engine
};

/// The options of `sweep` that hold numbers, as they were typed.
struct SweepTexts {
  std::optional<std::string> random, latin, sobol, seed, jobs, shard;
  std::vector<std::string> quantiles;
};

/// The options of `sweep` but for those that other commands have too.
void add_sweep_options(CLI::App* command, SweepArguments& sweep, SweepTexts& texts);

/// Throws WrongCommandLine.
void read_sweep_texts(const SweepTexts& texts, SweepArguments& sweep);

}  // namespace rheonet::tool
