#include "tools/rheonet/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rheonet::tool {
namespace {

/// Times whose difference is below this fraction of the run differ by round-off only.
constexpr double rounding = 1e-9;

const char* name_of_domain(Domain domain) { return domain == Domain::rotation ? "rotation" : "translation"; }

}  // namespace

void check_comparable(const std::vector<Scene>& scenes) {
  const Scene& first = scenes.front();
  for (const Scene& scene : scenes) {
    if (scene.domain != first.domain)
      throw NotComparable(fmt::format("one scene is of {}, the other of {}: nothing in them can be compared", name_of_domain(first.domain),
                                      name_of_domain(scene.domain)));
    if (std::abs(scene.start - first.start) > rounding * (first.stop - first.start))
      throw NotComparable(fmt::format("the runs start at different times, {} s and {} s: set `simulate.start` of all scenes to one time",
                                      first.start, scene.start));
  }
}

void to_one_time_base(std::vector<Scene>& scenes) {
  double stop = scenes.front().stop;
  for (const Scene& scene : scenes) stop = std::min(stop, scene.stop);
  const double start = scenes.front().start;
  const double every = std::min(scenes.front().output_every, stop - start);
  for (Scene& scene : scenes) {
    scene.start = start;
    scene.stop = stop;
    scene.output_every = every;
    scene.output_intervals = static_cast<std::int64_t>(std::floor((stop - start) / every + rounding));
    scene.output_events = false;
  }
}

Columns record_columns(const Scene& scene) {
  Columns columns;
  for (std::size_t i = 0; i < scene.records.size(); ++i) columns.emplace(scene.records[i].path, i);
  return columns;
}

std::vector<Pairing> shared_records(const Scene& first, const std::vector<Columns>& columns) {
  std::vector<Pairing> pairings;
  for (const Record& record : first.records)
    if (std::all_of(columns.begin(), columns.end(), [&](const Columns& known) { return known.contains(record.path); }))
      pairings.emplace_back(columns.size(), record.path);
  return pairings;
}

void Compared::add(std::string file, Scene scene, Sources from) {
  files.push_back(std::move(file));
  columns.push_back(record_columns(scene));
  scenes.push_back(std::move(scene));
  sources.push_back(std::move(from));
}

void prepare(Compared& compared) {
  check_comparable(compared.scenes);
  if (compared.pairings.empty()) compared.pairings = shared_records(compared.scenes.front(), compared.columns);
  for (const Pairing& pairing : compared.pairings) {
    const auto dimension = [&](std::size_t i) {
      const Scene& scene = compared.scenes[i];
      return unit_of(scene, scene.records[compared.columns[i].at(pairing[i])]).dimension;
    };
    for (std::size_t i = 1; i < pairing.size(); ++i)
      if (!dimension(i).same(dimension(0)))
        throw NotComparable(fmt::format("`{}` and `{}` are different quantities", pairing[0], pairing[i]));
  }
  to_one_time_base(compared.scenes);
}

void simulate(Compared& compared, const RunSettings& settings) {
  for (const Scene& scene : compared.scenes) compared.trajectories.push_back(run_to_memory(scene, settings));
  for (std::size_t i = 1; i < compared.scenes.size(); ++i) {
    compared.differences.emplace_back();
    for (const Pairing& pairing : compared.pairings)
      compared.differences.back().push_back(difference(compared.trajectories[0], compared.columns[0].at(pairing[0]),
                                                       compared.trajectories[i], compared.columns[i].at(pairing[i])));
  }
}

}  // namespace rheonet::tool
