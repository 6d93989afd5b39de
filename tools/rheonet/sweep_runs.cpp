#include "tools/rheonet/sweep_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/netlist/characters.hpp"
#include "core/network/component.hpp"
#include "core/result/csv.hpp"
#include "tools/rheonet/reading.hpp"

namespace rheonet::tool {
namespace {

bool is_error(const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; }

/// The first mistake of a scene, in a line.
std::string first_mistake(const ReadResult& read) {
  const auto& all = read.diagnostics;
  const auto count = std::count_if(all.begin(), all.end(), is_error);
  const Diagnostic& first = *std::find_if(all.begin(), all.end(), is_error);
  std::string text = first.message;
  if (!first.spot.on_command_line())
    text = fmt::format("{}:{}:{}: {}", read.sources.files[static_cast<std::size_t>(first.spot.file)].path.string(),
                       first.spot.line, first.spot.column, text);
  return count > 1 ? fmt::format("{} (and {} more mistakes)", text, count - 1) : text;
}

}  // namespace

tables::Layout Sweep::layout() const {
  std::vector<bool> is_text;
  for (std::size_t path = 0; path < design_.paths().size(); ++path) is_text.push_back(!design_.all_of(path, is_number));
  return table_.layout(title_, some_points(), is_text);
}

ReadResult Sweep::read(const std::vector<std::string>& values) {
  ReadOptions options = options_;
  for (std::size_t k = 0; k < values.size(); ++k)
    options.overrides.push_back(design_.paths()[k] + '=' + values[k]);
  if (!values.empty()) options.origins = design_.origins();
  return read_scene(arguments_.scene, declarations(), options);
}

bool Sweep::is_wrong_for_all(const ReadResult& refused) {
  const std::size_t set = arguments_.overrides.size();
  const ReadResult plain = read({});
  for (const Diagnostic& mistake : refused.diagnostics) {
    if (!is_error(mistake)) continue;
    // The lines of the command line: first the --set, then the varied values, then the measures, which have mistakes in some scenes only.
    const std::size_t line = static_cast<std::size_t>(mistake.spot.line) - 1, varied = design_.paths().size();
    const bool in_measure = mistake.spot.on_command_line() && line >= set + varied;
    if (mistake.spot.on_command_line() && !in_measure) {
      if (line < set) return true;
      const std::size_t path = count_characters(design_.origins()[line - set] + design_.paths()[line - set]);
      if (static_cast<std::size_t>(mistake.spot.column) <= path) return true;
      continue;
    }
    const auto same = [&](const Diagnostic& other) {
      return is_error(other) && other.message == mistake.message && other.spot.file == mistake.spot.file &&
             other.spot.line == mistake.spot.line - static_cast<int>(in_measure ? varied : 0) && other.spot.column == mistake.spot.column;
    };
    if (std::any_of(plain.diagnostics.begin(), plain.diagnostics.end(), same)) return true;
  }
  return false;
}

bool Sweep::begin() {
  first_ = read(design_.point(0));
  if (!first_.scene && is_wrong_for_all(first_)) {
    report_all(first_);
    return false;
  }
  if (first_.scene) {
    report_all(first_);
    table_.set_scene(*first_.scene);
    title_ = first_.scene->title;
    return true;
  }
  for (long run = 1; run < design_.runs(); ++run)
    if (const ReadResult other = read(design_.point(run)); other.scene) {
      table_.set_scene(*other.scene);
      title_ = other.scene->title;
      return true;
    }
  if (table_.measures()) return true;  // Each row has the reason why its run failed.
  report_all(first_);
  return false;
}

bool Sweep::make(long first, long end, Spool& rows, const std::atomic<bool>& stop) {
  std::vector<std::pair<std::string, ReadResult>> scenes;
  for (long run = first; run < end; ++run) {
    const std::vector<std::string> values = design_.point(run);
    scenes.emplace_back(SweepTable::key(run + 1, values), read(values));
  }
  return std::all_of(scenes.begin(), scenes.end(), [&](const auto& scene) { return make(scene.second, scene.first, rows, stop); });
}

bool Sweep::make(const ReadResult& read, const std::string& key, Spool& rows, const std::atomic<bool>& stop) {
  try {
    if (!read.scene) throw SimulationError(first_mistake(read));
    table_.check_columns(*read.scene);
    RunSettings settings;
    settings.interrupt = &stop;
    settings.account = table_.needs_account();
    std::string row;
    if (!table_.measures())
      settings.row = [&](double time, const std::vector<double>& values) {
        row.clear();
        SweepTable::append(row, key, time, values);
        rows.append(row);
      };
    const Summary summary = rheonet::run(*read.scene, settings);
    simulating_ += summary.cpu_seconds;
    if (table_.measures()) rows.append(table_.row(key, summary));
  } catch (const WriteError&) {
    throw;
  } catch (const SimulationError& error) {
    if (stop) return false;
    ++failed_;
    if (!table_.measures()) rows.clear();
    rows.append(table_.failed(key, error.what()));
  }
  return true;
}

}  // namespace rheonet::tool
