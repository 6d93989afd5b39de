#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/plot/curve_decimation.hpp"
#include "tools/plot/figure.hpp"
#include "tools/plot/style.hpp"
#include "tools/plot/text.hpp"
#include "tools/plot/ticks.hpp"

// SVG is written here and not by a plotting program: it is a page of code, text stays text (it can be searched, read
// aloud and set in another font), the curves are thinned so that extremes and jumps stay, and the same code serves
// wherever the library goes. The hard part, turning it into pixels, is left to librsvg (png.cpp).

namespace rheonet::plot {
namespace {

constexpr double font = 12, title_font = 14;  // px
constexpr double row = 18;                    // of the legend
constexpr double label_line = 15;
constexpr double tick_length = 4, small_tick_length = 2.5;
constexpr double panel_height = 190, only_panel_height = 340, gap = 14;

/// Takes an axis's values to px: from 0 at `low` to `length` at `high`.
class Scale {
 public:
  Scale(const Axis& axis, std::pair<double, double> range, double length)
      : logarithmic_(axis.logarithmic), length_(length) {
    low_ = at(range.first);
    high_ = at(range.second);
  }
  double operator()(double value) const { return (at(value) - low_) / (high_ - low_) * length_; }

 private:
  double at(double value) const { return logarithmic_ ? std::log10(value) : value; }
  bool logarithmic_;
  double length_, low_ = 0, high_ = 0;
};

/// The range of an axis: what was asked for, or that of the curves and `margin` of it on both sides.
template <class Coordinate>
std::pair<double, double> range_of(const Axis& axis, const std::vector<Panel>& panels, double margin,
                                   Coordinate coordinate_of) {
  if (axis.range) return *axis.range;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Panel& panel : panels)
    for (const Curve& curve : panel.curves)
      for (const Point& p : curve.points) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
        low = std::min(low, coordinate_of(p));
        high = std::max(high, coordinate_of(p));
      }
  if (low > high) return axis.logarithmic ? std::pair(0.1, 1.0) : std::pair(0.0, 1.0);
  constexpr double nothing = 1e-290;  // far enough from the least number that a tenth of it is still one
  // A range that rounding could have made is none: the curve is drawn as a straight line in the middle.
  constexpr double rounding = 1e-12;
  if (axis.logarithmic) {
    low = std::max(low, nothing);
    high = std::max(high, nothing);
    if (high <= low * (1 + rounding)) return {low / 2, high * 2};
    const double factor = std::pow(10.0, margin * (std::log10(high) - std::log10(low)));
    return {std::max(low / factor, 1e-300), std::min(high * factor, 1e300)};
  }
  if (high - low <= std::max(nothing, rounding * std::max(std::abs(low), std::abs(high)))) {
    const double half = std::abs(low) <= nothing ? 1 : std::abs(low) / 10;
    return {low - half, high + half};
  }
  return {low - margin * (high - low), high + margin * (high - low)};
}

std::vector<Tick> ticks_of(const Axis& axis, std::pair<double, double> range, double length, double apart) {
  const int wanted = std::max(2, static_cast<int>(length / apart));
  return axis.logarithmic ? logarithmic_ticks(range.first, range.second, wanted)
                          : linear_ticks(range.first, range.second, wanted);
}

constexpr double right_margin = 18, foot = 44;

/// Where the middle of a label below an axis of some length is, counted from the axis's left end: the last one ends with the
/// figure.
double place_across(const Tick& tick, double at, double length) {
  return std::min(at, length + right_margin - 2 - width_of(tick.label, font) / 2);
}

/// Removes labels that touch the one before them; their ticks stay. Returns whether there was none. `place` says where the middle of
/// one is, `half` how far it reaches to both sides.
template <class Place, class Half>
bool keep_apart(std::vector<Tick>& ticks, Place place, Half half) {
  bool fit = true;
  double end = -std::numeric_limits<double>::infinity();
  for (Tick& tick : ticks) {
    if (tick.label.empty()) continue;
    const double middle = place(tick);
    if (middle - half(tick) < end) {
      tick.label.clear();
      fit = false;
    } else {
      end = middle + half(tick);
    }
  }
  return fit;
}

/// Ticks of the horizontal axis: as many as have room for their labels.
std::vector<Tick> ticks_across(const Axis& axis, std::pair<double, double> range, double length) {
  constexpr double usual = 75;  // px
  const Scale scale(axis, range, length);
  for (double apart = usual;; apart *= 1.3) {
    std::vector<Tick> ticks = ticks_of(axis, range, length, apart);
    const bool fit = keep_apart(
        ticks, [&](const Tick& tick) { return place_across(tick, scale(tick.value), length); },
        [](const Tick& tick) { return (width_of(tick.label, font) + 8) / 2; });
    if (fit || apart > length) return ticks;
  }
}

/// Ticks of a vertical axis.
std::vector<Tick> ticks_up(const Axis& axis, std::pair<double, double> range, double length) {
  constexpr double usual = 32;  // px
  const Scale scale(axis, range, length);
  std::vector<Tick> ticks = ticks_of(axis, range, length, usual);
  keep_apart(ticks, [&](const Tick& tick) { return scale(tick.value); }, [](const Tick&) { return 0.55 * font; });
  return ticks;
}

std::string text(double x, double y, const std::string& content, const std::string& attributes) {
  return fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", coordinate(x), coordinate(y), attributes, content);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return fmt::format("<path d=\"M{} {}L{} {}\"{}/>\n", coordinate(x1), coordinate(y1), coordinate(x2), coordinate(y2),
                     attributes);
}

std::string stroke(const Style& style) {
  const std::string dashed = style.dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", style.dashes);
  return fmt::format(" stroke=\"{}\" stroke-width=\"1.6\"{}", style.color, dashed);
}

std::string mark(double x, double y, const std::string& color) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.8\" fill=\"{}\" stroke=\"none\"/>\n", coordinate(x),
                     coordinate(y), color);
}

Style style_in(const Panel& panel, std::size_t curve) { return panel.curves[curve].style.value_or(style_of(curve)); }

/// The names of the curves with their lines, in rows from `y` on that are filled from the left. The y below it.
/// `solid` says which have no dashes; if it is empty, all have theirs.
double legend(const Figure& figure, const Panel& panel, double left, double y, double width,
              const std::vector<bool>& solid, std::string& out) {
  constexpr double sample = 30, space = 18;
  double x = left;
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    const std::string& name = panel.curves[k].name;
    const double wide = sample + 5 + width_of(name, font);
    if (x > left && x + wide > left + width) {
      x = left;
      y += row;
    }
    Style style = style_in(panel, k);
    if (!solid.empty() && solid[k]) style.dashes = "";
    out += line(x, y + row / 2 + 1, x + sample, y + row / 2 + 1, " fill=\"none\"" + stroke(style));
    if (figure.marks) out += mark(x + sample / 2, y + row / 2 + 1, style.color);
    out += text(x + sample + 5, y + row / 2 + 5, escaped(name), "");
    x += wide + space;
  }
  return y + row + 2;
}

/// The label of a vertical axis, which runs up beside it.
std::vector<std::string> label_lines(const Axis& y, double height) { return lines_of(y.label, font, height + 20); }

/// Where a panel is.
struct Place {
  double left, top, width, height;
  bool numbers;  ///< the horizontal axis has its numbers here
};

void axes(const Figure& figure, const Panel& panel, const Place& at, const Scale& sx, const Scale& sy,
          const std::vector<Tick>& xs, const std::vector<Tick>& ys, std::string& out) {
  const double bottom = at.top + at.height, right = at.left + at.width;
  const std::string faint = " stroke=\"#dddddd\" stroke-width=\"0.8\"",
                    dark = " stroke=\"#000000\" stroke-width=\"0.8\"";
  for (const Tick& tick : xs) {
    const double x = at.left + sx(tick.value);
    const bool named = !tick.label.empty();
    if (named) out += line(x, at.top, x, bottom, faint);
    out += line(x, bottom, x, bottom - (named ? tick_length : small_tick_length), dark);
    if (!named || !at.numbers) continue;
    out += text(at.left + place_across(tick, x - at.left, at.width), bottom + 16, raised(tick.label), " text-anchor=\"middle\"");
  }
  for (const Tick& tick : ys) {
    const double y = bottom - sy(tick.value);
    const bool named = !tick.label.empty();
    if (named) out += line(at.left, y, right, y, tick.value == 0 ? " stroke=\"#888888\" stroke-width=\"0.8\"" : faint);
    out += line(at.left, y, at.left + (named ? tick_length : small_tick_length), y, dark);
    if (named) out += text(at.left - 6, y + 4, raised(tick.label), " text-anchor=\"end\"");
  }
  out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\"{}/>\n", coordinate(at.left),
                     coordinate(at.top), coordinate(at.width), coordinate(at.height), dark);
  double down = 14;
  for (const std::string& part : label_lines(panel.y, at.height)) {
    const double middle = at.top + at.height / 2;
    out += text(
        0, 0, raised(part),
        fmt::format(" text-anchor=\"middle\" transform=\"translate({} {}) rotate(-90)\"", down, coordinate(middle)));
    down += label_line;
  }
  if (at.numbers) out += text(at.left + at.width / 2, bottom + 34, raised(figure.x.label), " text-anchor=\"middle\"");
}

/// Returns which of them are drawn without their dashes.
std::vector<bool> curves(const Figure& figure, const Panel& panel, const Place& at, const Scale& sx, const Scale& sy,
                         std::string& out) {
  std::vector<bool> solid;
  // A picture of its own, which cuts off what leaves it, needs no name that another figure on a page could also use.
  out += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke-linejoin=\"round\">\n",
                     coordinate(at.left), coordinate(at.top), coordinate(at.width), coordinate(at.height));
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    Style style = style_in(panel, k);
    std::vector<Point> pixels = panel.curves[k].points;
    for (Point& p : pixels) p = {sx(p.x), at.height - sy(p.y)};
    std::string path;
    const Drawing drawing = to_draw(pixels, {at.width, at.height});
    solid.push_back(drawing.dense);
    if (drawing.dense) style.dashes = "";
    for (const Stroke& part : drawing.strokes)
      for (std::size_t i = 0; i < part.size(); ++i)
        path += fmt::format("{}{} {}", i == 0 ? "M" : i == 1 ? "L" : " ", coordinate(part[i].x), coordinate(part[i].y));
    if (!path.empty()) out += fmt::format("<path d=\"{}\"{}/>\n", path, stroke(style));
    // A curve that stands still would be a line without a length, which nobody sees.
    const auto finite = [](const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    const auto first = std::find_if(pixels.begin(), pixels.end(), finite);
    const bool still = std::all_of(first, pixels.end(), [&](const Point& p) { return !finite(p) || std::hypot(p.x - first->x, p.y - first->y) < 0.5; });
    if (still && first != pixels.end() && !figure.marks) out += mark(first->x, first->y, style.color);
    if (!figure.marks) continue;
    for (const Point& p : pixels)
      if (finite(p)) out += mark(p.x, p.y, style.color);
  }
  out += "</svg>\n";
  return solid;
}

/// The figure in words, for people who cannot see it: which quantities are drawn over which.
std::string description(const Figure& figure) {
  std::string said;
  for (const Panel& panel : figure.panels) {
    said += said.empty() ? "" : "; ";
    said += panel.y.label + " against " + figure.x.label;
    for (std::size_t k = 0; k < panel.curves.size(); ++k) said += (k ? ", " : ": ") + panel.curves[k].name;
  }
  return said;
}

/// Title and legend above the panels, and their height.
struct Head {
  std::string text;
  double height = 0;
};

Head head_of(const Figure& figure) {
  Head head{"", 8};
  for (const std::string& part : lines_of(figure.title, title_font, figure.width - 40)) {
    head.height += title_font + 4;
    head.text += text(figure.width / 2, head.height - 3, escaped(part),
                      fmt::format(" text-anchor=\"middle\" font-size=\"{}\"", title_font));
  }
  head.height += 6;
  return head;
}

/// The part of a figure between its head and its foot.
struct Layout {
  double left = 0, width = 0, panel_height = 0;
  std::vector<std::pair<double, double>> y_ranges;
  std::vector<std::vector<Tick>> y_ticks;
};

/// How high panels are is known when the rows of the legends are, how wide when the numbers beside the axes are, and
/// how many rows a legend has when the width is: two rounds settle it.
Layout layout_of(const Figure& figure, double head) {
  const auto panels = static_cast<double>(figure.panels.size());
  Layout layout{
      .left = 60, .width = figure.width - 60 - right_margin, .panel_height = 0, .y_ranges = {}, .y_ticks = {}};
  for (const Panel& panel : figure.panels)
    layout.y_ranges.push_back(range_of(panel.y, {panel}, 0.05, [](const Point& p) { return p.y; }));
  for (int round = 0; round < 2; ++round) {
    double legends = 0;
    std::string unplaced;
    for (const Panel& panel : figure.panels) legends += legend(figure, panel, 0, 0, layout.width, {}, unplaced);
    const double rest = (figure.height - head - legends - gap * (panels - 1) - foot) / panels;
    layout.panel_height = figure.height > 0           ? std::max(40.0, rest)
                          : figure.panels.size() == 1 ? only_panel_height
                                                      : panel_height;
    double widest = 0;
    std::size_t lines = 1;
    layout.y_ticks.clear();
    for (std::size_t k = 0; k < figure.panels.size(); ++k) {
      const Axis& y = figure.panels[k].y;
      layout.y_ticks.push_back(ticks_up(y, layout.y_ranges[k], layout.panel_height));
      for (const Tick& tick : layout.y_ticks.back()) widest = std::max(widest, width_of(tick.label, font));
      lines = std::max(lines, label_lines(y, layout.panel_height).size());
    }
    layout.left = 15 + label_line * static_cast<double>(lines) + widest;
    layout.width = figure.width - layout.left - right_margin;
  }
  return layout;
}

}  // namespace

std::vector<Dropped> drop_what_has_no_logarithm(Figure& figure) {
  std::vector<Dropped> dropped;
  for (Panel& panel : figure.panels)
    for (Curve& curve : panel.curves) {
      std::size_t count = 0;
      for (Point& p : curve.points) {
        if ((!figure.x.logarithmic || p.x > 0) && (!panel.y.logarithmic || p.y > 0)) continue;
        p.y = std::numeric_limits<double>::quiet_NaN();
        ++count;
      }
      if (count > 0) dropped.push_back({curve.name, count, curve.points.size()});
    }
  return dropped;
}

std::string svg(const Figure& figure) {
  const bool beside_time = figure.x.label.starts_with("time");
  const auto x_range = range_of(figure.x, figure.panels, beside_time ? 0 : 0.03, [](const Point& p) { return p.x; });
  const Head head = head_of(figure);
  const Layout layout = layout_of(figure, head.height);
  const auto x_ticks = ticks_across(figure.x, x_range, layout.width);

  std::string out = head.text;
  double y = head.height;
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const Panel& panel = figure.panels[k];
    std::string unplaced;
    const double names = y;
    y = legend(figure, panel, layout.left, names, layout.width, {}, unplaced);
    const Place at{layout.left, y, layout.width, layout.panel_height, k + 1 == figure.panels.size()};
    const Scale sx(figure.x, x_range, at.width), sy(panel.y, layout.y_ranges[k], at.height);
    std::string drawn;
    axes(figure, panel, at, sx, sy, x_ticks, layout.y_ticks[k], drawn);
    const std::vector<bool> solid = curves(figure, panel, at, sx, sy, drawn);
    legend(figure, panel, layout.left, names, layout.width, solid, out);
    out += drawn;
    y += at.height + gap;
  }
  const double full = figure.height > 0 ? figure.height : y - gap + foot;
  const std::string title = figure.title.empty() ? "" : fmt::format("<title>{}</title>\n", escaped(figure.title));
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"{2}\">\n{3}<desc>{4}</desc>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{5}</svg>\n",
      coordinate(figure.width), coordinate(full), font, title, escaped(description(figure)), out);
}

}  // namespace rheonet::plot
