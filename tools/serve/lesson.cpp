#include "tools/serve/lesson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/netlist/document.hpp"
#include "core/netlist/table_reader.hpp"
#include "tools/report/adjustable_numbers.hpp"
#include "tools/serve/sent_scene.hpp"

namespace rheonet::serve {
namespace {

using nlohmann::json;

const std::vector<std::string> levels{"beginner", "intermediate", "advanced"};
constexpr const char* time_name = "time";
constexpr int curve_points = 400;
constexpr std::size_t most_items = 50;  // Choices, and presets: the netlist is read anew for each, and links carry lessons of strangers.

/// The text as a TOML string.
std::string quoted(const std::string& text) { return json(text).dump(); }

/// Reads a lesson and checks it against its netlist.
class LessonReader {
 public:
  LessonReader(const SentScene& netlist, const std::vector<const FileOffer*>& offers, std::string language, const std::string& file, std::string text)
      : netlist_(netlist), offers_(offers), language_(std::move(language)) {
    lesson_.sources.files.push_back({file, std::move(text)});
  }

  /// The message of the lesson; null if it has mistakes.
  json read();
  /// The mistakes, as report::mistakes_message takes them.
  const ReadResult& lesson() const { return lesson_; }

 private:
  std::string text_of(const TomlEntry& entry);
  std::string required_text(TableReader& reader, const char* key, Spot where);
  std::string optional_text(TableReader& reader, const char* key);
  json read_demo(const TomlEntry* entry);
  json read_prediction(const TomlEntry& entry);
  json read_choice(const TomlValue& table, const std::string& x, const std::string& y);
  json read_range(const TomlEntry& entry, const std::string& record);
  json read_presets(const TomlEntry& entry);
  bool expect_few(const TomlEntry& list);
  json read_values(const TomlValue& table, const std::string& name);
  std::optional<std::vector<double>> course_of(const TomlEntry& form, const std::string& record);
  std::optional<std::vector<double>> drawn_course(const TomlEntry& form);
  std::optional<Scene> scene_with(const std::vector<std::string>& overrides, const std::string& record, const TomlValue& source, const std::string& what);

  const SentScene& netlist_;
  const std::vector<const FileOffer*>& offers_;
  std::string language_;
  ReadResult lesson_;  // Sources and mistakes only, no scene.
  DiagnosticList diagnostics_{lesson_.sources};
  ReadResult plain_;  // The unmodified netlist.
};

json LessonReader::read() {
  json told;
  try {
    const std::optional<TomlValue> document = parse_toml(0, lesson_.sources, diagnostics_);
    ReadOptions options;
    options.plotted = true;
    plain_ = read_sent(netlist_, offers_, options);
    if (document && plain_.scene) {
      TableReader reader(*document, "a lesson");
      const Spot top{0, 1, 1};
      told["kind"] = "lesson";
      if (const TomlEntry* level = reader.require("level", top, "level = \"beginner\""); level && expect_string(level->value, "`level`", diagnostics_)) {
        if (std::find(levels.begin(), levels.end(), level->value.text) == levels.end())
          diagnostics_.error(level->value.spot, fmt::format("`{}` is no level", level->value.text), "a level is " + list_names(levels));
        told["level"] = level->value.text;
      }
      if (const TomlEntry* minutes = reader.require("minutes", top, "how long it takes: minutes = 10")) {
        if (minutes->value.kind != TomlValue::Kind::number || !(minutes->value.number > 0))
          diagnostics_.error(minutes->value.spot, "`minutes` is a number above 0, not " + describe(minutes->value));
        told["minutes"] = minutes->value.number;
      }
      if (const TomlEntry* title = reader.find("title"); title && expect_table(title->value, "`title`", diagnostics_, "the title of the netlist in another language: title.de = \"...\"")) {
        text_of(*title);
      }
      told["demo"] = read_demo(reader.find("demo"));
      told["explain"] = optional_text(reader, "explain");
      if (const TomlEntry* predict = reader.require("predict", top, "[predict] asks what the student expects"); predict) told["predict"] = read_prediction(*predict);
      const TomlEntry* presets = reader.find("presets");
      told["presets"] = presets ? read_presets(*presets) : json::array();
      reader.finish(diagnostics_);
    }
  } catch (const TooManyDiagnostics&) {
    // The mistakes found so far are reported.
  }
  lesson_.diagnostics = diagnostics_.sorted();
  return diagnostics_.errors() > 0 || !plain_.scene ? json() : told;
}

/// A text in the language of the page, else in English, else in any language.
std::string LessonReader::text_of(const TomlEntry& entry) {
  if (entry.value.is_string()) return entry.value.text;
  const std::string what = "`" + entry.key + "`";
  if (!expect_table(entry.value, what, diagnostics_, entry.key + " = \"...\", or in several languages " + entry.key + " = { en = \"...\", de = \"...\" }")) return "";
  for (const TomlEntry& each : entry.value.entries) {
    const bool is_code = each.key.size() == 2 && std::all_of(each.key.begin(), each.key.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    if (!is_code) diagnostics_.error(each.spot, fmt::format("`{}` is no language", each.key), "a language has two letters: en, de, fr, es");
    expect_string(each.value, what, diagnostics_);
  }
  for (const std::string& language : {language_, std::string("en")})
    if (const TomlEntry* found = entry.value.find(language)) return found->value.text;
  return entry.value.entries.empty() ? "" : entry.value.entries.front().value.text;
}

std::string LessonReader::required_text(TableReader& reader, const char* key, Spot where) {
  const TomlEntry* entry = reader.require(key, where, std::string("a text: ") + key + " = \"...\"");
  return entry ? text_of(*entry) : "";
}

std::string LessonReader::optional_text(TableReader& reader, const char* key) {
  const TomlEntry* entry = reader.find(key);
  return entry ? text_of(*entry) : "";
}

/// The translations of the netlist's [demo] in the lesson.
json LessonReader::read_demo(const TomlEntry* entry) {
  const Demo& own = plain_.presentation.demo;
  json texts{{"question", own.question}, {"change", own.change}, {"see", own.see}, {"why", own.why}};
  if (!entry || !expect_table(entry->value, "`demo`", diagnostics_, "[demo] has texts of the netlist in other languages: question.de = \"...\"")) return texts;
  TableReader reader(entry->value, "[demo]");
  for (const char* key : {"question", "change", "see", "why"}) {
    const TomlEntry* other = reader.find(key);
    if (!other || !expect_table(other->value, std::string("`") + key + "`", diagnostics_, std::string("its text in another language: ") + key + ".de = \"...\"")) continue;
    text_of(*other);
    if (const TomlEntry* found = other->value.find(language_)) texts[key] = found->value.text;
  }
  reader.finish(diagnostics_);
  return texts;
}

json LessonReader::read_prediction(const TomlEntry& entry) {
  if (!expect_table(entry.value, "`predict`", diagnostics_)) return {};
  TableReader reader(entry.value, "[predict]");
  json told{{"prompt", required_text(reader, "prompt", entry.spot)}};
  Scene recorded = *plain_.scene;
  report::record_what_pages_show(recorded);
  const auto record = [&](const TomlEntry* given, bool may_be_time) -> std::string {
    if (!given || !expect_string(given->value, "`" + given->key + "`", diagnostics_)) return "";
    std::vector<std::string> paths;
    for (const Record& each : recorded.records) paths.push_back(each.path);
    if (may_be_time) paths.emplace_back(time_name);
    if (std::find(paths.begin(), paths.end(), given->value.text) != paths.end()) return given->value.text;
    diagnostics_.error(given->value.spot, fmt::format("the netlist has no record `{}`", given->value.text),
                       did_you_mean(given->value.text, paths, "a record is named as in `simulate.record`: k1.force"));
    return "";
  };
  const std::string y = record(reader.require("y", entry.spot, "the record that is predicted: y = \"k1.force\""), false);
  const TomlEntry* across = reader.find("x");
  const std::string x = across ? record(across, true) : time_name;
  const TomlEntry* range = reader.find("range");
  const TomlEntry* choices = reader.find("choices");
  reader.finish(diagnostics_);
  told["x"] = x;
  told["y"] = y;
  if (x.empty() || y.empty()) return told;
  if (!choices) {
    if (x != time_name) diagnostics_.error(across->value.spot, "a curve that is sketched goes over time", "leave out `x`, or give `choices`");
    if (!range) diagnostics_.error(entry.spot, "a curve that is sketched needs the `range` of its axis", "range = [\"-1 N\", \"5 N\"]; or give `choices`");
    else told["range"] = read_range(*range, y);
    told["start"] = plain_.scene->start;
    told["stop"] = plain_.scene->stop;
    return told;
  }
  if (range) diagnostics_.error(range->spot, "`range` is of a curve that is sketched; that of `choices` follows from their curves");
  if (!expect_array(choices->value, "`choices`", diagnostics_, "[[predict.choices]]") || !expect_few(*choices)) return told;
  int right = 0;
  for (const TomlValue& item : choices->value.items) {
    json choice = read_choice(item, x, y);
    if (!choice.is_object()) return told;  // Already reported.
    if (choice.value("right", false)) ++right;
    told["choices"].push_back(std::move(choice));
  }
  if (choices->value.items.size() < 2) diagnostics_.error(choices->value.spot, "there is nothing to choose: `choices` needs two or more");
  if (right != 1) diagnostics_.error(choices->spot, fmt::format("of the choices {} are right, and one must be", right), "mark the right one: right = true");
  return told;
}

bool LessonReader::expect_few(const TomlEntry& list) {
  if (list.value.items.size() <= most_items) return true;
  diagnostics_.error(list.spot, fmt::format("`{}` has {} items, and may have {}", list.key, list.value.items.size(), most_items));
  return false;
}

/// A choice without a curve `y` is a text alone.
json LessonReader::read_choice(const TomlValue& table, const std::string& x, const std::string& y) {
  if (!expect_table(table, "a choice", diagnostics_)) return {};
  TableReader reader(table, "a choice");
  json told{{"text", required_text(reader, "text", table.spot)}, {"reply", optional_text(reader, "reply")}, {"right", false}};
  if (const TomlEntry* right = reader.find("right"); right && expect_boolean(right->value, "`right`", diagnostics_)) told["right"] = right->value.boolean;
  const TomlEntry* up = reader.find("y");
  const TomlEntry* across = !up || x == time_name ? nullptr : reader.require("x", table.spot, "as `y`: the other side of the curve over the time t");
  reader.finish(diagnostics_);
  if (!up) return told;
  const Scene& scene = *plain_.scene;
  json time = json::array();
  for (int k = 0; k <= curve_points; ++k) time.push_back(scene.start + (scene.stop - scene.start) * k / curve_points);
  if (const auto course = course_of(*up, y)) told["y"] = *course;
  if (across) {
    if (const auto course = course_of(*across, x)) told["x"] = *course;
  } else {
    told["x"] = time;
  }
  told["time"] = std::move(time);
  return told;
}

/// The netlist with overrides and a record. A mistake in an override is reported at `source` in the lesson.
std::optional<Scene> LessonReader::scene_with(const std::vector<std::string>& overrides, const std::string& record, const TomlValue& source, const std::string& what) {
  ReadOptions options;
  options.overrides = overrides;
  options.claims = false;
  if (!record.empty()) options.records = {record};
  ReadResult read = read_sent(netlist_, offers_, options);
  for (const Diagnostic& each : read.diagnostics)
    if (each.severity == Severity::error) {
      diagnostics_.error(source.spot, what + ": " + each.message, each.hint);
      break;
    }
  return std::move(read.scene);
}

/// The values [SI] of a drawn curve, or of an expression of time and the netlist's parameters, as in [exact].
std::optional<std::vector<double>> LessonReader::course_of(const TomlEntry& form, const std::string& record) {
  if (form.value.kind == TomlValue::Kind::array) return drawn_course(form);
  if (!form.value.is_string() && form.value.kind != TomlValue::Kind::number) {
    diagnostics_.error(form.value.spot, "`" + form.key + "` is an expression, not " + describe(form.value));
    return {};
  }
  const std::string text = form.value.is_string() ? quoted(form.value.text) : fmt::format("{}", form.value.number);
  const auto scene = scene_with({fmt::format("exact={{{} = {}}}", quoted(record), text)}, record, form.value, "the curve `" + form.key + "`");
  if (!scene || scene->exact.empty()) return {};
  std::vector<double> values;
  for (int k = 0; k <= curve_points; ++k) values.push_back(scene->exact.front().value(scene->start + (scene->stop - scene->start) * k / curve_points));
  if (std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return values;
  diagnostics_.error(form.value.spot, "the curve `" + form.key + "` has no value at some times of the run");
  return {};
}

/// The values [SI] of a curve that is drawn: numbers [SI] at equal intervals from the start of the run to its end, joined by lines.
std::optional<std::vector<double>> LessonReader::drawn_course(const TomlEntry& form) {
  const std::vector<TomlValue>& items = form.value.items;
  const auto is_number = [](const TomlValue& item) { return item.kind == TomlValue::Kind::number && std::isfinite(item.number); };
  if (items.size() < 2 || !std::all_of(items.begin(), items.end(), is_number)) {
    diagnostics_.error(form.value.spot, "a curve `" + form.key + "` that is drawn has two or more numbers, in SI", form.key + " = [0, 0.5, 0.8, 0.9]");
    return {};
  }
  std::vector<double> values;
  for (int k = 0; k <= curve_points; ++k) {
    const double place = static_cast<double>(k) / curve_points * static_cast<double>(items.size() - 1);
    const std::size_t left = std::min(static_cast<std::size_t>(place), items.size() - 2);
    values.push_back(std::lerp(items[left].number, items[left + 1].number, place - static_cast<double>(left)));
  }
  return values;
}

/// The range of an axis: two values of the record's quantity [SI].
json LessonReader::read_range(const TomlEntry& entry, const std::string& record) {
  if (!expect_array(entry.value, "`range`", diagnostics_, "range = [\"-1 N\", \"5 N\"]")) return {};
  std::vector<double> ends;
  for (const TomlValue& item : entry.value.items)
    if (const auto course = course_of({entry.key, item.spot, item}, record)) ends.push_back(course->front());
  if (ends.size() != entry.value.items.size()) return {};  // Already reported.
  if (ends.size() != 2 || !(ends[0] < ends[1])) diagnostics_.error(entry.value.spot, "`range` is the least and the largest value of the axis");
  return ends;
}

json LessonReader::read_presets(const TomlEntry& entry) {
  json list = json::array();
  if (!expect_array(entry.value, "`presets`", diagnostics_, "[[presets]]") || !expect_few(entry)) return list;
  for (const TomlValue& item : entry.value.items) {
    if (!expect_table(item, "a preset", diagnostics_)) continue;
    TableReader reader(item, "a preset");
    json preset{{"name", required_text(reader, "name", item.spot)}, {"look", optional_text(reader, "look")}};
    const TomlEntry* values = reader.require("values", item.spot, "values = { \"parameters.B\" = \"50 N*s/m\" }");
    reader.finish(diagnostics_);
    if (values && expect_table(values->value, "`values`", diagnostics_)) preset["values"] = read_values(values->value, preset["name"]);
    list.push_back(std::move(preset));
  }
  return list;
}

/// The texts, as TOML, that replace numbers of the netlist.
json LessonReader::read_values(const TomlValue& table, const std::string& name) {
  std::vector<std::string> known;
  for (const report::AdjustableNumber& each : report::adjustable_numbers(plain_)) known.push_back(each.group + '.' + each.name);
  json told = json::object();
  std::vector<std::string> overrides;
  for (const TomlEntry& entry : table.entries) {
    if (std::find(known.begin(), known.end(), entry.key) == known.end()) {
      diagnostics_.error(entry.spot, fmt::format("`{}` is no number of the netlist that has a slider", entry.key), did_you_mean(entry.key, known, "a parameter is named `parameters.NAME`"));
      continue;
    }
    const bool is_number = entry.value.kind == TomlValue::Kind::number;
    if (!is_number && !expect_string(entry.value, "`" + entry.key + "`", diagnostics_)) continue;
    const std::string text = is_number ? fmt::format("{}", entry.value.number) : quoted(entry.value.text);
    overrides.push_back(entry.key + '=' + text);
    told[entry.key] = text;
  }
  if (!overrides.empty()) scene_with(overrides, "", table, fmt::format("the preset `{}`", name));
  return told;
}

}  // namespace

std::string lesson_file_of(const std::string& netlist) {
  return std::filesystem::path(netlist).replace_extension(".lesson").string();
}

LessonGlance glance_at_lesson(const std::string& text) {
  Sources sources;
  sources.files.push_back({"", text});
  DiagnosticList mistakes(sources);
  LessonGlance seen;
  const std::optional<TomlValue> document = parse_toml(0, sources, mistakes);
  if (!document) return seen;
  if (const TomlEntry* level = document->find("level")) seen.level = level->value.text;
  if (const TomlEntry* minutes = document->find("minutes")) seen.minutes = minutes->value.number;
  if (const TomlEntry* title = document->find("title")) {
    for (const TomlEntry& each : title->value.entries) {
      if (each.value.is_string()) seen.titles[each.key] = each.value.text;
    }
  }
  return seen;
}

void tell_lesson(const json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell) {
  const SentScene netlist = sent_scene(task);
  const std::string file = lesson_file_of(netlist.file);
  std::string why;
  std::optional<std::string> text = task.contains("lesson") ? task["lesson"].get<std::string>() : offers.front()->text_of(file, why);
  if (!text) return;
  LessonReader reader(netlist, offers, task.value("language", "en"), file, std::move(*text));
  const json lesson = reader.read();
  tell(report::mistakes_message(reader.lesson()));
  if (!lesson.is_null()) tell(report::to_line(lesson));
}

}  // namespace rheonet::serve
