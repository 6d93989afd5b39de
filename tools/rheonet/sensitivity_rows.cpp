#include "tools/rheonet/sensitivity_rows.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/network/component.hpp"
#include "core/result/csv.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/table.hpp"

namespace rheonet::tool {

namespace {

ReadResult read_multiplied(const Arguments& arguments, const std::string& path, double factor, FileCache& cache) {
  ReadOptions options = options_of(arguments);
  options.overrides.push_back(fmt::format("{}*={:.17g}", path, factor));
  options.origins.push_back("--sensitivities ");
  options.cache = &cache;
  return read_scene(arguments.scene, declarations(), options);
}

}  // namespace

bool can_be_multiplied(const Arguments& arguments) {
  FileCache cache;
  for (const std::string& path : arguments.sensitivities) {
    ReadResult read = read_multiplied(arguments, path, 1, cache);
    if (read.scene) continue;
    report_all(read);
    return false;
  }
  return true;
}

std::vector<Sensitivity> sensitivities(const Arguments& arguments, const RunSettings& settings) {
  std::vector<Sensitivity> result;
  FileCache cache;
  for (const std::string& path : arguments.sensitivities) {
    const auto multiplied = [&](double factor) {
      ReadResult read = read_multiplied(arguments, path, factor, cache);
      if (read.scene) return *std::move(read.scene);
      throw SimulationError(fmt::format("`{}` cannot be changed by {:.0e} of its value: {}", path, factor - 1, read.diagnostics.front().message));
    };
    result.push_back(sensitivity(multiplied, path, settings));
  }
  return result;
}

std::string derivative_name(const std::string& record, const std::string& path) { return fmt::format("d({})/dln {}", record, path); }

Summary write_with_derivatives(const Scene& scene, const std::vector<Sensitivity>& derivatives, const Arguments& arguments, RunSettings settings) {
  Scene plain = scene;
  plain.output_events = false;
  CsvWriter writer(std::exchange(settings.csv, nullptr), "the results");
  return flushed(writer, [&] {
    std::vector<std::string> names;
    for (const Record& record : scene.records) names.push_back(record.path);
    for (const std::string& path : arguments.sensitivities) {
      for (const Record& record : scene.records) names.push_back(derivative_name(record.path, path));
    }
    writer.header(names);
    std::vector<RowStore::Reader> readers;
    for (const Sensitivity& one : derivatives) readers.push_back(one.rows.read());
    settings.row = [&](double time, const std::vector<double>& values) {
      std::vector<double> all = values;
      for (RowStore::Reader& reader : readers) {
        const double* const row = reader.next();
        if (!row) return;
        all.insert(all.end(), row + 1, row + 1 + values.size());
      }
      writer.row(time, all);
    };
    return run(plain, settings);
  });
}

std::string describe(const Scene& scene, const std::vector<Sensitivity>& derivatives, const std::vector<std::string>& paths) {
  std::vector<std::vector<std::string>> rows{{"by", "record", "largest derivative", "at", "estimated error"}};
  for (std::size_t p = 0; p < derivatives.size(); ++p) {
    for (std::size_t k = 0; k < scene.records.size(); ++k) {
      const Sensitivity::Record& record = derivatives[p].records[k];
      const std::string unit = unit_text(scene, scene.records[k]);
      rows.push_back({k == 0 ? paths[p] : "", scene.records[k].path, readable(record.largest, unit),
                      record.largest > 0 ? readable(record.time, "s") : "-", readable(record.error, unit, 2)});
    }
  }
  return "  change of each record for a relative change of the value, divided by that change:\n" + aligned(rows);
}

}  // namespace rheonet::tool
