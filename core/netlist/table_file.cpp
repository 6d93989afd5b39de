#include "core/netlist/table_file.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "core/netlist/characters.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

namespace {

struct Field {
  std::string_view text;
  int column = 1;
};

constexpr std::string_view blank = " \t\r";

std::string_view trim(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blank), text.size()));
  return text.substr(0, text.find_last_not_of(blank) + 1);
}

/// A field may stand in quotes, as spreadsheets write them.
std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? trim(text.substr(1, text.size() - 2)) : text;
}

/// The fields of a line, split at commas if it has any, else at semicolons, else at blanks.
std::vector<Field> split(std::string_view line) {
  const char separator = line.find(',') != line.npos ? ',' : line.find(';') != line.npos ? ';' : ' ';
  std::vector<Field> fields;
  std::size_t at = 0;
  while (at <= line.size()) {
    std::size_t end = separator == ' ' ? line.find_first_of(blank, at) : line.find(separator, at);
    end = std::min(end, line.size());
    const std::string_view text = trim(line.substr(at, end - at));
    const std::size_t begin = at + std::min(line.substr(at, end - at).find_first_not_of(blank), end - at);
    if (separator != ' ' || !text.empty())
      fields.push_back({without_quotes(text), 1 + static_cast<int>(count_characters(line.substr(0, begin)))});
    at = end + 1;
  }
  return fields;
}

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

/// Reads the rows of a file, telling of the first mistakes in them.
class TableReader {
 public:
  TableReader(int file, Context& context) : file_(file), context_(context) {}

  /// Absent if there are mistakes.
  std::optional<TableFile> read() {
    std::string_view rest = context_.files.text(file_);
    bool first = true;
    for (line_ = 1; !rest.empty(); ++line_) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (trim(line).empty() || trim(line).front() == '#') continue;
      row(split(line), first);
      first = false;
    }
    if (mistakes_ > most_told)
      context_.mistakes.error({file_, first_untold_, 1},
                              "and " + std::to_string(mistakes_ - most_told) + " more mistakes in this table");
    if (mistakes_ > 0) return {};
    return std::move(table_);
  }

 private:
  static constexpr int most_told = 10;  // a file of another kind has as many as it has rows

  void refuse(int column, std::string message, std::string hint = {}) {
    if (++mistakes_ <= most_told)
      context_.mistakes.error({file_, line_, column}, std::move(message), std::move(hint));
    else if (mistakes_ == most_told + 1)
      first_untold_ = line_;
  }

  void row(const std::vector<Field>& fields, bool may_be_header) {
    if (fields.size() != 2) {
      refuse(1, "a table of a signal has two columns, time and value; this row has " + std::to_string(fields.size()));
      return;
    }
    const auto time = number(fields[0].text);
    const auto value = number(fields[1].text);
    if (may_be_header && !time && !value) {
      header(fields);
      return;
    }
    bool good = true;
    for (const auto& [parsed, field] : {std::pair(time, fields[0]), std::pair(value, fields[1])}) {
      if (parsed && std::isfinite(*parsed)) continue;
      refuse(field.column, "expected a finite number, found `" + std::string(field.text) + "`");
      good = false;
    }
    if (!good) return;
    auto& points = table_.points;
    if (!points.empty() && multiplied(*time, second_) < points.back().first)
      refuse(fields[0].column, "the times of a table must not decrease");
    else
      points.emplace_back(multiplied(*time, second_), *value);
  }

  void header(const std::vector<Field>& fields) {
    const auto time_unit = unit_of_column(fields[0]);
    const auto value_unit = unit_of_column(fields[1]);
    if (!time_unit || !value_unit) return;
    const auto seconds = as_quantity(*time_unit, Quantity::time, context_.domain);
    if (const auto* wrong = std::get_if<TextError>(&seconds))
      refuse(fields[0].column, "the unit of the times: " + wrong->message);
    else
      second_ = std::get<double>(seconds);
    table_.unit = *value_unit;
  }

  /// The unit at the end of the field of a header, "velocity [mm/s]" or "velocity (mm/s)"; plain if there is none,
  /// nothing if it is mistaken. What stands in round brackets may be another remark.
  std::optional<Number> unit_of_column(const Field& field) {
    const bool square = field.text.ends_with(']');
    const auto begin = square || field.text.ends_with(')') ? field.text.rfind(square ? '[' : '(') : field.text.npos;
    Number one{.value = 1, .dimension = {}};
    if (begin == field.text.npos) return one;
    const std::string_view text = trim(field.text.substr(begin + 1, field.text.size() - begin - 2));
    const auto parsed = parse_unit(text);
    if (const auto* unit = std::get_if<Unit>(&parsed))
      return Number{unit->factor, unit->dimension, false, unit->radian, unit->hertz};
    if (square) {
      const TextError& wrong = std::get<TextError>(parsed);
      refuse(field.column, "`" + std::string(text) + "` is no unit: " + wrong.message, wrong.hint);
      return {};
    }
    context_.mistakes.warning({file_, line_, field.column}, "`" + std::string(text) + "` is no unit: this column is taken in SI");
    return one;
  }

  int file_;
  Context& context_;
  TableFile table_{{}, {.value = 1, .dimension = {}}};
  double second_ = 1;  ///< the unit of the times, in s
  int line_ = 0;
  int mistakes_ = 0;
  int first_untold_ = 0;  ///< line
};

}  // namespace

std::optional<TableFile> read_table_file(const TomlValue& name, Context& context) {
  const auto found = context.files.find(name, name.spot.file, context.mistakes);
  if (!found) return {};
  const auto file = context.files.read(*found, Sources::Role::table, name.spot, context.mistakes);
  if (!file) return {};
  auto table = TableReader(*file, context).read();
  if (table && table->points.empty()) {
    context.mistakes.error(name.spot, "the table `" + name.text + "` has no rows");
    return {};
  }
  return table;
}

}  // namespace rheonet
