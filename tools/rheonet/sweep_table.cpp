#include "tools/rheonet/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/netlist/characters.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/expression.hpp"
#include "core/network/error.hpp"
#include "tools/rheonet/claims.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

const SweepFigure figures[] = {
    {"energy dissipated", [](const Summary& s) { return s.dissipated; }, "J", true},
    {"energy supplied", [](const Summary& s) { return s.supplied; }, "J", true},
    {"energy stored", [](const Summary& s) { return s.stored; }, "J", true},
    {"steps", [](const Summary& s) { return static_cast<double>(s.steps); }, "1"},
    {"events", [](const Summary& s) { return static_cast<double>(s.events); }, "1"},
};

void append_number(std::string& text, double value) {
  text += ',';
  // A value that does not exist, such as the time of a crossing that never happens, is an empty cell.
  if (std::isfinite(value)) fmt::format_to(std::back_inserter(text), "{}", value + 0.0);  // Prints -0 as 0.
}

/// The number in a text; absent if the text is not a number without reference to other values.
std::optional<Number> number_of(const std::string& value) {
  const auto read = evaluate_text(value, Environment{});
  const Number* number = std::get_if<Number>(&read);
  return number ? std::optional(*number) : std::nullopt;
}

/// The SI unit of a number as a user would type it: the unit of a quantity with the same dimension, N*s/m rather than kg/s.
std::string unit_of_number(const Number& number) {
  constexpr Quantity quantities[] = {Quantity::number, Quantity::time,     Quantity::frequency, Quantity::position, Quantity::velocity,
                                     Quantity::force,  Quantity::stiffness, Quantity::damping,  Quantity::mass};
  for (const Domain domain : {Domain::translation, Domain::rotation})
    for (const Quantity quantity : quantities) {
      const std::string name = unit_of(quantity, domain);
      const auto parsed = parse_unit(name);
      const Unit* unit = std::get_if<Unit>(&parsed);
      if (unit && unit->factor == 1 && unit->radian == number.radian && unit->hertz == number.hertz &&
          unit->dimension.same(number.dimension))
        return name;
    }
  return to_string(number.dimension);
}

/// The unit of the first of some values that has one; "1" if none has.
std::string unit_of_values(const std::vector<std::vector<std::string>>& points, std::size_t column) {
  for (const std::vector<std::string>& point : points)
    if (const std::optional<Number> number = number_of(point[column]); number && !number->plain) return unit_of_number(*number);
  return "1";
}

std::string unit_of_column(const Scene& scene, const Record& record) { return unit_of(scene, record).open ? "" : unit_text(scene, record); }

std::string heading(const std::string& name, const std::string& unit) {
  return ',' + cell(unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit));
}

}  // namespace

bool is_number(const std::string& value) { return number_of(value).has_value(); }

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
      if (text != figure.name) continue;
      measure.figure = &figure;
      measure.unit = figure.unit;
    }
    if (measure.figure) continue;
    const std::string meant = nearest(text, names);
    return NoVariation{fmt::format("`--measure {}` is no measure", text),
                       meant.empty() ? "for instance max(k1.force), or energy dissipated" : fmt::format("did you mean `{}`?", meant)};
  }
  return table;
}

std::vector<std::string> SweepTable::measure_names() const {
  std::vector<std::string> names;
  for (const Measure& measure : measures_) names.push_back(measure.text);
  return names;
}

std::vector<std::string> SweepTable::measure_units() const {
  std::vector<std::string> units;
  for (const Measure& measure : measures_) units.push_back(measure.unit);
  return units;
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

void SweepTable::set_scene(const Scene& scene) {
  std::size_t claim = 0;
  for (Measure& measure : measures_)
    if (!measure.figure) measure.unit = unit_of_claim(scene.claims[claim++], scene);
  if (measures()) return;
  for (const Record& record : scene.records)
    records_.push_back({record.path, unit_of_column(scene, record)});
}

std::vector<SweepTable::Heading> SweepTable::headings(const std::vector<std::vector<std::string>>& points) const {
  std::vector<Heading> all{{"run", "1"}};
  for (std::size_t k = 0; k < paths_.size(); ++k) all.push_back({paths_[k], unit_of_values(points, k)});
  if (!measures()) all.push_back({"time", "s"});
  for (const Measure& measure : measures_) all.push_back({measure.text, measure.unit});
  for (const RecordColumn& record : records_) all.push_back({record.path, record.unit});
  all.push_back({"error", ""});
  return all;
}

std::string SweepTable::header(const std::vector<std::vector<std::string>>& points) const {
  std::string text;
  for (const Heading& h : headings(points)) text += heading(h.name, h.unit);
  return text.substr(1) + '\n';
}

tables::Layout SweepTable::layout(const std::string& title, const std::vector<std::vector<std::string>>& points, const std::vector<bool>& is_text) const {
  using Kind = tables::Column::Kind;
  tables::Layout layout{.title = title, .program = "", .row = measures() ? "run" : "row", .columns = {}};
  for (const Heading& h : headings(points)) layout.columns.push_back({h.name, h.unit});
  layout.columns.front().kind = Kind::whole_number;
  layout.columns.back().kind = Kind::text;
  for (std::size_t k = 0; k < is_text.size(); ++k)
    if (is_text[k]) layout.columns[1 + k].kind = Kind::text;
  return layout;
}

std::string SweepTable::key(long run, const std::vector<std::string>& values) {
  std::string text = fmt::format("{},", run);
  for (const std::string& value : values) {
    const std::optional<Number> number = number_of(value);
    text += (number ? fmt::format("{}", number->value) : cell(value)) + ',';
  }
  return text;
}

std::string SweepTable::row(const std::string& key, const Summary& summary) const {
  std::string text = key;
  text.pop_back();  // Each number adds its own comma.
  for (const double value : values(summary)) append_number(text, value);
  return text + ",\n";
}

std::vector<double> SweepTable::values(const Summary& summary) const {
  std::vector<double> all;
  std::size_t finding = 0;
  for (const Measure& measure : measures_) all.push_back(measure.figure ? measure.figure->of(summary) : summary.findings[finding++].found);
  return all;
}

void SweepTable::append(std::string& text, const std::string& key, double time, const std::vector<double>& values) {
  text.append(key, 0, key.size() - 1);
  append_number(text, time);
  for (const double value : values) append_number(text, value);
  text += ",\n";
}

void SweepTable::check_columns(const Scene& scene) const {
  std::size_t claim = 0;
  const auto check_unit = [](const std::string& column, const std::string& unit, const std::string& here) {
    if (here != unit) throw SimulationError(fmt::format("`{}` has the unit {} here, and {} in the column", column, here, unit));
  };
  for (const Measure& measure : measures_)
    if (!measure.figure) check_unit(measure.text, measure.unit, unit_of_claim(scene.claims[claim++], scene));
  if (measures()) return;
  const auto same = [](const RecordColumn& column, const Record& record) { return column.path == record.path; };
  if (std::equal(records_.begin(), records_.end(), scene.records.begin(), scene.records.end(), same)) {
    for (std::size_t k = 0; k < records_.size(); ++k) check_unit(records_[k].path, records_[k].unit, unit_of_column(scene, scene.records[k]));
    return;
  }
  throw SimulationError("it records other quantities than the first run, whose columns these are; `record` in [simulate] names some that all have");
}

std::string SweepTable::failed(const std::string& key, const std::string& why) const {
  const std::size_t empty = measures() ? measures_.size() : 1 + records_.size();
  return key + std::string(empty, ',') + cell(why) + '\n';
}

}  // namespace rheonet::tool
