#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/network/component.hpp"
#include "tools/draw/picture.hpp"
#include "tools/draw/symbol_path.hpp"
#include "tools/plot/text.hpp"

namespace rheonet::draw {
namespace {

using plot::coordinate;
using plot::escaped;

const char* const ink = "#111111";
const char* const faint = "#666666";

std::string point(Point p) { return coordinate(p.x) + ' ' + coordinate(p.y); }

std::string path_of(const std::vector<Point>& points) {
  std::string path;
  for (const Point& p : points) path += (path.empty() ? 'M' : 'L') + point(p);
  return path;
}

/// A piece of the wires of a node that is straight all along: from `low` to `high` at the height or the x `at`.
struct Straight {
  NodeId node;
  bool horizontal;
  double at, low, high;
  std::vector<double> hops;  ///< x at which a horizontal one leaps over what it crosses
};

/// The wires in straight pieces, each as long as it can be: where two ends of lines meet within a straight line, the eye sees a bead.
std::vector<Straight> straight_pieces(const std::vector<Wire>& wires) {
  constexpr double same = 0.05;  // px, below which two heights are one
  std::vector<Straight> pieces;
  for (const Wire& wire : wires)
    for (std::size_t k = 0; k + 1 < wire.points.size(); ++k) {
      const Point a = wire.points[k], b = wire.points[k + 1];
      const bool horizontal = std::abs(a.y - b.y) < same;
      if (horizontal) pieces.push_back({wire.node, true, a.y, std::min(a.x, b.x), std::max(a.x, b.x), wire.hops});
      else pieces.push_back({wire.node, false, a.x, std::min(a.y, b.y), std::max(a.y, b.y), {}});
    }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Straight& a, const Straight& b) {
    return std::tuple(a.node, a.horizontal, std::round(a.at / same), a.low) < std::tuple(b.node, b.horizontal, std::round(b.at / same), b.low);
  });
  std::vector<Straight> joined;
  for (const Straight& piece : pieces) {
    const bool goes_on = !joined.empty() && joined.back().node == piece.node && joined.back().horizontal == piece.horizontal &&
                         std::abs(joined.back().at - piece.at) < 2 * same && piece.low <= joined.back().high + same;
    if (!goes_on) {
      joined.push_back(piece);
      continue;
    }
    joined.back().high = std::max(joined.back().high, piece.high);
    joined.back().hops.insert(joined.back().hops.end(), piece.hops.begin(), piece.hops.end());
  }
  for (Straight& piece : joined) std::sort(piece.hops.begin(), piece.hops.end());
  return joined;
}

std::string path_of(const Straight& wire) {
  const auto place = [&](double along) { return wire.horizontal ? Point{along, wire.at} : Point{wire.at, along}; };
  constexpr double radius = 4;
  std::string path = 'M' + point(place(wire.low));
  for (const double x : wire.hops)
    path += fmt::format("L{}A{} {} 0 0 1 {}", point({x - radius, wire.at}), radius, radius, point({x + radius, wire.at}));
  return path + 'L' + point(place(wire.high));
}

std::string part(const std::string& path, const Mark& mark, const char* attributes) {
  if (path.empty()) return "";
  return fmt::format("<path d=\"{}\"{}/>", fitted(path, mark.box, mark.mirrored, mark.unit), attributes);
}

/// The mark of a component in the middle of a box that is higher than its symbol.
Mark in_its_frame(const Mark& mark) {
  Mark inner = mark;
  const double half = (mark.box.right - mark.box.left) / 2, middle = (mark.box.top + mark.box.bottom) / 2;
  inner.box.top = middle - half;
  inner.box.bottom = middle + half;
  return inner;
}

std::string symbol(const Mark& mark, const Scene& scene) {
  const SceneElement& element = scene.elements[static_cast<std::size_t>(mark.element)];
  const Component& component = *components()[static_cast<std::size_t>(element.declaration)];
  const Symbol drawn = mark.of_support ? support_symbol() : symbol_of(scene, mark.element);
  const Mark within = mark.framed ? in_its_frame(mark) : mark;
  return fmt::format("<g class=\"{}\" data-element=\"{}\"><title>{} ({})</title>", component.declaration.type,
                     escaped(element.name), escaped(element.name), component.declaration.type) +
         part(mark.framed ? "M0 0 H1 V1 H0 Z" : drawn.outline, mark, " fill=\"#ffffff\"") +
         part(drawn.thin, within, " stroke-width=\"0.7\"") + part(drawn.lines, within, "") +
         part(drawn.solid, within, fmt::format(" fill=\"{}\" stroke=\"none\"", ink).c_str()) + "</g>\n";
}

std::string hatching(const Wall& wall) {
  constexpr double apart = 6, depth = 7;
  const double side = wall.right ? depth : -depth;
  std::string path;
  for (double y = wall.top + 3; y <= wall.bottom; y += apart)
    path += 'M' + point({wall.x, y}) + 'L' + point({wall.x + side, y + depth - 1});
  return fmt::format(
      "<path class=\"ground\" d=\"M{}V{}\" stroke-width=\"2.2\"/><path d=\"{}\" stroke-width=\"0.8\"/>\n",
      point({wall.x, wall.top}), coordinate(wall.bottom), path);
}

std::string arrow(const SignalLine& line, double stroke) {
  std::string text =
      fmt::format("<path class=\"signal\" d=\"{}\" stroke-width=\"{}\"/>", path_of(line.points), 0.8 * stroke);
  if (line.arrow) {
    const Point tip = line.points.back();
    text += fmt::format("<path d=\"M{}l-7 -3.2v6.4Z\" fill=\"{}\" stroke=\"none\"/>", point(tip), ink);
  }
  return text + '\n';
}

std::string text(const Label& label) {
  const bool node = label.kind == Label::Kind::node;
  return fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}{}>{}</text>\n", coordinate(label.at.x),
                     coordinate(label.at.y), coordinate(label.size), label.centred ? " text-anchor=\"middle\"" : "",
                     node ? fmt::format(" font-style=\"italic\" fill=\"{}\"", faint) : "",
                     label.kind == Label::Kind::name ? " font-weight=\"bold\"" : "",
                     label.kind == Label::Kind::value ? plot::raised(label.text) : escaped(label.text));
}

}  // namespace

Box Label::box() const {
  // Bold letters are wider by about a tenth.
  const double width = plot::width_of(text, size) * (kind == Kind::name ? 1.1 : 1);
  const double left = centred ? at.x - width / 2 : at.x;
  return {left, at.y - 0.8 * size, left + width, at.y + 0.25 * size};
}

void Picture::add(const Picture& other, Point by) {
  const auto moved = [by](Point p) { return Point{p.x + by.x, p.y + by.y}; };
  for (Mark mark : other.marks) {
    mark.box = {mark.box.left + by.x, mark.box.top + by.y, mark.box.right + by.x, mark.box.bottom + by.y};
    for (Mark::End& end : mark.ends) end.at = moved(end.at);
    marks.push_back(std::move(mark));
  }
  for (Wire wire : other.wires) {
    for (Point& p : wire.points) p = moved(p);
    for (double& x : wire.hops) x += by.x;
    wires.push_back(std::move(wire));
  }
  for (const Wall& wall : other.walls)
    walls.push_back({wall.x + by.x, wall.top + by.y, wall.bottom + by.y, wall.right});
  for (SignalLine line : other.signals) {
    for (Point& p : line.points) p = moved(p);
    signals.push_back(std::move(line));
  }
  for (Label label : other.labels) {
    label.at = moved(label.at);
    labels.push_back(std::move(label));
  }
  for (const Point& p : other.joints) joints.push_back(moved(p));
}

std::string svg(const Picture& picture, const Scene& scene) {
  std::string body;
  for (const Wall& wall : picture.walls) body += hatching(wall);
  for (const Straight& wire : straight_pieces(picture.wires))
    body += fmt::format("<path class=\"node\" data-node=\"{}\" d=\"{}\"/>\n",
                        escaped(scene.nodes[static_cast<std::size_t>(wire.node)].name), path_of(wire));
  for (const SignalLine& line : picture.signals) body += arrow(line, picture.stroke);
  for (const Point& p : picture.joints)
    body += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"none\"/>\n", coordinate(p.x),
                        coordinate(p.y), coordinate(1.7 * picture.stroke), ink);
  for (const Mark& mark : picture.marks) body += symbol(mark, scene);
  std::string words;
  for (const Label& label : picture.labels) words += text(label);
  const std::string title = picture.title.empty() ? "" : fmt::format("<title>{}</title>\n", escaped(picture.title));
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n{2}<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
      "<g fill=\"none\" stroke=\"{3}\" stroke-width=\"{4}\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\">\n{5}</g>\n"
      "<g fill=\"{3}\">\n{6}</g>\n</svg>\n",
      coordinate(picture.width), coordinate(picture.height), title, ink, coordinate(picture.stroke), body, words);
}

}  // namespace rheonet::draw
