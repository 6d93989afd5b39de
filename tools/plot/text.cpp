#include "tools/plot/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/netlist/characters.hpp"

namespace rheonet::plot {
namespace {

// Widths in parts of the size, those of DejaVu Sans, which is wider than most.
double width_of(char32_t character) {
  constexpr std::u32string_view narrow = U" .,:;'|!ijlftrI()[]/·", wide = U"mwMWQ@%—";
  if (narrow.find(character) != narrow.npos) return 0.37;
  if (wide.find(character) != wide.npos) return 0.97;
  return character >= U'A' && character <= U'Z' ? 0.70 : 0.62;
}

}  // namespace

double width_of(const std::string& text, double size) {
  double sum = 0;
  for (const char32_t character : decode(text)) sum += width_of(character);
  return sum * size;
}

std::vector<std::string> lines_of(const std::string& text, double size, double width) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (!lines.empty() && width_of(lines.back() + ' ' + word, size) <= width)
      lines.back() += ' ' + word;
    else
      lines.push_back(word);
  }
  return lines;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char32_t character : decode(text)) {
    if (character == U'<')
      result += "&lt;";
    else if (character == U'>')
      result += "&gt;";
    else if (character == U'&')
      result += "&amp;";
    else if (character == U'"')
      result += "&quot;";
    else if (is_printable(character))
      result += encode(std::u32string(1, character));
  }
  return result;
}

std::string raised(const std::string& label) {
  const std::size_t caret = label.find('^');
  if (caret == label.npos) return escaped(label);
  const std::size_t end = std::min(label.find_first_not_of("-0123456789.", caret + 1), label.size());
  if (end == caret + 1) return escaped(label.substr(0, end)) + raised(label.substr(end));
  // Some viewers drop a blank at the start of a piece of text: it becomes a shift.
  const bool blank = end < label.size() && label[end] == ' ';
  const std::string rest = raised(label.substr(end + (blank ? 1 : 0)));
  return escaped(label.substr(0, caret)) + "<tspan dy=\"-4\" font-size=\"75%\">" +
         escaped(label.substr(caret + 1, end - caret - 1)) + "</tspan>" +
         (rest.empty() ? "" : fmt::format("<tspan dy=\"4\"{}>{}</tspan>", blank ? " dx=\"4\"" : "", rest));
}

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace rheonet::plot
