#include "tools/rheonet/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheonet::tool {
namespace {

/// Times that differ by less than this fraction of the run are the same, computed otherwise.
constexpr double rounding = 1e-9;

const char* name_of_domain(Domain domain) { return domain == Domain::rotation ? "rotation" : "translation"; }

}  // namespace

std::string obstacle(const std::vector<Scene>& scenes) {
  const Scene& first = scenes.front();
  for (const Scene& scene : scenes) {
    if (scene.domain != first.domain)
      return fmt::format("one scene is of {}, the other of {}: nothing in them can be compared", name_of_domain(first.domain),
                         name_of_domain(scene.domain));
    if (std::abs(scene.start - first.start) > rounding * (first.stop - first.start))
      return fmt::format("the runs start at different times, {} s and {} s; `--set simulate.start=...` sets all",
                         first.start, scene.start);
  }
  return "";
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

}  // namespace rheonet::tool
