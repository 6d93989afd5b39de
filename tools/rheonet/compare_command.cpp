#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/compare_report.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/variation.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

/// Thrown to end the command after its messages have been printed.
struct Ended {
  ExitStatus status;
};

/// `--pair a=b`: `a` in the first scene, `b` in every other scene; `a=b=c`: one for each scene.
std::vector<Pairing> named_pairs(const Arguments& arguments) {
  std::vector<Pairing> pairings;
  for (const std::string& text : arguments.pairs) {
    Pairing paths = split(text, '=');
    if (paths.size() == 2) paths.resize(arguments.scenes.size(), paths.back());
    if (paths.size() != arguments.scenes.size()) {
      say("error: `--pair {}` names {} records for {} scenes\n  --pair k1.force=m.spring1.force\n", printable(text),
          paths.size(), arguments.scenes.size());
      throw Ended{wrong_input};
    }
    pairings.push_back(std::move(paths));
  }
  return pairings;
}

std::string some_records(const Scene& scene) {
  constexpr std::size_t few = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(few, scene.records.size()); ++i)
    text += (i ? ", `" : "`") + scene.records[i].path + "`";
  return text + (scene.records.size() > few ? ", ..." : "");
}

/// Reads the scenes, with one value of `--vary` ("" for none).
Compared read_all(const Arguments& arguments, const std::string& override) {
  Compared compared;
  compared.pairings = named_pairs(arguments);
  for (std::size_t i = 0; i < arguments.scenes.size(); ++i) {
    ReadOptions options = options_of(arguments);
    options.claims = false;  // Claims hold for the unmodified scene.
    if (!override.empty()) {
      options.overrides.push_back(override);
      options.origins = {"--vary "};
    }
    for (const Pairing& pairing : compared.pairings) options.records.push_back(pairing[i]);
    ReadResult read = read_and_report(arguments.scenes[i], options);
    if (!read.scene || is_source(arguments.overlay, "--output", read.sources)) throw Ended{wrong_input};
    compared.add(arguments.scenes[i], std::move(*read.scene), std::move(read.sources));
  }
  if (!can_be_table(arguments.overlay, "--output")) throw Ended{wrong_input};
  try {
    prepare(compared);
  } catch (const NotComparable& why) {
    say("error: {}\n", why.what());
    throw Ended{wrong_input};
  }
  if (!compared.pairings.empty()) return compared;
  say("error: the scenes record nothing of the same name; pair two records: --pair k1.force=m.spring1.force\n");
  for (std::size_t i = 0; i < compared.scenes.size(); ++i)
    say("  {} records {}\n", printable(compared.files[i]), some_records(compared.scenes[i]));
  throw Ended{wrong_input};
}

/// Simulates the scenes and computes the differences.
void run_all(Compared& compared, const std::string& override, const std::atomic<bool>& interrupted) {
  try {
    simulate(compared, {.interrupt = &interrupted});
  } catch (const SimulationError& error) {
    const std::size_t i = compared.trajectories.size();
    report(error, compared.sources[i]);
    say("  {}{}{}{} simulated\n", printable(compared.files[i]), override.empty() ? "" : " with ", printable(override),
        interrupted ? " was being" : " cannot be");
    throw Ended{not_simulated};
  }
}

/// Updates `furthest` if a pair has a larger difference.
void look(const Compared& compared, const std::string& value, Furthest& furthest) {
  for (std::size_t other = 1; other < compared.scenes.size(); ++other)
    for (std::size_t p = 0; p < compared.pairings.size(); ++p) {
      const Difference& d = compared.differences[other - 1][p];
      if (!furthest.name.empty() && d.relative() <= furthest.difference.relative()) continue;
      furthest = {name_of(compared.pairings[p], other), d, value};
    }
}

/// The report, the data, and the pair with the largest difference.
struct Findings {
  std::string text, data;
  Furthest furthest;
  std::optional<Ended> ended;  ///< Present if the comparison ended before the last value.
};

Findings compare_once(Compared compared, const std::atomic<bool>& interrupted) {
  Findings found;
  run_all(compared, "", interrupted);
  look(compared, "", found.furthest);
  found.text = describe(compared);
  found.data = overlay(compared);
  return found;
}

/// Compares for each value. `compared` has the scenes with the first value. If a scene cannot be simulated, the results for the values
/// before are kept.
Findings compare_over(const Variation& variation, Compared compared, const Arguments& arguments,
                      const std::atomic<bool>& interrupted) {
  Findings found;
  std::vector<Varied> rows;
  for (const std::string& value : variation.values) {
    const std::string override = variation.path + '=' + value;
    if (!rows.empty()) compared = read_all(arguments, override);
    try {
      run_all(compared, override, interrupted);
    } catch (const Ended& ended) {
      if (rows.empty()) throw;
      found.ended = ended;
      break;
    }
    look(compared, value, found.furthest);
    rows.push_back({value, compared.differences, {}});
    for (const Trajectory& trajectory : compared.trajectories) rows.back().dissipated.push_back(trajectory.summary.dissipated);
  }
  found.text = describe(variation.path, rows, compared);
  found.data = table(variation.path, rows, compared);
  return found;
}

ExitStatus compare(const Arguments& arguments) {
  std::optional<Variation> variation;
  if (!arguments.vary.empty()) {
    auto read = read_variation(arguments.vary);
    if (const auto* wrong = std::get_if<NoVariation>(&read)) {
      say("error: {}\n", printable(wrong->message));
      if (!wrong->hint.empty()) say("  {}\n", printable(wrong->hint));
      return wrong_input;
    }
    variation = std::get<Variation>(std::move(read));
  }
  Compared compared = read_all(arguments, variation ? variation->path + '=' + variation->values.front() : "");
  std::unique_ptr<Output> output;
  if (!arguments.overlay.empty() && !(output = open_output(arguments.overlay, Output::Writing::complete))) return wrong_input;

  const std::atomic<bool>& interrupted = end_on_signals();
  const char* const row = variation ? "value" : "row";
  Findings found;
  try {
    found = variation ? compare_over(*variation, std::move(compared), arguments, interrupted)
                      : compare_once(std::move(compared), interrupted);
  } catch (const Ended&) {
    if (output) say("{}", output->kept(row));
    throw;
  }
  const bool judged = arguments.within && !found.ended;
  if (judged) found.text += '\n' + verdict(*arguments.within, found.furthest, variation ? variation->path : "");
  // If the data go to standard output, print the report on standard error.
  arguments.overlay == "-" ? say("{}", found.text) : fmt::print("{}", found.text);
  if (output && !write_all(*output, found.data, row)) return not_simulated;
  if (found.ended) {
    if (output) say("{}", output->kept(row));
    return found.ended->status;
  }
  return !judged || found.furthest.difference.relative() <= *arguments.within ? done : not_as_claimed;
}

}  // namespace

ExitStatus compare_scenes(const Arguments& arguments) {
  try {
    return compare(arguments);
  } catch (const Ended& ended) {
    return ended.status;
  }
}

}  // namespace rheonet::tool
