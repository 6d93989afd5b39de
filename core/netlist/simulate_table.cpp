#include "core/netlist/simulate_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

constexpr double finest_accuracy = 1e-12;  // limit of double precision
constexpr double coarsest_accuracy = 0.1;
constexpr double default_points = 501;  // smooth on a screen
constexpr double most_rows = 1e8;       // some GB of CSV for each column

bool check_accuracy(double accuracy, Spot spot, DiagnosticList& diagnostics) {
  if (accuracy >= finest_accuracy && accuracy <= coarsest_accuracy) return true;
  diagnostics.error(spot, "`accuracy` must be from 1e-12 to 0.1, but is " + number_text(accuracy));
  return false;
}

void read_output(const TomlEntry* output, const Environment& environment, Context& context, Scene& scene) {
  DiagnosticList& diagnostics = context.diagnostics;
  const double length = scene.stop - scene.start;  // NaN if start or stop has a mistake
  const auto spread = [&](double points) {
    scene.output_intervals = static_cast<std::int64_t>(points) - 1;
    scene.output_every = length / (points - 1);
  };
  spread(default_points);
  if (!output ||
      !expect_table(output->value, "`output`", diagnostics, "output = { every = \"1 ms\" } or { points = 201 }"))
    return;
  TableReader reader(output->value, "`output`");
  const TomlEntry* every = reader.find("every");
  const TomlEntry* points = reader.find("points");
  const TomlEntry* events = reader.find("events");
  reader.finish(diagnostics);
  scene.output_events = events && expect_boolean(events->value, "`events`", diagnostics) && events->value.boolean;
  if (every && points) {
    refuse_both(*every, *points, "`output`", diagnostics);
    return;
  }
  const TomlEntry* given = every ? every : points;
  if (!given) return;
  const Formula formula(given->value, "`" + given->key + "`", diagnostics);
  if (!formula.given()) return;
  const auto value =
      formula.evaluate_finite(environment, every ? Quantity::time : Quantity::number, context.domain, diagnostics);
  if (!value) return;
  const Spot spot = given->value.spot;
  if (every && *value <= 0) {
    diagnostics.error(spot, "`every` must be greater than 0 s, but is " + number_text(*value) + " s");
  } else if (every && *value > length * (1 + time_rounding)) {
    diagnostics.error(spot, "`every` is longer than the run: " + number_text(*value) + " s, the run takes " +
                             number_text(length) + " s");
  } else if (points && (*value < 2 || *value != std::floor(*value))) {
    diagnostics.error(spot, "`points` must be a whole number of at least 2, but is " + number_text(*value));
  } else if (const double rows = every ? std::floor(length / *value + time_rounding) + 1 : *value; rows > most_rows) {
    diagnostics.error(
        spot, "`output` asks for " + number_text(rows) + " rows; at most " + number_text(most_rows) + " are written");
  } else if (points) {
    spread(*value);
  } else if (!std::isnan(rows)) {
    scene.output_every = *value;
    scene.output_intervals = static_cast<std::int64_t>(rows) - 1;
  }
}

/// The enumerator whose word is given; the words are in the order of the enumerators.
template <class Enumeration>
void read_one_of(const TomlEntry* entry, const std::vector<std::string>& words, DiagnosticList& diagnostics, Enumeration& chosen) {
  if (!entry || !expect_string(entry->value, "`" + entry->key + "`", diagnostics)) return;
  const auto found = std::find(words.begin(), words.end(), entry->value.text);
  if (found == words.end()) {
    std::string all;
    for (std::size_t k = 0; k < words.size(); ++k) all += (k == 0 ? "`" : k + 1 < words.size() ? ", `" : " or `") + words[k] + "`";
    diagnostics.error(entry->value.spot, "`" + entry->key + "` must be " + all + ", but is `" + entry->value.text + "`", did_you_mean(entry->value.text, words));
    return;
  }
  chosen = static_cast<Enumeration>(found - words.begin());
}

}  // namespace

const TomlEntry* read_simulate(const TomlEntry& simulate, const Environment& environment, Context& context,
                               Scene& scene) {
  DiagnosticList& diagnostics = context.diagnostics;
  if (!expect_table(simulate.value, "`simulate`", diagnostics)) return nullptr;
  TableReader reader(simulate.value, "[simulate]");
  const auto value = [&](const TomlEntry* entry, Quantity quantity, double otherwise) {
    if (!entry) return otherwise;
    const Formula formula(entry->value, "`" + entry->key + "`", diagnostics);
    if (!formula.given()) return not_given;
    return formula.evaluate_finite(environment, quantity, context.domain, diagnostics).value_or(not_given);
  };
  scene.start = value(reader.find("start"), Quantity::time, 0);
  read_one_of(reader.find("start_from"), {"given", "rest", "steady"}, diagnostics, scene.start_from);
  const TomlEntry* method = reader.find("method");
  read_one_of(method, {"auto", "ida", "exact"}, diagnostics, scene.method);
  if (method) scene.method_spot = method->value.spot;
  const TomlEntry* stop = reader.require("stop", simulate.spot, "when the run ends: stop = \"1 s\"");
  reader.find("stop_when");  // see StopCondition
  scene.stop = value(stop, Quantity::time, not_given);
  if (scene.stop <= scene.start) {
    diagnostics.error(stop->value.spot, "`stop` must be later than `start`, " + number_text(scene.start) + " s, but is " +
                                         number_text(scene.stop) + " s");
    scene.stop = not_given;
  }
  if (const TomlEntry* accuracy = reader.find("accuracy")) {
    const double wanted = value(accuracy, Quantity::number, not_given);
    if (!std::isnan(wanted) && check_accuracy(wanted, accuracy->value.spot, diagnostics)) scene.accuracy = wanted;
  }
  read_output(reader.find("output"), environment, context, scene);
  const TomlEntry* record = reader.find("record");
  reader.finish(diagnostics);
  return record;
}

void override_accuracy(double accuracy, Context& context, Sources& sources, Scene& scene) {
  constexpr std::string_view option = "--accuracy ";
  sources.command_line.push_back(std::string(option) + number_text(accuracy));
  const Spot spot{Spot::command_line, static_cast<int>(sources.command_line.size()), 1 + static_cast<int>(option.size())};
  if (check_accuracy(accuracy, spot, context.diagnostics)) scene.accuracy = accuracy;
}

}  // namespace rheonet
