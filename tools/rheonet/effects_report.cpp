#include "tools/rheonet/effects_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/table.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr std::size_t most_records = 20;

std::string effects_in_words(const std::vector<Effect>& effects) {
  std::vector<std::string> words;
  for (const Effect effect : effects) words.push_back(rheonet::in_words(effect));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// A relative change in percent; only an upper bound if it is below the accuracy of the runs.
std::string percent(double relative, double accuracy) {
  if (relative < accuracy) return fmt::format("< {:g} %", 100 * accuracy);
  return relative < 0.995 ? fmt::format("{:.2g} %", 100 * relative) : fmt::format("{:.0f} %", 100 * relative);
}

std::string milliseconds(double seconds) { return fmt::format("{:.3g} ms", 1e3 * seconds); }

std::vector<std::string> row_of(const Scene& scene, const ModelHierarchy& ladder, const Rung& rung, const std::string& name) {
  if (!rung.failure.empty()) return {name, "cannot be simulated"};
  const double ratio = ladder.full.median_cpu() > 0 ? rung.median_cpu() / ladder.full.median_cpu() : 1;
  std::vector<std::string> row{name, milliseconds(rung.median_cpu()), fmt::format("{:.2f}", ratio), fmt::format("{}", rung.steps)};
  if (&rung == &ladder.full || rung.differences.empty()) return row;
  const Difference& worst = rung.differences[rung.worst];
  const std::string unit = unit_text(scene, scene.records[rung.worst]);
  row.insert(row.end(), {readable(worst.largest, unit, 3), readable(worst.rms, unit, 3), percent(worst.relative(), scene.accuracy),
                         scene.records[rung.worst].path});
  return row;
}

std::string models(const Scene& scene, const ModelHierarchy& ladder, const std::vector<Rung>& rungs, bool all_names) {
  std::vector<std::vector<std::string>> rows{{"without", "CPU time", "ratio", "steps", "largest difference", "rms", "of its size", "record"}};
  rows.push_back(row_of(scene, ladder, ladder.full, "(the full model)"));
  for (const Rung& rung : rungs) {
    const std::string last = rheonet::in_words(rung.without.back());
    rows.push_back(row_of(scene, ladder, rung, all_names && rung.without.size() > 1 ? "and " + last : last));
  }
  std::string text = aligned(rows);
  for (const Rung& rung : rungs) {
    if (!rung.failure.empty()) text += "  " + wrapped(fmt::format("without {}: {}", effects_in_words(rung.without), rung.failure), 4) + "\n";
  }
  return text;
}

/// For each record the change by each effect alone, in descending order of the largest change.
std::string by_record(const Scene& scene, const ModelHierarchy& ladder) {
  std::vector<std::size_t> order(scene.records.size());
  std::vector<double> most(order.size(), 0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
    for (const Rung& rung : ladder.each) {
      if (rung.failure.empty()) most[k] = std::max(most[k], rung.differences[k].relative());
    }
  }
  const bool shortened = order.size() > most_records;
  if (shortened) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return most[a] > most[b]; });
    order.resize(most_records);
  }
  std::vector<std::vector<std::string>> rows{{"record"}};
  for (const Rung& rung : ladder.each) {
    if (rung.failure.empty()) rows.front().push_back(rheonet::in_words(rung.without.front()) + ", rms");
  }
  if (rows.front().size() == 1) return "";
  for (const std::size_t k : order) {
    rows.push_back({scene.records[k].path});
    for (const Rung& rung : ladder.each) {
      if (!rung.failure.empty()) continue;
      const Difference& d = rung.differences[k];
      rows.back().push_back(percent(d.relative(), scene.accuracy) + ", " + percent(d.relative_rms(), scene.accuracy));
    }
  }
  std::string text = "\nwhat each effect changes in each record: largest difference and its rms, of the record's largest magnitude\n" + aligned(rows);
  if (shortened) text += fmt::format("  and {} more records, which change less\n", scene.records.size() - most_records);
  return text;
}

std::string recommendation(const Scene& scene, const std::string& file, const ModelHierarchy& ladder, double within) {
  std::vector<Effect> needed = ladder.effects, spare;
  const Rung* const barest = ladder.barest_within(within);
  if (barest) spare = barest->without;
  std::erase_if(needed, [&](Effect effect) { return std::find(spare.begin(), spare.end(), effect) != spare.end(); });
  if (!barest) return fmt::format("\nto {:g} % this scene needs all that it has: {}\n", 100 * within, effects_in_words(ladder.effects));
  std::vector<std::string> names;
  for (const Effect effect : spare) names.push_back(name_of(effect));
  const std::string stays = needed.empty() ? "none of its effects" : effects_in_words(needed);
  std::string text = fmt::format("to {:g} % this scene needs {}. Without {} every record stays within {} of the full model, at {:.2f} of its "
                                 "CPU time: rheonet run {} --without {}",
                                 100 * within, stays, effects_in_words(spare), percent(barest->relative(), scene.accuracy),
                                 barest->median_cpu() / ladder.full.median_cpu(), printable(file), fmt::join(names, ","));
  return "\n" + wrapped(text, 2) + "\n";
}

}  // namespace

std::string describe(const Scene& scene, const std::string& file, const ModelHierarchy& ladder, double within) {
  if (ladder.effects.empty()) return fmt::format("{}: nothing in it brings an effect that could be left out\n", printable(file));
  std::string text = fmt::format("{}: {:g} s to {:g} s, with {}\n", printable(file), scene.start, scene.stop, effects_in_words(ladder.effects));
  text += "\neach effect left out by itself\n" + models(scene, ladder, ladder.each, false);
  if (ladder.steps.size() > 1)
    text += "\none after the other, those first that matter least\n" + models(scene, ladder, ladder.steps, true);
  return text + by_record(scene, ladder) + recommendation(scene, file, ladder, within);
}

std::string table(const Scene& scene, const ModelHierarchy& ladder) {
  std::string text = "without,record,unit,largest_difference,time,rms_difference,largest_magnitude,cpu_median,steps,failure\n";
  const auto add = [&](const Rung& rung) {
    std::vector<std::string> names;
    for (const Effect effect : rung.without) names.push_back(name_of(effect));
    const std::string without = fmt::format("{}", fmt::join(names, " "));
    if (!rung.failure.empty()) {
      std::string reason = rung.failure;
      std::replace(reason.begin(), reason.end(), '"', '\'');
      text += fmt::format("{},,,,,,,,,\"{}\"\n", without, reason);
    }
    for (std::size_t k = 0; k < rung.differences.size(); ++k) {
      const Difference& d = rung.differences[k];
      text += fmt::format("{},{},{},{},{},{},{},{},{},\n", without, scene.records[k].path, unit_text(scene, scene.records[k]), d.largest,
                          d.time, d.rms, d.scale, rung.median_cpu(), rung.steps);
    }
  };
  add(ladder.full);
  for (const Rung& rung : ladder.each) add(rung);
  for (const Rung& rung : ladder.steps) {
    if (rung.without.size() > 1) add(rung);  // A model without one effect is in the table already.
  }
  return text;
}

}  // namespace rheonet::tool
