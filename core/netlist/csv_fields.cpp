#include "core/netlist/csv_fields.hpp"

#include <algorithm>
#include <charconv>

#include "core/netlist/characters.hpp"

namespace rheonet {

namespace {

constexpr std::string_view spaces_and_ends = " \t\r";

std::string_view trim(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(spaces_and_ends), text.size()));
  return text.substr(0, text.find_last_not_of(spaces_and_ends) + 1);
}

std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? trim(text.substr(1, text.size() - 2)) : text;
}

/// The quote that closes a quoted field beginning at `at`; npos if the field is not quoted.
std::size_t closing_quote(std::string_view line, std::size_t at) {
  at = line.find_first_not_of(spaces_and_ends, at);
  return at < line.size() && line[at] == '"' ? line.find('"', at + 1) : line.npos;
}

bool has_unquoted(std::string_view line, char wanted) {
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == wanted && !quoted) return true;
  }
  return false;
}

}  // namespace

std::vector<CsvField> csv_fields(std::string_view line) {
  const char separator = has_unquoted(line, ';') ? ';' : has_unquoted(line, ',') ? ',' : ' ';
  std::vector<CsvField> fields;
  std::size_t at = 0, counted = 0, column = 1;
  while (at <= line.size()) {
    const std::size_t closing = closing_quote(line, at);
    std::size_t from = closing == line.npos ? at : closing;
    // At blanks a unit in square brackets belongs to the name before it.
    const bool unit = separator == ' ' && at > 0 && !fields.empty() && line.substr(at - 1).starts_with(" [") && line.find(']', at) != line.npos;
    if (unit) from = line.find(']', at);
    std::size_t end = separator == ' ' ? line.find_first_of(spaces_and_ends, from) : line.find(separator, from);
    end = std::min(end, line.size());
    if (unit) {
      const std::string_view name = fields.back().text;
      fields.back().text = {name.data(), static_cast<std::size_t>(line.data() + end - name.data())};
      at = end + 1;
      continue;
    }
    const std::string_view text = trim(line.substr(at, end - at));
    const std::size_t begin = at + std::min(line.substr(at, end - at).find_first_not_of(spaces_and_ends), end - at);
    column += count_characters(line.substr(counted, begin - counted));
    counted = begin;
    if (separator != ' ' || !text.empty()) fields.push_back({without_quotes(text), static_cast<int>(column), separator == ';'});
    at = end + 1;
  }
  return fields;
}

bool is_csv_remark(std::string_view line) {
  const std::string_view text = trim(line);
  return text.empty() || text.front() == '#';
}

std::optional<double> csv_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

std::optional<double> csv_number(const CsvField& field) { return csv_number(csv_text(field)); }

std::string csv_text(const CsvField& field) {
  const std::string text(field.text);
  if (!field.decimal_comma || std::count(text.begin(), text.end(), ',') != 1) return text;
  std::string number = text;
  std::replace(number.begin(), number.end(), ',', '.');
  return csv_number(number) ? number : text;
}

CsvHeading csv_heading(std::string_view field) {
  const bool square = field.ends_with(']');
  const auto begin = square || field.ends_with(')') ? field.rfind(square ? '[' : '(') : field.npos;
  if (begin == field.npos) return {field, "", false};
  return {trim(field.substr(0, begin)), trim(field.substr(begin + 1, field.size() - begin - 2)), square};
}

}  // namespace rheonet
