#include "tools/draw/symbol_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "tools/plot/text.hpp"

namespace rheonet::draw {
namespace {

/// The meaning of the numbers of a command, in their order.
std::string_view numbers_of(char command) {
  switch (command) {
    case 'M':
    case 'L':
      return "xy";
    case 'H':
      return "x";
    case 'V':
      return "y";
    case 'Q':
      return "xyxy";
    case 'C':
      return "xyxyxy";
    case 'A':
      return "whrlsxy";  // radii, rotation, large, sweep, end
    case 'Z':
      return "";
  }
  throw std::invalid_argument(std::string("no command of a symbol: ") + command);
}

/// Reads a path: calls `begin` for each command, and `number` for each of its numbers, with its meaning.
template <class Begin, class Number>
void read(const std::string& path, Begin begin, Number number_read) {
  const char *at = path.data(), *const end = path.data() + path.size();
  const auto skip_blanks = [&] {
    while (at != end && *at == ' ') ++at;
  };
  const auto number = [&] {
    skip_blanks();
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc()) throw std::invalid_argument("a number is missing in the symbol `" + path + "`");
    at = read.ptr;
    return value;
  };
  for (skip_blanks(); at != end; skip_blanks()) {
    const char command = *at++;
    begin(command);
    for (const char what : numbers_of(command)) number_read(what, number());
  }
}

}  // namespace

const Symbol& symbol_of(const Component& component, Domain domain) {
  static const Symbol plain{
      .outline = "M.14 .26 H.86 V.74 H.14 Z", .lines = "M0 .5 H.14 M.86 .5 H1", .thin = {}, .solid = {}};
  const Symbol& own = component.drawn_in(domain);
  return own.empty() ? plain : own;
}

Symbol symbol_of(const Scene& scene, int element) {
  const SceneElement& drawn = scene.elements[static_cast<std::size_t>(element)];
  const Component& component = *components()[static_cast<std::size_t>(drawn.declaration)];
  Symbol symbol = symbol_of(component, domain_of(scene, drawn));
  if (component.signal_drawing) symbol.lines += component.signal_drawing(drawn.signals.front());
  return symbol;
}

std::string symbol_svg(const Component& component, Domain domain) {
  constexpr double side = 60, stroke = 2;
  const Symbol& symbol = symbol_of(component, domain);
  const Reach reach = reach_of(symbol);
  const double top = side * (0.5 - reach.up) - stroke, height = side * (reach.up + reach.down) + 2 * stroke;
  const auto path = [&](const std::string& drawn, const char* attributes) {
    return drawn.empty() ? "" : fmt::format("<path d=\"{}\"{}/>", fitted(drawn, {0, 0, side, side}, false), attributes);
  };
  return fmt::format("<svg viewBox=\"{} {} {} {}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"{}\" stroke-linejoin=\"round\" aria-hidden=\"true\">", -stroke,
                     plot::coordinate(top), side + 2 * stroke, plot::coordinate(height), stroke) +
         path(symbol.outline, "") + path(symbol.thin, " stroke-width=\"1\"") + path(symbol.lines, "") + path(symbol.solid, " fill=\"currentColor\" stroke=\"none\"") + "</svg>";
}

Symbol support_symbol() {
  return {.outline = "M.42 .5 A.08 .08 0 1 1 .58 .5 A.08 .08 0 1 1 .42 .5 Z", .lines = "M0 .5 H.42 M.58 .5 H1 M.4 .62 H.6", .solid = "M.47 .5 A.03 .03 0 1 1 .53 .5 A.03 .03 0 1 1 .47 .5 Z"};
}

Reach reach_of(const Symbol& symbol) {
  double top = 0.5, bottom = 0.5;
  for (const std::string* path : {&symbol.outline, &symbol.lines, &symbol.thin, &symbol.solid})
    read(
        *path, [](char) {},
        [&](char what, double value) {
          if (what != 'y') return;
          top = std::min(top, value);
          bottom = std::max(bottom, value);
        });
  return {0.5 - top, bottom - 0.5};
}

std::string fitted(const std::string& path, const Box& box, bool mirrored, double unit) {
  const double width = box.right - box.left, height = box.bottom - box.top;
  const auto along = [unit](double low, double high, double value) {
    if (unit <= 0) return low + (high - low) * value;
    const double size = std::min(unit, high - low);
    return value < 0.5 ? low + size * value : value > 0.5 ? high - size * (1 - value) : (low + high) / 2;
  };
  std::string result;
  const auto begin = [&](char command) { result += command; };
  const auto number = [&](char what, double value) {
    if (what == 'x') value = along(box.left, box.right, mirrored ? 1 - value : value);
    if (what == 'y') value = along(box.top, box.bottom, value);
    if (what == 'w') value *= width;
    if (what == 'h') value *= height;
    if (what == 's' && mirrored) value = 1 - value;
    if (std::isalpha(static_cast<unsigned char>(result.back())) == 0) result += ' ';
    result += plot::coordinate(value);
  };
  read(path, begin, number);
  return result;
}

}  // namespace rheonet::draw
