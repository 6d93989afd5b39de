#include "core/netlist/diagnostic_list.hpp"

#include <algorithm>

#include "core/netlist/document.hpp"

namespace rheonet {

namespace {

// Limit on the errors, and on the warnings, that are listed. The time for each grows with the scene: its place and excerpt
// are searched for in the file, and its name is compared with all others.
constexpr std::size_t most_shown = 200;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Index of character `column` (from 1) of line `line` (from 1) in `text`.
std::size_t index_of(std::string_view text, int line, int column) {
  std::size_t at = 0;
  for (int n = 1; n < line && at < text.size(); ++n) {
    at = text.find('\n', at);
    at = at == text.npos ? text.size() : at + 1;
  }
  for (int n = 1; n < column && at < text.size(); ++n) {
    ++at;
    while (at < text.size() && continues_character(text[at])) ++at;
  }
  return at;
}

/// Number of source characters that encode the character of a basic string at `at`.
std::size_t escaped_length(std::string_view text, std::size_t at) {
  if (text[at] != '\\' || at + 1 >= text.size()) return 1;
  return text[at + 1] == 'u' ? 6 : text[at + 1] == 'U' ? 10 : 2;
}

/// A path, shortened to fit on a line.
std::string shortened(const std::string& path) {
  constexpr std::size_t part = 40;
  return path.size() <= 2 * part ? path : path.substr(0, part) + "..." + path.substr(path.size() - part);
}

}  // namespace

void DiagnosticList::error(Spot spot, std::string message, std::string hint) {
  add(Severity::error, spot, std::move(message), std::move(hint));
}

void DiagnosticList::warning(Spot spot, std::string message, std::string hint) {
  add(Severity::warning, spot, std::move(message), std::move(hint));
}

void DiagnosticList::add(Severity severity, Spot spot, std::string message, std::string hint) {
  const bool is_error = severity == Severity::error;
  if (is_error) ++errors_;
  if (!seen_.insert({spot.file, spot.line, spot.column, message}).second) return;
  if (++(is_error ? different_errors_ : different_warnings_) > most_shown) {
    if (is_error) throw TooManyDiagnostics{};
    return;
  }
  if (path_ && !spot.on_command_line()) message += " (in `" + shortened(*path_) + "`)";
  all_.push_back({severity, spot, std::move(message), std::move(hint)});
}

Spot DiagnosticList::inside(const TomlValue& value, std::size_t offset) const {
  Spot spot = value.spot;
  std::string_view text;
  std::size_t at = 0;
  if (!spot.on_command_line()) {
    text = sources_.files[static_cast<std::size_t>(spot.file)].text;
    at = index_of(text, spot.line, spot.column);
  } else {
    text = sources_.command_line[static_cast<std::size_t>(spot.line - 1)];
    at = index_of(text, 1, spot.column);
  }
  const auto advance = [&](std::size_t characters) {
    for (; characters > 0 && at < text.size(); --characters) {
      if (text[at] == '\n' && !spot.on_command_line()) {
        ++spot.line;
        spot.column = 0;
      }
      ++at;
      ++spot.column;
      while (at < text.size() && continues_character(text[at])) ++at;
    }
  };
  // A string without quotes is a value of the command line, taken literally.
  const char quote = at < text.size() ? text[at] : '\0';
  const bool quoted = quote == '"' || quote == '\'';
  if (quoted) {
    const bool long_string = text.substr(at, 3) == std::string(3, quote);
    advance(long_string ? 3 : 1);
    if (long_string && text.substr(at, 2) == "\r\n") advance(1);
    if (long_string && at < text.size() && text[at] == '\n') advance(1);
  }
  for (; offset > 0 && at < text.size(); --offset) advance(quote == '"' ? escaped_length(text, at) : 1);
  return spot;
}

std::vector<Diagnostic> DiagnosticList::sorted() const {
  std::vector<Diagnostic> result = all_;
  std::stable_sort(result.begin(), result.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return comes_before(a.spot, b.spot); });
  if (different_warnings_ > most_shown)
    result.push_back({Severity::warning, result.back().spot, "and " + std::to_string(different_warnings_ - most_shown) + " more warnings", ""});
  if (different_errors_ > most_shown)
    result.push_back({Severity::error, result.back().spot, "there are more than " + std::to_string(most_shown) + " mistakes: the others are not looked for", ""});
  return result;
}

bool comes_before(const Spot& a, const Spot& b) {
  const auto rank = [](const Spot& s) { return std::tuple(s.on_command_line(), s.file, s.line, s.column); };
  return rank(a) < rank(b);
}

std::string list_names(const std::vector<std::string>& names, std::string_view last_word) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? std::string(", ") : ' ' + std::string(last_word) + ' ';
    text += '`' + names[i] + '`';
  }
  return text;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known, std::string otherwise) {
  const std::string name = nearest(word, known);
  return name.empty() ? otherwise : "did you mean `" + name + "`?";
}

}  // namespace rheonet
