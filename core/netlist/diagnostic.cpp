#include "core/netlist/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/netlist/characters.hpp"

namespace rheonet {

namespace {

// Number of characters of a line in an excerpt: generated netlists may have all their points on one line.
constexpr std::size_t excerpt_width = 120;

/// Line `number` (from 1) without its line end, "" if there is none.
std::string_view line_at(std::string_view text, int number) {
  for (int n = 1; n < number; ++n) {
    const auto end = text.find('\n');
    if (end == text.npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

/// The character shown in an excerpt, of the same width: a control character must not reach the terminal.
char32_t shown_as(char32_t c) {
  constexpr char32_t picture_of_null = 0x2400, picture_of_delete = 0x2421, replacement = 0xFFFD;
  if (c == U'\t' || is_printable(c)) return c;
  return c < 0x20 ? picture_of_null + c : c == 0x7F ? picture_of_delete : replacement;
}

/// The line, and a caret under character `column`. Both have a margin with the line's number, if it is not 0. Tabs are
/// repeated in both, so that the caret is in place for any tab width.
std::string excerpt(std::string_view line, int line_number, int column) {
  std::u32string characters = decode(line);
  std::transform(characters.begin(), characters.end(), characters.begin(), shown_as);
  const auto caret = static_cast<std::size_t>(std::max(column, 1) - 1);
  std::size_t first = 0;
  std::size_t last = characters.size();
  if (last > excerpt_width) {
    first = std::min(caret - std::min(caret, excerpt_width / 2), last - excerpt_width);
    last = first + excerpt_width;
  }
  const std::string margin = line_number > 0 ? fmt::format("{:>5} | ", line_number) : "      | ";
  std::string shown = margin;
  std::string below = std::string(margin.size() - 2, ' ') + "| ";
  if (first > 0) shown += "...", below += "   ";
  shown += encode(std::u32string_view(characters).substr(first, last - first));
  for (std::size_t i = first; i < std::min(caret, last); ++i) below += characters[i] == U'\t' ? '\t' : ' ';
  if (last < characters.size()) shown += "...";
  return column > 0 ? shown + '\n' + below + '^' : shown;
}

// Longer words are no mistyped names, and the time of a comparison grows with the square of the length.
constexpr std::size_t longest_guessed = 100;

/// Damerau-Levenshtein distance (optimal string alignment: insert, delete, replace, swap neighbours) of words of at most
/// longest_guessed bytes.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, longest_guessed + 1>;
  Row rows[3];
  Row *before_last = &rows[0], *last = &rows[1], *row = &rows[2];
  for (std::size_t j = 0; j <= b.size(); ++j) (*last)[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    (*row)[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      (*row)[j] = std::min({(*last)[j] + 1, (*row)[j - 1] + 1, (*last)[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        (*row)[j] = std::min((*row)[j], (*before_last)[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return (*last)[b.size()];
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace

std::string format(const Diagnostic& diagnostic, const Sources& sources) {
  const auto& [severity, spot, message, hint] = diagnostic;
  const auto* file = !spot.on_command_line() && spot.file < std::ssize(sources.files)
                         ? &sources.files[static_cast<std::size_t>(spot.file)]
                         : nullptr;
  std::string text = file ? printable(file->path.string()) : "command line";
  if (file && spot.line > 0) text += fmt::format(":{}:{}", spot.line, std::max(spot.column, 1));
  text += severity == Severity::error ? ": error: " : ": warning: ";
  text += printable(message);
  if (file && spot.line > 0) text += '\n' + excerpt(line_at(file->text, spot.line), spot.line, spot.column);
  if (spot.on_command_line() && spot.line > 0 && spot.line <= std::ssize(sources.command_line))
    text += '\n' + excerpt(sources.command_line[static_cast<std::size_t>(spot.line - 1)], 0, spot.column);
  if (!hint.empty()) text += "\n  " + printable(hint);
  return text;
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > longest_guessed) return "";
  const std::size_t limit = std::max<std::size_t>(2, word.size() / 3);
  const std::string lower = lower_case(word);
  std::pair best{limit + 1, std::size_t{0}};
  std::string name;
  for (const std::string& candidate : known) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (longer > longest_guessed || longer - std::min(word.size(), candidate.size()) > limit) continue;
    // A difference in case is the smallest mistake.
    const std::pair distance{edit_distance(lower, lower_case(candidate)), edit_distance(word, candidate)};
    // No letter in common: no hint is better than an arbitrary one.
    if (distance.first >= longer) continue;
    if (distance < best) best = distance, name = candidate;
  }
  return name;
}

}  // namespace rheonet
