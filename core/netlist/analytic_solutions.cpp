#include "core/netlist/analytic_solutions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/netlist/counting.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

const char* const exact_example = "\"k1.force\" = \"k*x0*exp(-t*k/B)\"";

/// One entry of `[exact]`: a path (a string with its place) and the closed form.
struct Entry {
  TomlValue path;
  const TomlValue* form;
};

/// Without quotes, TOML reads `k1.force = "..."` as a table `k1`; it means the same here.
void gather_entries(const TomlValue& table, const std::string& before, std::vector<Entry>& entries) {
  for (const TomlEntry& entry : table.entries) {
    if (entry.value.is_table()) {
      gather_entries(entry.value, before + entry.key + '.', entries);
      continue;
    }
    TomlValue path;
    path.kind = TomlValue::Kind::string;
    path.spot = entry.spot;
    path.text = before + entry.key;
    entries.push_back({std::move(path), &entry.value});
  }
}

void flatten(const Environment& environment, Environment& all) {
  all.names.insert(environment.names.begin(), environment.names.end());  // inner names hide outer ones
  if (environment.outer) flatten(*environment.outer, all);
}

/// The time as a number. It has no unit if no parameter has one.
Number time_of(double t, const Environment& parameters, Domain domain) {
  const bool plain = std::all_of(parameters.names.begin(), parameters.names.end(),
                                 [](const auto& named) { return named.second.plain; });
  if (plain) return {.value = t, .dimension = {}, .plain = true};
  return {.value = t, .dimension = dimension_of(Quantity::time, domain), .plain = false, .typed_time = 1};
}

}  // namespace

void read_analytic_solutions(const TomlValue& exact, const Environment& environment, const std::set<std::string>& doubtful,
                Context& context, Scene& scene) {
  DiagnosticList& diagnostics = context.diagnostics;
  if (!expect_table(exact, "`exact`", diagnostics, exact_example)) return;
  std::vector<Entry> entries;
  gather_entries(exact, "", entries);
  std::vector<TomlValue> paths;
  for (const Entry& entry : entries) paths.push_back(entry.path);
  const auto records = find_records(paths, doubtful, context, scene);

  const auto parameters = std::make_shared<Environment>();
  flatten(environment, *parameters);
  const auto at_time = [parameters, domain = context.domain](double t) {
    Environment at;
    at.names.emplace("t", time_of(t, *parameters, domain));
    at.outer = parameters.get();
    return at;
  };
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!records[i]) continue;
    const TomlValue& source = *entries[i].form;
    const std::string& path = entries[i].path.text;
    const auto recorded = std::find_if(scene.records.begin(), scene.records.end(),
                                       [&](const Record& record) { return record.path == records[i]->path; });
    if (recorded == scene.records.end()) {
      diagnostics.error(entries[i].path.spot, "`" + path + "` is not recorded", "add it to `record` in [simulate]");
      continue;
    }
    const Formula formula(source, "`" + path + "`", diagnostics);
    if (!formula.given()) continue;
    const auto last = formula.evaluate(at_time(scene.stop), diagnostics);
    if (!last) continue;
    const Number unit = one_of(unit_of(scene, *recorded));
    if (!fits(*last, unit)) {
      diagnostics.error(source.spot, fmt::format("`{}`: expected {}, found {}", path, describe(unit), describe(*last)));
      continue;
    }
    ExactRecord form{.record = static_cast<int>(recorded - scene.records.begin()), .value = {}, .spot = source.spot};
    if (source.is_string()) {
      form.value = [at_time, text = source.text](double t) {
        const auto result = evaluate_text(text, at_time(t));
        const Number* number = std::get_if<Number>(&result);
        return number && std::isfinite(number->value) ? number->value : not_given;
      };
    } else {
      form.value = [value = last->value](double) { return value; };
    }
    scene.exact.push_back(std::move(form));
  }
}

}  // namespace rheonet
