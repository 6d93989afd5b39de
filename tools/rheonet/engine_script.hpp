#pragma once

#include <string>

#include "tools/rheonet/sweep_runs.hpp"

namespace rheonet::tool {

/// A program that starts many tasks, on one host or on many.
struct Engine {
  const char* option;  ///< of `sweep`
  double task_cost;    ///< CPU time that the engine takes to start and end an empty task [s]
};
inline constexpr Engine slurm{"--slurm", 0.5}, gnu_parallel{"--parallel", 0.012};

/// How a sweep is divided.
struct Division {
  long shards = 1;
  double shard_seconds = 0;  ///< CPU time of each, estimated
};

/// Measures some runs, and divides the sweep so that each shard takes at least 100 times the cost of a task of the engine. At most
/// 1000 shards, which Slurm takes in one job array as Debian configures it.
Division divide_sweep(Sweep& sweep, const Engine& engine);

/// A Bash script that simulates the shards as a job array, and joins them if it is called with the word `merge`.
std::string slurm_script(const Arguments& arguments, const Division& division);

/// A Bash script that simulates the shards and then joins them; its words are further options of GNU parallel, such as hosts.
std::string parallel_script(const Arguments& arguments, const Division& division);

}  // namespace rheonet::tool
