#include "tools/rheonet/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/netlist/characters.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/expression.hpp"
#include "core/network/error.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

const SweepFigure figures[] = {
    {"energy dissipated", [](const Summary& s) { return s.dissipated; }, true},
    {"energy supplied", [](const Summary& s) { return s.supplied; }, true},
    {"energy stored", [](const Summary& s) { return s.stored; }, true},
    {"steps", [](const Summary& s) { return static_cast<double>(s.steps); }},
    {"events", [](const Summary& s) { return static_cast<double>(s.events); }},
};

void append_number(std::string& text, double value) {
  text += ',';
  // There is none: what is never crossed, say.
  if (std::isfinite(value)) fmt::format_to(std::back_inserter(text), "{}", value + 0.0);  // no -0
}

}  // namespace

std::variant<SweepTable, NoVariation> SweepTable::make(const std::vector<std::string>& paths,
                                                       const std::vector<std::string>& measures) {
  SweepTable table;
  table.paths_ = paths;
  for (const std::string& text : measures) {
    const auto same = [&](const Measure& m) { return m.text == text; };
    if (std::any_of(table.measures_.begin(), table.measures_.end(), same)) continue;
    Measure& measure = table.measures_.emplace_back();
    measure.text = text;
    if (text.find('(') != text.npos) continue;
    std::vector<std::string> names;
    for (const SweepFigure& figure : figures) {
      names.emplace_back(figure.name);
      if (text == figure.name) measure.figure = &figure;
    }
    if (measure.figure) continue;
    const std::string meant = nearest(text, names);
    return NoVariation{fmt::format("`--measure {}` is no measure", text),
                       meant.empty() ? "for instance max(k1.force), or energy dissipated" : fmt::format("did you mean `{}`?", meant)};
  }
  return table;
}

bool SweepTable::needs_account() const {
  return std::any_of(measures_.begin(), measures_.end(), [](const Measure& m) { return m.figure && m.figure->of_energy; });
}

std::vector<std::string> SweepTable::record_measures() const {
  std::vector<std::string> texts;
  for (const Measure& measure : measures_)
    if (!measure.figure) texts.push_back(measure.text);
  return texts;
}

void SweepTable::set_records(const std::vector<Record>& records) {
  for (const Record& record : records) records_.push_back(record.path);
}

std::string SweepTable::header() const {
  std::string text = "run";
  for (const std::string& path : paths_) text += ',' + cell(path);
  if (!measures()) text += ",time";
  for (const Measure& measure : measures_) text += ',' + cell(measure.text);
  for (const std::string& record : records_) text += ',' + cell(record);
  return text + ",error\n";
}

std::string SweepTable::key(long run, const std::vector<std::string>& values) {
  std::string text = fmt::format("{},", run);
  for (const std::string& value : values) {
    const auto read = evaluate_text(value, Environment{});
    const Number* number = std::get_if<Number>(&read);
    text += (number ? fmt::format("{}", number->value) : cell(value)) + ',';
  }
  return text;
}

std::string SweepTable::row(const std::string& key, const Summary& summary) const {
  std::string text = key;
  text.pop_back();  // each number brings its comma
  std::size_t finding = 0;
  for (const Measure& measure : measures_)
    append_number(text, measure.figure ? measure.figure->of(summary) : summary.findings[finding++].found);
  return text + ",\n";
}

void SweepTable::append(std::string& text, const std::string& key, double time, const std::vector<double>& values) {
  text.append(key, 0, key.size() - 1);
  append_number(text, time);
  for (const double value : values) append_number(text, value);
  text += ",\n";
}

void SweepTable::check_records(const std::vector<Record>& records) const {
  if (measures()) return;
  const auto same = [](const std::string& path, const Record& record) { return path == record.path; };
  if (std::equal(records_.begin(), records_.end(), records.begin(), records.end(), same)) return;
  throw SimulationError("it records other quantities than the first run, whose columns these are; `record` in [simulate] names some that all have");
}

std::string SweepTable::failed(const std::string& key, const std::string& why) const {
  const std::size_t empty = measures() ? measures_.size() : 1 + records_.size();
  return key + std::string(empty, ',') + cell(why) + '\n';
}

}  // namespace rheonet::tool
