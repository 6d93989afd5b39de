#include "tools/serve/tasks.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/network/component.hpp"
#include "core/network/error.hpp"
#include "core/result/memory_file.hpp"
#include "core/result/run.hpp"
#include "tools/plot/compose.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/report/document.hpp"
#include "tools/rheonet/both_sides.hpp"
#include "tools/rheonet/plot_source.hpp"
#include "tools/serve/analyses.hpp"
#include "tools/serve/lesson.hpp"
#include "tools/serve/sent_scene.hpp"

namespace rheonet::serve {
namespace {

using nlohmann::json;
using report::Tell;

using Offers = std::vector<const FileOffer*>;

/// The netlist with the records that its page shows.
ReadResult read(const SentScene& item, const Offers& offers) {
  ReadOptions options;
  options.plotted = true;
  return read_sent(item, offers, options);
}

void tell_file(const Tell& tell, const std::string& type, const std::string& text) {
  tell(report::to_line({{"kind", "file"}, {"type", type}, {"text", text}}));
}

/// Sends everything that a page shows of a scene.
void show(const json& task, const Offers& offers, const Tell& tell) {
  const SentScene item = sent_scene(task);
  ReadResult scene = read(item, offers);
  tell(report::mistakes_message(scene));
  if (!scene.scene) return;
  const std::size_t own = report::record_what_pages_show(*scene.scene);
  tell(report::scene_message(scene, item.file, own));
  if (!task.value("draw", false)) report::tell_run(scene, {.most_values = 60'000, .as_they_come = true}, tell);
}

/// Sends the explanation of the equations. It is a separate task because it starts the run, which takes a moment.
void explain_to_page(const json& task, const Offers& offers, const Tell& tell) {
  const ReadResult scene = read(sent_scene(task), offers);
  tell(report::mistakes_message(scene));
  if (scene.scene) tell(report::explanation_message(*scene.scene));
}

/// Sends all rows with all digits.
void csv(const json& task, const Offers& offers, const Tell& tell) {
  const ReadResult scene = read(sent_scene(task), offers);
  tell(report::mistakes_message(scene));
  if (!scene.scene) return;
  MemoryFile rows;
  std::string failure;
  try {
    run(*scene.scene, {.csv = rows.file()});
  } catch (const SimulationError& error) {
    failure = error.what();
  }
  if (failure.empty())
    tell_file(tell, "text/csv", std::string(rows.text()));
  else
    tell(report::to_line({{"kind", "failed"}, {"message", failure}}));
}

void report_of(const json& task, const Offers& offers, const Tell& tell) {
  std::vector<std::vector<std::string>> scenes;
  std::string title;
  for (const json& each : task.at("scenes")) {
    const SentScene item = sent_scene(each);
    ReadResult scene = read(item, offers);
    if (!scene.scene) return tell(report::mistakes_message(scene));
    if (title.empty()) title = scene.scene->title.empty() ? item.file : scene.scene->title;
    std::vector<std::string> messages{report::mistakes_message(scene)};
    messages.push_back(report::explanation_message(*scene.scene));
    const std::size_t own = report::record_what_pages_show(*scene.scene);
    messages.push_back(report::scene_message(scene, item.file, own));
    report::tell_run(scene, {}, [&](const std::string& message) { messages.push_back(message); });
    scenes.push_back(std::move(messages));
  }
  tell_file(tell, "text/html", report::document(title, scenes));
}

plot::Shown unit_of(const json& unit) { return {unit.at("name").get<std::string>(), unit.at("factor").get<double>()}; }

/// Simulates a scene for the curves that its page shows.
void add_curves(const json& item, const Offers& offers, std::vector<plot::Measured>& curves, plot::Look& look, const Tell& tell) {
  ReadResult scene = read(sent_scene(item), offers);
  if (!scene.scene) return tell(report::mistakes_message(scene));
  if (look.title.empty()) look.title = scene.scene->title;
  report::record_what_pages_show(*scene.scene);
  const std::vector<plot::Column> columns = tool::columns_of(*scene.scene);
  const auto find = [&](const json& name) {
    return static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(), [&](const plot::Column& c) { return name == c.name; }) - columns.begin());
  };
  std::vector<plot::ColumnPair> pairs;
  const std::size_t first = curves.size();
  for (const json& curve : item.at("curves")) {
    const std::size_t x = find(curve.at("x")), y = find(curve.at("y"));
    if (x == columns.size() || y == columns.size()) continue;
    pairs.emplace_back(x, y);
    const plot::Style style{curve.at("color").get<std::string>(), curve.at("dashes").get<std::string>()};
    curves.push_back({curve.at("name").get<std::string>(), columns[x], columns[y], {}, style, curve.at("panel").get<int>(), unit_of(curve.at("x_unit")), unit_of(curve.at("y_unit"))});
  }
  tool::BothSides drawn([&](double time, const std::vector<double>& values) {
    const auto value = [&](std::size_t column) { return column == 0 ? time : values[column - 1]; };
    for (std::size_t k = 0; k < pairs.size(); ++k) curves[first + k].trace.add({value(pairs[k].first), value(pairs[k].second)});
  });
  RunSettings settings;
  drawn.listen(settings);
  run(*scene.scene, settings);
}

/// Sends curves as SVG, in the colours and units of the page.
void figure(const json& task, const Offers& offers, const Tell& tell) {
  std::vector<plot::Measured> curves;
  plot::Look look;
  for (const json& item : task.at("scenes")) add_curves(item, offers, curves, look, tell);
  if (curves.empty()) throw plot::Mistake("there is nothing to draw", "choose what is to be shown");
  std::vector<std::string> notes;
  tell_file(tell, "image/svg+xml", plot::svg(plot::compose(std::move(curves), look, notes)));
}

}  // namespace

void carry_out(const json& task, const Offers& offers, const Tell& tell) {
  const auto failed = [&](const char* why) { tell(report::to_line({{"kind", "failed"}, {"message", why}})); };
  try {
    const std::string kind = task.at("task").get<std::string>();
    if (kind == "catalogue") return tell(report::catalogue_message());
    if (kind == "show") return show(task, offers, tell);
    if (kind == "explain") return explain_to_page(task, offers, tell);
    if (kind == "csv") return csv(task, offers, tell);
    if (kind == "report") return report_of(task, offers, tell);
    if (kind == "figure") return figure(task, offers, tell);
    if (kind == "effects") return weigh_effects(task, offers, tell);
    if (kind == "precision") return price_accuracy(task, offers, tell);
    if (kind == "sweep") return sweep_number(task, offers, tell);
    if (kind == "lesson") return tell_lesson(task, offers, tell);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    failed(error.what());
  }
}

}  // namespace rheonet::serve
