#include "tools/rheonet/words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/table.hpp"

namespace rheonet::tool {
namespace {

std::string number(double x, const std::string& unit) { return readable(x, unit, 10); }

// Phase, time and offset of a signal, each if it is not 0.
std::string rest(double phase, double time, double offset, const std::string& unit) {
  std::string text;
  if (phase != 0) text += ", phase " + number(phase, "rad");
  if (time != 0) text += ", from " + number(time, "s") + " on";
  if (offset != 0) text += ", offset " + number(offset, unit);
  return text;
}

/// Describes each shape of a signal.
struct Words {
  const std::string& unit;

  std::string operator()(const Signal::Constant& s) const { return number(s.value, unit); }
  std::string operator()(const Signal::Step& s) const {
    return "step of " + number(s.height, unit) + " at " + number(s.time, "s") + rest(0, 0, s.offset, unit);
  }
  std::string operator()(const Signal::Ramp& s) const {
    return "ramp of " + number(s.slope, unit) + " per s" + (std::isfinite(s.duration) ? " for " + number(s.duration, "s") : "") + rest(0, s.time, s.offset, unit);
  }
  std::string operator()(const Signal::Sine& s) const { return wave("sine", s); }
  std::string operator()(const Signal::Square& s) const { return wave("square", s); }
  std::string operator()(const Signal::Triangle& s) const { return wave("triangle", s); }
  std::string operator()(const Signal::Chirp& s) const {
    return fmt::format("chirp of {}, {} to {} in {}{}", number(s.amplitude, unit), number(s.frequency, "Hz"),
                       number(s.end_frequency, "Hz"), number(s.duration, "s"), rest(s.phase, s.time, s.offset, unit));
  }
  std::string operator()(const Signal::Pulse& s) const {
    return fmt::format("pulse of {} for {} at {}{}{}", number(s.height, unit), number(s.width, "s"),
                       number(s.time, "s"), s.frequency > 0 ? ", again at " + number(s.frequency, "Hz") : "",
                       rest(s.phase, 0, s.offset, unit));
  }
  std::string operator()(const Signal::Noise& s) const {
    return fmt::format("noise of {}, new every {}, seed {}{}", number(s.amplitude, unit), number(s.interval, "s"), s.seed, rest(0, s.time, s.offset, unit));
  }
  std::string operator()(const Signal::Table& s) const {
    return fmt::format("{}table of {} points over {} to {}{}", s.smooth ? "smooth " : "", s.times.size(), number(s.times.front(), "s"),
                       number(s.times.back(), "s"), rest(0, s.time, s.offset, unit));
  }

  template <class Wave>
  std::string wave(const char* name, const Wave& s) const {
    return fmt::format("{} of {}, {}{}", name, number(s.amplitude, unit), number(s.frequency, "Hz"),
                       rest(s.phase, s.time, s.offset, unit));
  }
};

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<std::string> split_outside_brackets(const std::string& text) {
  std::vector<std::string> parts{""};
  int depth = 0;
  for (const char c : text) {
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (c == ',' && depth <= 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (std::string& part : parts) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
  }
  return parts;
}

std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t width = 100;
  std::string result;
  std::size_t column = indent;
  for (const std::string& word : split(text, ' ')) {
    if (column > indent && column + 1 + word.size() > width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

std::string in_words(const Signal& signal, const std::string& unit) { return std::visit(Words{unit}, signal.shape()); }

std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? ' ' : c == '"' ? '\'' : c;
  result = printable(result);
  return result.find_first_of(",;#") == result.npos ? result : '"' + result + '"';
}

}  // namespace rheonet::tool
