#pragma once

#include <string>

#include "tools/rheonet/sweep_runs.hpp"

namespace rheonet::tool {

/// A program that starts many tasks on one host or several.
struct Engine {
  const char* option;  ///< Option of `sweep`.
  double task_cost;    ///< CPU time to start and end an empty task [s].
};
inline constexpr Engine slurm{"--slurm", 0.5}, gnu_parallel{"--parallel", 0.012};

/// Division of a sweep into shards.
struct Division {
  long shards = 1;
  double shard_seconds = 0;  ///< Estimated CPU time of each shard [s].
};

/// Times some runs, and divides the sweep so that each shard takes at least 100 times the cost of a task of the engine. There are at most
/// 1000 shards, Debian's limit for a job array of Slurm.
Division divide_sweep(Sweep& sweep, const Engine& engine);

/// A Bash script that simulates the shards as a job array, and joins them if it is called with the argument `merge`.
std::string slurm_script(const Arguments& arguments, const Division& division);

/// A Bash script that simulates the shards and then joins them. Its arguments are passed on to GNU parallel, for example the hosts.
std::string parallel_script(const Arguments& arguments, const Division& division);

}  // namespace rheonet::tool
