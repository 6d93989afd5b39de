#include "tools/plot/compose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/plot/mistake.hpp"

namespace rheonet::plot {
namespace {

/// The curves of a panel.
using Group = std::vector<const Measured*>;

std::string with_unit(const std::string& quantity, const std::string& unit) {
  return unit.empty() ? quantity : fmt::format("{} [{}]", quantity, unit);
}

std::string with_unit(const Measure& measure) { return with_unit(measure.quantity, measure.unit); }

/// "torque", or "position, displacement": each quantity once; of many their first ones.
template <class Get>
std::string quantities(const std::vector<const Measured*>& curves, Get measure_of) {
  constexpr std::size_t few = 3;
  std::vector<std::string> seen;
  for (const Measured* curve : curves)
    if (const std::string& quantity = measure_of(*curve).quantity;
        std::find(seen.begin(), seen.end(), quantity) == seen.end())
      seen.push_back(quantity);
  std::string text;
  for (std::size_t i = 0; i < std::min(few, seen.size()); ++i) text += (i ? ", " : "") + seen[i];
  return text + (seen.size() > few ? ", ..." : "");
}

constexpr double most = 1e290;  // SI: leaves room for any unit and margin

bool drawable(const Point& p) { return std::abs(p.x) <= most && std::abs(p.y) <= most; }

template <class Value>
double largest(const std::vector<const Measured*>& curves, Value value_of) {
  double result = 0;
  for (const Measured* curve : curves)
    for (const Point& p : curve->trace.points())
      if (drawable(p)) result = std::max(result, std::abs(value_of(p)));
  return result;
}

const Measure& along_x(const Measured& curve) { return curve.x.measure; }
const Measure& along_y(const Measured& curve) { return curve.y.measure; }

/// Over several powers of ten no multiple of a unit is better than the unit.
Shown unit_of(const Measure& measure, const Look& look, bool logarithmic, double up_to) {
  return shown(measure, look.units, logarithmic ? 0 : up_to);
}

std::vector<Group> grouped(const std::vector<const Measured*>& curves) {
  std::vector<Group> groups;
  for (const Measured* curve : curves) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.front()->panel == curve->panel && compatible(g.front()->y.measure, curve->y.measure); });
    if (group == groups.end()) group = groups.insert(groups.end(), Group{});
    group->push_back(curve);
  }
  return groups;
}

/// Every unit asked for has an axis.
void check_units(const std::vector<const Measured*>& curves, const Look& look) {
  for (const std::string& unit : look.units) {
    const auto parsed = parse_unit(unit);
    if (const TextError* wrong = std::get_if<TextError>(&parsed))
      throw Mistake(fmt::format("`{}` is no unit: {}", unit, wrong->message), wrong->hint);
    const Measure wished{"", unit, std::get<Unit>(parsed)};
    if (std::any_of(curves.begin(), curves.end(), [&](const Measured* c) {
          return compatible(wished, c->x.measure) || compatible(wished, c->y.measure);
        }))
      continue;
    throw Mistake(fmt::format("no axis shows {}, as the unit `{}` would need",
                              describe(wished.size->dimension, wished.size->radian), unit));
  }
}

void check_x(const std::vector<const Measured*>& curves) {
  for (const Measured* curve : curves) {
    if (compatible(curves.front()->x.measure, curve->x.measure)) continue;
    throw Mistake(fmt::format("`{}` is {}, and `{}` is {}: the two cannot share the horizontal axis",
                              curves.front()->x.name, with_unit(curves.front()->x.measure), curve->x.name,
                              with_unit(curve->x.measure)));
  }
}

void check_range(const std::optional<std::pair<double, double>>& range, bool logarithmic, const char* axis) {
  if (!range) return;
  const auto [low, high] = *range;
  if (logarithmic && low <= 0)
    throw Mistake(
        fmt::format("the range of the {} axis begins at {:g}, but a logarithmic axis begins above 0", axis, low));
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(high - low >= 1e-9 * largest) || !(high - low >= 1e-290) || !(largest <= 1e290))
    throw Mistake(fmt::format("{:.17g} to {:.17g} is no range for the numbers of the {} axis", low, high, axis));
}

Curve in_units(const Measured& measured, double x_factor, double y_factor, bool magnitude,
               std::vector<std::string>& notes) {
  Curve curve{measured.name, measured.trace.points(), measured.style};
  std::size_t gaps = 0, too_large = 0;
  for (Point& p : curve.points) {
    if (!drawable(p)) {
      ++gaps;
      if (std::isfinite(p.x) && std::isfinite(p.y)) ++too_large;
      p.y = std::numeric_limits<double>::quiet_NaN();
    }
    p = {p.x / x_factor, (magnitude ? std::abs(p.y) : p.y) / y_factor};
  }
  const char* const what = too_large == 0 ? "not finite" : too_large == gaps ? "beyond 1e290" : "not finite or beyond 1e290";
  if (gaps == curve.points.size())
    throw Mistake(fmt::format("`{}` has no value to draw: all are {}", measured.name, what));
  if (gaps > 0)
    notes.push_back(
        fmt::format("`{}`: {} of {} points are {} and left out", measured.name, gaps, curve.points.size(), what));
  return curve;
}

void note_dropped(Figure& figure, std::vector<std::string>& notes) {
  for (const Dropped& dropped : drop_what_has_no_logarithm(figure)) {
    if (dropped.points == dropped.of)
      throw Mistake(fmt::format("`{}` has no value above 0 for a logarithmic axis", dropped.curve),
                    "--abs draws magnitudes");
    notes.push_back(fmt::format("`{}`: {} of {} points are not above 0 and left out of the logarithmic axis",
                                dropped.curve, dropped.points, dropped.of));
  }
}

/// Throws Mistake if no part of the curves is within the range that is asked for. `told`: the label of the axis, "time [s]".
void check_shown(const Axis& axis, const std::string& told, const std::vector<Panel>& panels, double Point::*along) {
  if (!axis.range) return;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Panel& panel : panels)
    for (const Curve& curve : panel.curves)
      for (const Point& p : curve.points)
        if (std::isfinite(p.x) && std::isfinite(p.y)) least = std::min(least, p.*along), greatest = std::max(greatest, p.*along);
  const auto [low, high] = *axis.range;
  if (greatest < low || least > high)
    throw Mistake(fmt::format("nothing is drawn within {:g} to {:g}", low, high),
                  fmt::format("{} goes from {:.4g} to {:.4g}", told, least, greatest));
}

}  // namespace

Figure compose(std::vector<Measured> measured, const Look& look, std::vector<std::string>& notes) {
  std::vector<const Measured*> curves;
  for (const Measured& curve : measured) curves.push_back(&curve);
  if (curves.empty()) throw Mistake("there is nothing to draw");
  check_x(curves);
  check_units(curves, look);
  check_range(look.x_range, look.logarithmic_x, "horizontal");
  check_range(look.y_range, look.logarithmic_y, "vertical");
  std::vector<Group> groups = grouped(curves);
  if (groups.size() > 1 && (look.y_range || !look.y_label.empty()))
    throw Mistake(fmt::format("a range or a label of the vertical axis, but there are {}: {}, {}", groups.size(),
                              with_unit(along_y(*groups[0][0])), with_unit(along_y(*groups[1][0]))),
                  "name columns of one quantity with -y");

  Figure figure{
      .title = look.title, .x = {}, .panels = {}, .marks = look.marks, .width = look.width, .height = look.height};
  const Shown x = curves[0]->x_unit.value_or(
      unit_of(along_x(*curves[0]), look, look.logarithmic_x, largest(curves, [](const Point& p) { return p.x; })));
  figure.x = {look.x_label.empty() ? with_unit(quantities(curves, along_x), x.name) : look.x_label, look.logarithmic_x,
              look.x_range};
  for (Group& group : groups) {
    const Shown y = group[0]->y_unit.value_or(
        unit_of(along_y(*group[0]), look, look.logarithmic_y, largest(group, [](const Point& p) { return p.y; })));
    const std::string quantity = (look.magnitudes ? "magnitude of " : "") + quantities(group, along_y);
    Panel panel{{look.y_label.empty() ? with_unit(quantity, y.name) : look.y_label, look.logarithmic_y, look.y_range},
                {}};
    for (const Measured* curve : group)
      panel.curves.push_back(in_units(*curve, x.factor, y.factor, look.magnitudes, notes));
    figure.panels.push_back(std::move(panel));
  }
  note_dropped(figure, notes);
  check_shown(figure.x, with_unit(quantities(curves, along_x), x.name), figure.panels, &Point::x);
  if (look.y_range) check_shown(figure.panels[0].y, figure.panels[0].y.label, figure.panels, &Point::y);
  return figure;
}

}  // namespace rheonet::plot
