// What does an Iwan bundle of N pairs cost? From its netlist, iwan.toml, which the command line names: read and
// simulated. Prints a table for iwan.md.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"

namespace {

using namespace rheonet;

double process_cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    fmt::print(stderr, "usage: bench_iwan tools/bench/iwan.toml\n");
    return 2;
  }
  constexpr int repetitions = 5;
  fmt::print("| pairs | accuracy | reading, ms | simulation, ms | steps | starts |\n|---|---|---|---|---|---|\n");
  for (const int pairs : {1, 10, 100, 1000, 10000, 100000}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      ReadOptions options;
      options.overrides = {fmt::format("iwan.repeat.count={}", pairs), "simulate.record=[\"x.position\"]"};
      options.accuracy = accuracy;
      double reading = std::numeric_limits<double>::infinity(), simulation = reading;
      Summary summary;
      for (int k = 0; k < repetitions; ++k) {
        const double begin = process_cpu_seconds();
        const ReadResult read = read_scene(words[1], declarations(), options);
        reading = std::min(reading, process_cpu_seconds() - begin);
        if (!read.scene) {
          for (const Diagnostic& mistake : read.diagnostics) fmt::print(stderr, "{}\n", format(mistake, read.sources));
          return 2;
        }
        summary = run(*read.scene);
        simulation = std::min(simulation, summary.cpu_seconds);
      }
      fmt::print("| {} | {:g} | {:.1f} | {:.1f} | {} | {} |\n", pairs, accuracy, 1e3 * reading, 1e3 * simulation,
                 summary.steps, summary.restarts);
    }
  }
}
