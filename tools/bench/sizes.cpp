// Measures time to read, time to simulate and memory over the size of a scene, each in a separate process.
//
//   bench_sizes [-o FILE.csv] [--quick | --large] [--limit SECONDS] [SCENE ...]
//
// Scenes: ladder, whole-ladder (which keeps the parts that no motion reaches, like written-out), hand-ladder, iwan, hand-iwan, couette,
// tree, grid, written-out. --large goes up to a million masses and to a grid of 100 x 100. --quick takes the two smallest sizes of each.

#include <cstring>

#include "tools/bench/hand/hand.hpp"
#include "tools/bench/measure.hpp"
#include "tools/bench/scenes.hpp"
#include "tools/bench/simulated.hpp"

namespace {

using namespace rheonet;
using namespace rheonet::bench;

struct Family {
  std::string name;
  std::vector<int> sizes, large;  ///< `large`: additional sizes for --large.
  std::string (*netlist)(int size);  ///< nullptr: a hand-written program.
  hand::Run (*by_hand)(int size, double tolerance, const std::vector<double>& times);
  double stop;  ///< End time of the hand-written program [s].
  std::vector<std::string> keep = {};  ///< Reductions that are switched off.
};

const Family families[] = {
    {"ladder", {10, 100, 1000, 10000}, {100000, 1000000}, ladder, nullptr, 0},
    {"whole-ladder", {10, 100, 1000, 10000}, {100000, 1000000}, ladder, nullptr, 0, {"reach"}},
    {"hand-ladder", {10, 100, 1000, 10000}, {100000, 1000000}, nullptr, hand::ladder, 0.1},
    {"iwan", {1, 10, 100, 1000, 10000, 100000}, {}, iwan, nullptr, 0},
    {"hand-iwan", {1, 10, 100}, {1000}, nullptr, hand::iwan, 3},
    {"couette", {10, 100, 1000, 10000}, {100000}, couette, nullptr, 0},
    {"tree", {100, 1000, 10000}, {}, tree, nullptr, 0},
    {"grid", {5, 10, 20}, {40, 100}, grid, nullptr, 0},
    {"written-out", {3000, 30000}, {300000}, written_out, nullptr, 0, {"reach"}},
};

/// Reading [s], simulating [s], unknowns, steps, events, starts.
std::vector<double> simulated(const std::string& netlist, const std::vector<std::string>& keep) {
  const double begin = process_cpu_seconds();
  Scene scene = read(netlist);
  scene.keep = keep;
  const double read = process_cpu_seconds();
  const Summary summary = run(scene, {.account = false});  // as the programs by hand
  return {read - begin, process_cpu_seconds() - read, static_cast<double>(summary.unknowns), static_cast<double>(summary.steps),
          static_cast<double>(summary.events), static_cast<double>(summary.restarts)};
}

std::vector<double> done_by_hand(const Family& family, int size) {
  const double begin = process_cpu_seconds();
  const hand::Run run = family.by_hand(size, 1e-6, {0, family.stop});
  return {0, process_cpu_seconds() - begin, 0, static_cast<double>(run.steps), static_cast<double>(run.events), 0};
}

std::string whole(double value) { return fmt::format("{:.0f}", value); }

enum class Extent { quick, usual, large };

void measure(const Family& family, std::FILE* csv, Extent extent, unsigned limit) {
  Table table(csv, family.name, {"size", "reading, ms", "simulating, ms", "ms an event", "unknowns", "steps", "events", "starts", "MB"});
  std::vector<int> sizes = family.sizes;
  if (extent == Extent::large) sizes.insert(sizes.end(), family.large.begin(), family.large.end());
  if (extent == Extent::quick) sizes.resize(std::min<std::size_t>(sizes.size(), 2));
  std::vector<double> x, seconds;
  for (const int size : sizes) {
    const Outcome outcome = alone(limit, [&] { return family.netlist ? simulated(family.netlist(size), family.keep) : done_by_hand(family, size); });
    const auto& v = outcome.values;
    if (v.size() < 6) {
      table.row({std::to_string(size), "-", fmt::format("not in {} s", limit), "-", "-", "-", "-", "-", whole(outcome.megabytes)});
      break;
    }
    table.row({std::to_string(size), milliseconds(v[0]), milliseconds(v[1]), v[4] > 0 ? milliseconds(v[1] / v[4]) : "-", whole(v[2]), whole(v[3]),
               whole(v[4]), whole(v[5]), whole(outcome.megabytes)});
    x.push_back(size);
    seconds.push_back(v[1]);
  }
  if (x.size() > 2) fmt::print("\nCPU time of simulating ~ size^{:.2f}\n", exponent(x, seconds));
}

}  // namespace

int main(int count, char** words) {
  try {
    std::FILE* csv = nullptr;
    Extent extent = Extent::usual;
    unsigned limit = 600;
    std::vector<std::string> names;
    for (int k = 1; k < count; ++k) {
      const std::string word = words[k];
      if (word == "-o" && k + 1 < count)
        csv = open_table(words[++k]);
      else if (word == "--large" || word == "--quick")
        extent = word == "--large" ? Extent::large : Extent::quick;
      else if (word == "--limit" && k + 1 < count)
        limit = static_cast<unsigned>(std::atoi(words[++k]));
      else
        names.push_back(word);
    }
    const auto wanted = [&](const std::string& name) { return names.empty() || std::find(names.begin(), names.end(), name) != names.end(); };
    for (const std::string& name : names) {
      if (std::none_of(std::begin(families), std::end(families), [&](const Family& family) { return family.name == name; }))
        throw std::runtime_error("there is no scene `" + name + "`");
    }
    for (const Family& family : families)
      if (wanted(family.name)) measure(family, csv, extent, limit);
    if (csv && std::fclose(csv) != 0) throw std::runtime_error("the table cannot be written");
  } catch (const std::exception& mistake) {
    fmt::print(stderr, "bench_sizes: {}\n", mistake.what());
    return 1;
  }
}
