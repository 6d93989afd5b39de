// What does an Iwan bundle of N pairs cost? A mass of 1 kg driven by 8 N sin(2 pi t/s) for 3 s, held by N springs of
// K/N = 400/N N/m in series with sliders of 2 FC (i + 1/2)/N^2, FC = 10 N: from its netlist, read and simulated. Prints
// a table for iwan.md.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"

namespace {

using namespace rheonet;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string netlist(int pairs, double accuracy) {
  return fmt::format(R"(
[parameters]
K = "400 N/m"
FC = "10 N"
[elements]
m = {{ type = "mass", at = "x", mass = "1 kg" }}
f = {{ type = "force", at = "x", force = {{ sine = "8 N", frequency = "1 Hz" }} }}
[elements.iwan]
between = ["x", "ground"]
repeat = {{ count = {}, as = "i", arrange = "parallel" }}
series = [
  {{ name = "k", type = "spring", stiffness = "K/n" }},
  {{ name = "s", type = "slider", coulomb = "2*FC*(i + 0.5)/n^2" }},
]
[simulate]
stop = "3 s"
accuracy = {}
output = {{ points = 31 }}
record = ["x.position"]
)",
                     pairs, accuracy);
}

}  // namespace

int main() {
  constexpr int repetitions = 5;
  fmt::print("| pairs | accuracy | reading, ms | simulation, ms | steps | starts |\n|---|---|---|---|---|---|\n");
  for (const int pairs : {1, 10, 100, 1000, 10000, 100000}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      const std::string text = netlist(pairs, accuracy);
      double reading = std::numeric_limits<double>::infinity(), simulation = reading;
      Summary summary;
      for (int k = 0; k < repetitions; ++k) {
        const double begin = cpu_seconds();
        const ReadResult read = read_scene_text(text, "iwan.toml", ".", declarations(), {});
        reading = std::min(reading, cpu_seconds() - begin);
        summary = run(*read.scene);
        simulation = std::min(simulation, summary.cpu_seconds);
      }
      fmt::print("| {} | {:g} | {:.1f} | {:.1f} | {} | {} |\n", pairs, accuracy, 1e3 * reading, 1e3 * simulation,
                 summary.steps, summary.restarts);
    }
  }
}
