#include "tools/rheonet/plot_source.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/netlist/characters.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/rheonet/both_sides.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/watched.hpp"

namespace rheonet::tool {
namespace {

class CsvSource final : public PlotSource {
  static constexpr std::size_t room = 12;  // Largest number of distinguishable curves, as in chosen_columns.

 public:
  CsvSource(const std::string& file, const Arguments& arguments)
      : csv_(file, arguments.domain.empty()         ? std::optional<Domain>()
                   : arguments.domain == "rotation" ? Domain::rotation
                                                    : Domain::translation) {
    file_ = file;
    title_ = std::filesystem::path(file).filename().string();
    columns_ = csv_.columns();
    if (!arguments.plot.x.empty()) return;
    for (const auto& [time, record] : csv_.recorded())
      if (own_.curves.size() < room) own_.curves.push_back({columns_[time].name, columns_[record].name});
  }

  bool has_numbers(std::size_t column) const override { return csv_.has_numbers(column); }

  std::vector<Drawn> read(const std::vector<plot::ColumnPair>& pairs) override {
    const std::vector<std::size_t> runs = some_runs();
    std::vector<plot::Trace> traces = csv_.read(pairs, runs);
    std::vector<Drawn> drawn;
    for (std::size_t k = 0; k < traces.size(); ++k)
      drawn.push_back({k % pairs.size(), runs.empty() ? "" : csv_.runs()[runs[k / pairs.size()]].values, std::move(traces[k])});
    return drawn;
  }

 private:
  /// Positions of at most `room` runs, evenly spaced from the first to the last.
  std::vector<std::size_t> some_runs() const {
    const std::size_t count = csv_.runs().size();
    std::vector<std::size_t> runs;
    for (std::size_t k = 0; k < std::min(count, room); ++k) runs.push_back(count <= room ? k : k * (count - 1) / (room - 1));
    if (count > room) say("note: `{}` has {} runs; {} of them are drawn, from the first to the last\n", printable(file_), count, room);
    return runs;
  }

  plot::CsvFile csv_;
};

/// Whether a scene has the element or node of a path such as `k1.force`.
bool has(const Scene& scene, const std::string& path) {
  const std::string subject = path.substr(0, path.rfind('.'));
  const auto named = [&](const auto& all) {
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == subject; });
  };
  return named(scene.nodes) || named(scene.elements) || named(scene.assemblies);
}

class SceneSource final : public PlotSource {
 public:
  SceneSource(const std::string& file, const Arguments& arguments, const std::vector<std::string>& wanted,
              bool lenient) {
    ReadOptions options = options_of(arguments);
    options.claims = false;  // A plot does not evaluate claims.
    options.plotted = wanted.empty();
    if (!lenient) options.records = wanted;
    read_ = read_scene(file, declarations(), options);
    if (read_.scene && lenient) {
      for (const std::string& path : wanted)
        if (has(*read_.scene, path)) options.records.push_back(path);
      if (!options.records.empty()) read_ = read_scene(file, declarations(), options);
    }
    report_all(read_);
    if (!read_.scene) throw PlotEnded{wrong_input};
    file_ = file;
    title_ = read_.scene->title;
    if (wanted.empty()) own_ = read_.presentation.plot;
    columns_ = columns_of(*read_.scene);
  }

  std::vector<Drawn> read(const std::vector<plot::ColumnPair>& pairs) override {
    std::vector<Drawn> traces;
    for (std::size_t k = 0; k < pairs.size(); ++k) traces.push_back({k, "", {}});
    BothSides drawn([&](double time, const std::vector<double>& values) {
      const auto value = [&](std::size_t column) { return column == 0 ? time : values[column - 1]; };
      for (std::size_t k = 0; k < pairs.size(); ++k) traces[k].trace.add({value(pairs[k].first), value(pairs[k].second)});
    });
    const bool simulated = do_watched(read_.sources, [&](const auto& progress) {
      RunSettings settings{.progress = progress};
      drawn.listen(settings);
      run(*read_.scene, settings);
    });
    if (!simulated) throw PlotEnded{not_simulated};
    return traces;
  }

 private:
  ReadResult read_;
};

plot::Measure measure_of(const Scene& scene, const Record& record) {
  const Domain domain = domain_of(scene, record);
  if (const auto known = plot::measure_of_record(record.path, domain)) return *known;
  const auto quantity = quantity_of(scene, record);
  if (!quantity && unit_of(scene, record).open) return {record.path, "", {}};
  const bool length = quantity == Quantity::position && domain == Domain::translation;
  return plot::measure(!quantity ? "signal" : length ? "position" : name_of(*quantity, domain), unit_text(scene, record));
}

}  // namespace

std::unique_ptr<PlotSource> open_plot_source(const std::string& file, const Arguments& arguments,
                                             const std::vector<std::string>& wanted, bool lenient) {
  if (file.ends_with(".toml")) return std::make_unique<SceneSource>(file, arguments, wanted, lenient);
  std::error_code error;
  if (plot::measure_of_record(file, Domain::translation) && !std::filesystem::exists(file, error))
    throw plot::Mistake(fmt::format("there is no file `{}`", file), fmt::format("what is to be drawn is named by -y: `-y {}`", file));
  return std::make_unique<CsvSource>(file, arguments);
}

std::vector<plot::Column> columns_of(const Scene& scene) {
  std::vector<plot::Column> columns{{"time", plot::measure("time", "s")}};
  for (const Record& record : scene.records) columns.push_back({record.path, measure_of(scene, record)});
  return columns;
}

}  // namespace rheonet::tool
