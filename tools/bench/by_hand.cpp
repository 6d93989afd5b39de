// Scenes of tools/bench/peers by the programs written by hand for IDA (tools/bench/hand).
//
//   bench_by_hand SCENE TOLERANCE REPEATS
//
// prints the CPU time [s] (the median of the repeats) in a first line `# cpu ...`, then rows: time and the scene's records.

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "tools/bench/hand/hand.hpp"
#include "tools/bench/measure.hpp"

namespace {

using namespace rheonet;

struct Scene {
  double stop;  ///< s
  std::function<hand::Run(double tolerance, const std::vector<double>& times)> run;
  std::function<std::vector<double>(const std::vector<double>& row)> records;
};

Scene scene(const std::string& name) {
  using Row = std::vector<double>;
  const auto swinging = [](double stop, const hand::Block& block) {
    return Scene{stop, [block](double tolerance, const auto& times) { return hand::block(block, tolerance, times); },
                 [](const Row& row) { return Row{-row[2], row[1]}; }};  // the spring's first end is the block
  };
  const auto pulled = [](const Row& row) { return Row{row[2], row[1]}; };
  if (name == "maxwell") return {10, hand::maxwell, [](const Row& row) { return Row{row[0], 0}; }};
  if (name == "stick-slip") return {100, hand::stick_slip, pulled};
  if (name == "ladder")
    return {0.1, [](double tolerance, const auto& times) { return hand::ladder(100, tolerance, times); }, pulled};
  if (name == "resonance") return swinging(16.6, {.mass = 0.7, .stiffness = 90, .force = 0.02, .omega = std::sqrt(90 / 0.7)});
  if (name == "swing")
    return swinging(7, {.mass = 0.7, .stiffness = 90, .position = 40.5 * 0.05 / 90, .coulomb = 0.05, .breakaway = 0.05});
  throw std::invalid_argument("there is no scene `" + name + "`: maxwell, stick-slip, ladder, resonance, swing");
}

}  // namespace

int main(int count, char** words) try {
  if (count != 4 || std::atoi(words[3]) < 1) throw std::invalid_argument("usage: bench_by_hand SCENE TOLERANCE REPEATS");
  const Scene asked = scene(words[1]);
  constexpr int intervals = 500;
  std::vector<double> times, seconds;
  for (int k = 0; k <= intervals; ++k) times.push_back(k * asked.stop / intervals);
  hand::Run run;
  for (int repeat = 0; repeat < std::atoi(words[3]); ++repeat) {
    const double begin = bench::process_cpu_seconds();
    run = asked.run(std::atof(words[2]), times);
    seconds.push_back(bench::process_cpu_seconds() - begin);
  }
  fmt::print("# cpu {:.9g}\n", bench::median(seconds));
  for (std::size_t k = 0; k < times.size(); ++k) {
    const std::vector<double> records = asked.records(run.rows[k]);
    fmt::print("{:.17g},{:.17g},{:.17g}\n", times[k], records[0], records[1]);
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_by_hand: {}\n", error.what());
  return 1;
}
