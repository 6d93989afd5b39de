// Compares the CPU time of a netlist with that of a hand-written IDA program for the same scene at the same error. Each figure is the
// median of alternating runs in one process.
//
//   bench_pairs [-o FILE.csv] [--quick] [SCENE ...]  tables, of maxwell, stick-slip, ladder, iwan; --quick: small ones
//   bench_pairs --once SCENE hand|netlist TOLERANCE TIMES      runs one, to count its instructions

#include <cstring>

#include "tools/bench/hand/hand.hpp"
#include "tools/bench/measure.hpp"
#include "tools/bench/scenes.hpp"
#include "tools/bench/simulated.hpp"

namespace {

using namespace rheonet;
using namespace rheonet::bench;

/// The loosest accuracy that a netlist can ask for. Two settings in each power of ten: errors of runs with events scatter.
constexpr double loosest = 0.1;
/// As the programs by hand: without an energy account.
const RunSettings alone{.account = false};

struct Pair {
  std::string name;
  std::string netlist;
  std::function<hand::Run(double tolerance, const std::vector<double>& times)> by_hand;
};

Pair pair_of(const std::string& name, int size) {
  if (name == "maxwell") return {name, maxwell(), hand::maxwell};
  if (name == "stick-slip") return {name, stick_slip(), hand::stick_slip};
  const std::string sized = fmt::format("{} {}", name, size);
  if (name == "ladder")
    return {sized, ladder(size), [size](double tolerance, const auto& times) { return hand::ladder(size, tolerance, times); }};
  if (name == "iwan")
    return {sized, iwan(size), [size](double tolerance, const auto& times) { return hand::iwan(size, tolerance, times); }};
  throw std::runtime_error("there is no pair `" + name + "`: maxwell, stick-slip, ladder, iwan");
}

std::vector<double> times_of(const Scene& scene) {
  std::vector<double> times;
  for (std::int64_t k = 0; k < scene.output_intervals; ++k) times.push_back(scene.start + static_cast<double>(k) * scene.output_every);
  times.push_back(scene.stop);
  return times;
}

std::vector<double> record_of(const hand::Run& run) {
  std::vector<double> column;
  for (const std::vector<double>& row : run.rows) column.push_back(row.front());
  return column;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// The largest difference, in parts of the largest magnitude.
double error(const std::vector<double>& values, const std::vector<double>& truth) {
  double most = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) most = std::max(most, std::abs(values[k] - truth[k]));
  return most / largest(truth);
}

struct Cost {
  double setting = 0, error = 0, seconds = 0;
  long steps = 0;
};

/// The cost of an error, interpolated between the measurements on logarithmic axes. The cheapest setting with at most this error counts.
std::optional<double> cost_of(std::vector<Cost> costs, double error) {
  std::sort(costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.error < b.error; });
  std::optional<double> found;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    if (costs[k].error <= error) found = found ? std::min(*found, costs[k].seconds) : costs[k].seconds;
    if (k + 1 == costs.size() || costs[k].error > error || costs[k + 1].error <= error) continue;
    const double part = std::log(error / costs[k].error) / std::log(costs[k + 1].error / costs[k].error);
    const double between = costs[k].seconds * std::pow(costs[k + 1].seconds / costs[k].seconds, part);
    found = std::min(*found, between);
  }
  return found;
}

void compare(const Pair& pair, std::FILE* csv, int runs, double tightest) {
  const std::vector<double> times = times_of(read(pair.netlist));
  const std::vector<double> truth = values(read(pair.netlist, 1e-12));
  std::vector<Cost> by_hand, netlist;
  Table table(csv, pair.name, {"setting", "by hand: error", "ms", "steps", "netlist: error", "ms", "steps"});
  for (double setting = loosest; setting > tightest * 0.99; setting /= std::sqrt(10.0)) {
    const Scene scene = read(pair.netlist, setting);
    std::vector<double> hand_seconds, seconds;
    hand::Run run;
    Summary summary;
    for (int k = 0; k < runs; ++k) {
      double begin = process_cpu_seconds();
      run = pair.by_hand(setting, times);
      hand_seconds.push_back(process_cpu_seconds() - begin);
      begin = process_cpu_seconds();
      summary = rheonet::run(scene, alone);
      seconds.push_back(process_cpu_seconds() - begin);
    }
    by_hand.push_back({setting, error(record_of(run), truth), median(hand_seconds), run.steps});
    netlist.push_back({setting, error(values(scene), truth), median(seconds), summary.steps});
    const Cost &h = by_hand.back(), &n = netlist.back();
    table.row({fmt::format("{:.1e}", setting), fmt::format("{:.1e}", h.error), milliseconds(h.seconds), std::to_string(h.steps),
               fmt::format("{:.1e}", n.error), milliseconds(n.seconds), std::to_string(n.steps)});
  }
  Table ratios(csv, pair.name + ", at the same error", {"error", "by hand, ms", "netlist, ms", "ratio"});
  for (const double wanted : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    const auto h = cost_of(by_hand, wanted), n = cost_of(netlist, wanted);
    if (h && n) ratios.row({fmt::format("{:g}", wanted), milliseconds(*h), milliseconds(*n), fmt::format("{:.2f}", *n / *h)});
  }
}

int once(char** words) {
  const Pair pair = pair_of(words[0], 1000);
  const double tolerance = std::strtod(words[2], nullptr);
  const Scene scene = read(pair.netlist, tolerance);
  const std::vector<double> times = times_of(scene);
  for (int k = 0; k < std::atoi(words[3]); ++k) {
    if (std::strcmp(words[1], "hand") == 0)
      pair.by_hand(tolerance, times);
    else
      run(scene, alone);
  }
  return 0;
}

}  // namespace

int main(int count, char** words) {
  try {
    if (count == 6 && std::strcmp(words[1], "--once") == 0) return once(words + 2);
    std::FILE* csv = nullptr;
    bool quick = false;
    std::vector<std::string> names;
    for (int k = 1; k < count; ++k) {
      const std::string word = words[k];
      if (word == "-o" && k + 1 < count)
        csv = open_table(words[++k]);
      else if (word == "--quick")
        quick = true;
      else
        names.push_back(word);
    }
    if (names.empty()) names = {"maxwell", "stick-slip", "ladder", "iwan"};
    for (const std::string& name : names) {
      if (name == "ladder") {
        for (const int masses : {10, 1000})
          if (!quick || masses == 10) compare(pair_of(name, masses), csv, quick ? 3 : 5, quick ? 1e-6 : 1e-8);
      } else if (name == "iwan") {
        for (const int pairs : {100, 1000})
          if (!quick || pairs == 100) compare(pair_of(name, pairs), csv, 3, quick ? 1e-5 : 1e-6);
      } else {
        compare(pair_of(name, 0), csv, quick ? 5 : 15, quick ? 1e-7 : 1e-10);
      }
    }
    if (csv && std::fclose(csv) != 0) throw std::runtime_error("the table cannot be written");
  } catch (const std::exception& mistake) {
    fmt::print(stderr, "bench_pairs: {}\n", mistake.what());
    return 1;
  }
}
