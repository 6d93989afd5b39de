#include "tools/python/reading.hpp"

#include <pybind11/stl.h>

#include <utility>

#include "core/netlist/characters.hpp"
#include "core/network/advice.hpp"
#include "core/network/component.hpp"
#include "core/result/explain.hpp"
#include "core/result/memory_file.hpp"
#include "tools/draw/schematic.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/python/diagnostics.hpp"
#include "tools/python/watch.hpp"
#include "tools/rheonet/both_sides.hpp"
#include "tools/rheonet/explanation.hpp"

namespace rheonet::python {

Reading::Reading(std::string file, ReadResult result)
    : file_(std::move(file)), sources_(std::make_shared<const Sources>(std::move(result.sources))), presentation_(std::move(result.presentation)),
      diagnostics_(std::move(result.diagnostics)) {
  if (!result.scene) return;
  scene_ = std::make_shared<const Scene>(std::move(*result.scene));
  const std::vector<Diagnostic> advice = advice_on(*scene_);
  diagnostics_.insert(diagnostics_.end(), advice.begin(), advice.end());
}

ReadResult Reading::read_result(std::optional<double> accuracy) const {
  return {.scene = *with_accuracy(accuracy), .presentation = presentation_, .diagnostics = diagnostics_, .sources = *sources_};
}

py::list Reading::diagnostics() const {
  py::list result;
  for (const Diagnostic& diagnostic : diagnostics_) result.append(as_dict(diagnostic, *sources_));
  return result;
}

std::vector<std::pair<int, bool>> Reading::mistakes_in_changes() const {
  std::vector<std::pair<int, bool>> all;
  for (const Diagnostic& diagnostic : diagnostics_) {
    const Spot& spot = diagnostic.spot;
    if (diagnostic.severity != Severity::error || !spot.on_command_line()) continue;
    if (spot.line < 1) {
      all.emplace_back(-1, false);
      continue;
    }
    const std::string& text = sources_->command_line.at(static_cast<std::size_t>(spot.line) - 1);
    all.emplace_back(spot.line - 1, static_cast<std::size_t>(spot.column) <= count_characters(std::string_view(text).substr(0, text.find('='))));
  }
  return all;
}

py::dict Reading::units() const {
  py::dict result;
  for (const Record& record : scene_->records) result[py::str(record.path)] = unit_text(*scene_, record);
  return result;
}

std::unique_ptr<Run> Reading::run(const RunWanted& wanted, const py::object& progress) const {
  auto run = std::make_unique<Run>();
  run->scene = with_accuracy(wanted.accuracy);
  run->sources = sources_;
  run->drawn = presentation_.plot;
  run->columns.resize(scene_->records.size());
  const auto rows = static_cast<std::size_t>(scene_->output_intervals) + 1;
  run->times.reserve(rows);
  for (std::vector<double>& column : run->columns) column.reserve(rows);

  MemoryFile events;
  Watch watch(progress);
  const auto keep = [&run](double time, const std::vector<double>& values) {
    run->times.push_back(time);
    // As in the CSV, -0 becomes 0.
    for (std::size_t k = 0; k < values.size(); ++k) run->columns[k].push_back(values[k] + 0.0);
  };
  RunSettings settings{.events = events.file(),
                       .row = keep,
                       .interrupt = watch.interrupt(),
                       .progress = [&watch](double fraction) { watch.advance(fraction); },
                       .threads = wanted.threads};
  tool::BothSides sides(keep);
  if (wanted.both_sides) sides.listen(settings);
  const auto work = [&] {
    try {
      if (wanted.certified) {
        run->certificate = certify(*run->scene, settings);
        run->summary = run->certificate->summary;
      } else {
        run->summary = rheonet::run(*run->scene, settings);
      }
    } catch (const SimulationError& error) {
      run->failure = error;
    }
  };
  watch.call(work, wanted.threads > 1);
  run->events = events.text();
  return run;
}

std::unique_ptr<Run> Reading::run_with(std::vector<double> times, std::vector<std::vector<double>> columns) const {
  auto run = std::make_unique<Run>();
  run->scene = scene_;
  run->sources = sources_;
  run->drawn = presentation_.plot;
  run->times = std::move(times);
  run->columns = std::move(columns);
  return run;
}

std::string Reading::explanation() const {
  std::optional<SimulationError> failure;
  {
    const Unlocked unlocked;
    try {
      return tool::to_json(*scene_, explain(*scene_));
    } catch (const SimulationError& error) {
      failure = error;
    }
  }
  raise(*failure, *sources_);
}

std::optional<std::string> Reading::schematic() const {
  try {
    return draw::svg(draw::schematic(*scene_, {.title = scene_->title, .sources = sources_.get()}), *scene_);
  } catch (const plot::Mistake&) {
    return std::nullopt;
  }
}

std::shared_ptr<const Scene> Reading::with_accuracy(std::optional<double> accuracy) const {
  if (!accuracy || *accuracy == scene_->accuracy) return scene_;
  auto changed = std::make_shared<Scene>(*scene_);
  changed->accuracy = *accuracy;
  return changed;
}

Source::Source(std::string file, std::optional<std::string> text, std::string folder, const Files& texts, const Files& canonical)
    : file_(std::move(file)), text_(std::move(text)), folder_(std::move(folder)) {
  FileCache::Contents contents;
  for (const auto& [path, read] : texts) contents.texts.emplace(std::string(path), std::string(read));
  for (const auto& [path, found] : canonical) contents.canonical.emplace(std::string(path), std::string(found));
  cache_.add(std::move(contents));
}

py::tuple Source::state() {
  const auto absolute = [this](const std::filesystem::path& path) { return path == "." ? working_folder_ : working_folder_ / path; };
  const FileCache::Contents contents = cache_.contents();
  Files texts, canonical;
  for (const auto& [path, text] : contents.texts) texts.emplace_back(absolute(path).string(), text);
  for (const auto& [path, found] : contents.canonical) canonical.emplace_back(absolute(path).string(), found.string());
  return py::make_tuple(text_ ? file_ : absolute(file_).string(), text_, absolute(folder_).string(), texts, canonical);
}

Reading Source::read(Wanted wanted) {
  const ReadOptions options{.overrides = std::move(wanted.overrides),
                            .records = std::move(wanted.records),
                            .plotted = wanted.plotted,
                            .claims = !wanted.measures,
                            .measures = wanted.measures.value_or(std::vector<std::string>{}),
                            .model_folders = {wanted.model_folders.begin(), wanted.model_folders.end()},
                            .cache = &cache_};
  return Reading(file_, text_ ? read_scene_text(*text_, file_, folder_, declarations(), options) : read_scene(file_, declarations(), options));
}

}  // namespace rheonet::python
