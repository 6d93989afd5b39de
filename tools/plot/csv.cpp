#include "tools/plot/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/netlist/characters.hpp"
#include "core/netlist/csv_fields.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/scene.hpp"
#include "tools/plot/mistake.hpp"

namespace rheonet::plot {
namespace {

std::ifstream open(const std::string& path) {
  std::ifstream in(path);
  std::string nothing;
  if (!in || in.peek() == std::ifstream::traits_type::eof())
    throw Mistake(
        fmt::format("`{}` {}", path,
                    in.is_open() && in.eof() ? "is empty" : "cannot be read: " + std::string(std::strerror(errno))));
  return in;
}

/// Goes to the next line that is no remark; false at the end.
bool next(std::ifstream& in, std::string& line, long& number) {
  while (std::getline(in, line)) {
    if (++number == 1) drop_byte_order_mark(line);
    if (!is_csv_remark(line)) return true;
  }
  return false;
}

/// The quantity of a sweep's measure: that of k1.force for "max(k1.force, from 1 s)". Absent for a heading of another form.
std::optional<Measure> measure_of_figure(const CsvHeading& heading, std::optional<Domain> domain) {
  if (heading.square || heading.unit.empty()) return {};
  const auto record = measure_of_record(std::string(heading.unit.substr(0, heading.unit.find(','))), domain);
  return record && heading.name.starts_with("time of ") ? measure("time", "s") : record;
}

/// The quantity of a record, or of a measure of a record, in this unit: `k1.force` in N*m is a torque. A column that is neither
/// keeps its name.
std::string quantity_of(const std::string& name, const std::string& unit, const Unit& size) {
  const Measure given{name, unit, size};
  for (const Domain domain : {Domain::translation, Domain::rotation})
    for (const auto& known : {measure_of_record(name, domain), measure_of_figure(csv_heading(name), domain)})
      if (known && compatible(*known, given)) return known->quantity;
  return name;
}

Measure measure_of(const std::string& name, std::string_view unit, bool square, const std::string& place,
                   std::optional<Domain> domain) {
  if (!unit.empty()) {
    const std::variant<Unit, TextError> size = parse_unit(unit);
    if (const Unit* known = std::get_if<Unit>(&size))
      return {quantity_of(name, std::string(unit), *known), std::string(unit), *known};
    if (square) {
      const TextError& wrong = std::get<TextError>(size);
      throw Mistake(fmt::format("{}: `{}` is no unit: {}", place, unit, wrong.message), wrong.hint);
    }
    return {name, "", {}};  // a remark in round brackets
  }
  if (name == "time") return measure("time", "s");
  if (const auto record = measure_of_record(name, domain)) return *record;
  return {name, "", {}};
}

}  // namespace

std::optional<Measure> measure_of_record(const std::string& name, std::optional<Domain> domain) {
  using Channel = Record::Channel;
  const std::string channel = name.find('.') == name.npos ? "" : name.substr(name.rfind('.') + 1);
  const std::pair<const char*, Channel> channels[] = {{"position", Channel::position},
                                                      {"velocity", Channel::velocity},
                                                      {"displacement", Channel::displacement},
                                                      {"force", Channel::force},
                                                      {"acceleration", Channel::acceleration},
                                                      {"power", Channel::power},
                                                      {"dissipated", Channel::dissipated},
                                                      {"energy", Channel::energy}};
  for (const auto& [word, known] : channels) {
    if (channel != word) continue;
    if (!domain) return Measure{word, "SI", {}};
    const Quantity quantity = quantity_of(known);
    const bool length = quantity == Quantity::position && *domain == Domain::translation;
    return measure(length ? word : name_of(quantity, *domain), unit_of(quantity, *domain));
  }
  return {};
}

CsvFile::CsvFile(const std::string& path, std::optional<Domain> domain) : path_(path) {
  std::ifstream in = open(path);
  std::string line;
  if (!next(in, line, header_line_)) throw Mistake(fmt::format("`{}` is empty", path));
  for (const CsvField& field : csv_fields(line)) {
    const std::string place = fmt::format("{}:{}:{}", path, header_line_, field.column);
    if (csv_number(field))
      throw Mistake(fmt::format("{}: expected the name of a column, found the number `{}`", place, field.text),
                    "the first row of a CSV file names its columns");
    const CsvHeading heading = csv_heading(field.text);
    if (const auto figure = measure_of_figure(heading, domain)) {
      columns_.push_back({std::string(field.text), *figure});
      continue;
    }
    // A name is shown in full where the unit in it is only a remark.
    const std::string name(heading.name.empty() ? field.text : heading.name);
    columns_.push_back({name, measure_of(name, heading.unit, heading.square, place, domain)});
  }
  find_runs();
}

void CsvFile::find_runs() {
  const auto time = std::find_if(columns_.begin(), columns_.end(), [](const Column& c) { return c.name == "time"; });
  if (columns_.front().name != "run" || columns_.back().name != "error" || time == columns_.end()) return;
  const auto time_column = static_cast<std::size_t>(time - columns_.begin());
  std::ifstream in = open(path_);
  std::string line;
  for (long number = 0; next(in, line, number);) {
    if (number <= header_line_) continue;
    const std::vector<CsvField> fields = csv_fields(line);
    if (fields.size() != columns_.size()) return;  // reading the rows says so
    if (fields[time_column].text.empty()) continue;  // it failed
    const std::string run(fields.front().text);
    if (!runs_.empty() && runs_.back().number == run) continue;
    runs_.push_back({run, ""});
    for (std::size_t k = 1; k < time_column; ++k)
      runs_.back().values += fmt::format("{}{} = {}{}{}", k > 1 ? ", " : "", columns_[k].name, fields[k].text,
                                         columns_[k].measure.unit.empty() ? "" : " ", in_print(columns_[k].measure.unit));
  }
  for (std::size_t k = time_column + 1; k + 1 < columns_.size(); ++k) recorded_.push_back({time_column, k});
}

bool CsvFile::has_numbers(std::size_t column) const {
  std::ifstream in = open(path_);
  std::string line;
  for (long number = 0; next(in, line, number);) {
    if (number <= header_line_) continue;
    const std::vector<CsvField> fields = csv_fields(line);
    if (column < fields.size() && csv_number(fields[column])) return true;
  }
  return false;
}

std::vector<Trace> CsvFile::read(const std::vector<ColumnPair>& pairs, const std::vector<std::size_t>& of_runs) const {
  std::ifstream in = open(path_);
  const std::size_t runs = std::max<std::size_t>(of_runs.size(), 1);
  std::vector<Trace> traces(runs * pairs.size());
  std::vector<char> wanted(columns_.size(), 0);
  for (const auto& [x, y] : pairs) wanted[x] = wanted[y] = 1;
  std::vector<double> values(columns_.size(), 0);
  std::string line;
  long number = 0, rows = 0;
  while (next(in, line, number)) {
    if (number <= header_line_) continue;
    const std::vector<CsvField> fields = csv_fields(line);
    if (fields.size() != columns_.size())
      throw Mistake(
          fmt::format("{}:{}: {} fields, but the header has {}", path_, number, fields.size(), columns_.size()));
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (!wanted[k]) continue;
      const bool none = fields[k].text.empty();
      const std::optional<double> value = none ? std::numeric_limits<double>::quiet_NaN() : csv_number(fields[k]);
      if (!value)
        throw Mistake(fmt::format("{}:{}:{}: expected a number, found `{}`", path_, number, fields[k].column,
                                  printable(fields[k].text)));
      values[k] = multiplied(*value, columns_[k].measure.size ? columns_[k].measure.size->factor : 1);
    }
    ++rows;
    const auto same = [&](std::size_t run) { return runs_[run].number == fields.front().text; };
    const auto run = std::find_if(of_runs.begin(), of_runs.end(), same);
    if (!of_runs.empty() && run == of_runs.end()) continue;
    const std::size_t first = static_cast<std::size_t>(run - of_runs.begin()) * pairs.size();
    for (std::size_t k = 0; k < pairs.size(); ++k) traces[first + k].add({values[pairs[k].first], values[pairs[k].second]});
  }
  if (rows == 0) throw Mistake(fmt::format("`{}` has a header, but no rows", path_));
  return traces;
}

}  // namespace rheonet::plot
