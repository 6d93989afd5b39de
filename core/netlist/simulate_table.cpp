#include "core/netlist/simulate_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/netlist/keys.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

constexpr double finest_accuracy = 1e-12;  // limit of double precision
constexpr double coarsest_accuracy = 0.1;
constexpr double default_points = 501;  // smooth on a screen
constexpr double most_rows = 1e8;       // some GB of CSV for each column

bool check_accuracy(double accuracy, Spot spot, Mistakes& mistakes) {
  if (accuracy >= finest_accuracy && accuracy <= coarsest_accuracy) return true;
  mistakes.error(spot, "`accuracy` must be from 1e-12 to 0.1, but is " + number_text(accuracy));
  return false;
}

void read_output(const TomlEntry* output, const Environment& environment, Context& context, Scene& scene) {
  Mistakes& mistakes = context.mistakes;
  const double length = scene.stop - scene.start;  // NaN if start or stop has a mistake
  const auto spread = [&](double points) {
    scene.output_intervals = static_cast<std::int64_t>(points) - 1;
    scene.output_every = length / (points - 1);
  };
  spread(default_points);
  if (!output ||
      !expect_table(output->value, "`output`", mistakes, "output = { every = \"1 ms\" } or { points = 201 }"))
    return;
  Keys keys(output->value, "`output`");
  const TomlEntry* every = keys.find("every");
  const TomlEntry* points = keys.find("points");
  const TomlEntry* events = keys.find("events");
  keys.finish(mistakes);
  scene.output_events = events && expect_boolean(events->value, "`events`", mistakes) && events->value.boolean;
  if (every && points) {
    refuse_both(*every, *points, "`output`", mistakes);
    return;
  }
  const TomlEntry* given = every ? every : points;
  if (!given) return;
  const Formula formula(given->value, "`" + given->key + "`", mistakes);
  if (!formula.given()) return;
  const auto value =
      formula.evaluate_finite(environment, every ? Quantity::time : Quantity::number, context.domain, mistakes);
  if (!value) return;
  const Spot spot = given->value.spot;
  if (every && *value <= 0) {
    mistakes.error(spot, "`every` must be greater than 0 s, but is " + number_text(*value) + " s");
  } else if (every && *value > length * (1 + time_rounding)) {
    mistakes.error(spot, "`every` is longer than the run: " + number_text(*value) + " s, the run takes " +
                             number_text(length) + " s");
  } else if (points && (*value < 2 || *value != std::floor(*value))) {
    mistakes.error(spot, "`points` must be a whole number of at least 2, but is " + number_text(*value));
  } else if (const double rows = every ? std::floor(length / *value + time_rounding) + 1 : *value; rows > most_rows) {
    mistakes.error(
        spot, "`output` asks for " + number_text(rows) + " rows; at most " + number_text(most_rows) + " are written");
  } else if (points) {
    spread(*value);
  } else if (!std::isnan(rows)) {
    scene.output_every = *value;
    scene.output_intervals = static_cast<std::int64_t>(rows) - 1;
  }
}

void read_start_from(const TomlEntry* entry, Mistakes& mistakes, Scene& scene) {
  if (!entry || !expect_string(entry->value, "`start_from`", mistakes)) return;
  const std::vector<std::string> words{"given", "rest", "steady"};  // in the order of Scene::StartFrom
  const auto found = std::find(words.begin(), words.end(), entry->value.text);
  if (found == words.end()) {
    mistakes.error(entry->value.spot,
                   "`start_from` must be `given`, `rest` or `steady`, but is `" + entry->value.text + "`",
                   did_you_mean(entry->value.text, words));
    return;
  }
  scene.start_from = static_cast<Scene::StartFrom>(found - words.begin());
}

}  // namespace

const TomlEntry* read_simulate(const TomlEntry& simulate, const Environment& environment, Context& context,
                               Scene& scene) {
  Mistakes& mistakes = context.mistakes;
  if (!expect_table(simulate.value, "`simulate`", mistakes)) return nullptr;
  Keys keys(simulate.value, "[simulate]");
  const auto value = [&](const TomlEntry* entry, Quantity quantity, double otherwise) {
    if (!entry) return otherwise;
    const Formula formula(entry->value, "`" + entry->key + "`", mistakes);
    if (!formula.given()) return not_given;
    return formula.evaluate_finite(environment, quantity, context.domain, mistakes).value_or(not_given);
  };
  scene.start = value(keys.find("start"), Quantity::time, 0);
  read_start_from(keys.find("start_from"), mistakes, scene);
  const TomlEntry* stop = keys.require("stop", simulate.spot, "when the run ends: stop = \"1 s\"");
  scene.stop = value(stop, Quantity::time, not_given);
  if (scene.stop <= scene.start) {
    mistakes.error(stop->value.spot, "`stop` must be later than `start`, " + number_text(scene.start) + " s, but is " +
                                         number_text(scene.stop) + " s");
    scene.stop = not_given;
  }
  if (const TomlEntry* accuracy = keys.find("accuracy")) {
    const double wanted = value(accuracy, Quantity::number, not_given);
    if (!std::isnan(wanted) && check_accuracy(wanted, accuracy->value.spot, mistakes)) scene.accuracy = wanted;
  }
  read_output(keys.find("output"), environment, context, scene);
  const TomlEntry* record = keys.find("record");
  keys.finish(mistakes);
  return record;
}

void override_accuracy(double accuracy, Context& context, Sources& sources, Scene& scene) {
  constexpr std::string_view option = "--accuracy ";
  sources.command_line.push_back(std::string(option) + number_text(accuracy));
  const Spot spot{Spot::command_line, static_cast<int>(sources.command_line.size()), 1 + static_cast<int>(option.size())};
  if (check_accuracy(accuracy, spot, context.mistakes)) scene.accuracy = accuracy;
}

}  // namespace rheonet
