#include "tools/draw/draftsman.hpp"

#include <algorithm>

#include "core/network/component.hpp"
#include "tools/draw/caption.hpp"
#include "tools/draw/symbol_path.hpp"
#include "tools/plot/text.hpp"

namespace rheonet::draw {
namespace {

constexpr double name_size = 12, value_size = 11, node_size = 10;
constexpr double lead = 6;  // of wire beside a symbol
constexpr double wall_margin = 14, wall_depth = 10;

Label label(const std::string& text, Point at, Label::Kind kind, bool centred = true) {
  const double size = kind == Label::Kind::name ? name_size : kind == Label::Kind::node ? node_size : value_size;
  return {text, at, centred, size, kind};
}

double width_of(const Label& label) { return label.box().right - label.box().left; }

/// Name above, values below: as labels around (x, 0), and how wide they are.
double caption_around(const Caption& caption, double x, double up, double down, std::vector<Label>& labels) {
  labels.push_back(label(caption.name, {x, -up - name_gap}, Label::Kind::name));
  for (std::size_t i = 0; i < caption.values.size(); ++i)
    labels.push_back(
        label(caption.values[i], {x, down + 11 + line_height * static_cast<double>(i)}, Label::Kind::value));
  double width = 0;
  for (const Label& each : labels) width = std::max(width, width_of(each));
  return width;
}

/// Nodes between the members of a group, which nobody named: `pivot.node3`.
bool is_unnamed(const std::string& node) {
  const std::size_t dot = node.rfind('.');
  const std::string last = dot == node.npos ? "" : node.substr(dot + 1);
  return last.starts_with("node") && last.find_first_not_of("0123456789", 4) == last.npos;
}

}  // namespace

void Piece::add(const Piece& other, Point at) {
  ink.add(other.ink, at);
  up = std::max(up, other.up - at.y);
  down = std::max(down, other.down + at.y);
}

void Piece::wire(NodeId node, std::vector<Point> points) {
  const Point first = points.front();
  if (std::any_of(points.begin(), points.end(), [&](Point p) { return p.x != first.x || p.y != first.y; }))
    ink.wires.push_back({node, std::move(points), {}});
}

Draftsman::Draftsman(const Scene& scene, const Detail& detail)
    : scene_(scene), detail_(detail), bodies_(scene.nodes.size()), drives_(scene.nodes.size()) {
  for (std::size_t i = 0; i < scene.elements.size(); ++i) {
    const SceneElement& element = scene.elements[i];
    const Role role = components()[static_cast<std::size_t>(element.declaration)]->role;
    if (!element.at || role == Role::block) continue;
    const bool drives = role == Role::motion || role == Role::force;
    (drives ? drives_ : bodies_)[static_cast<std::size_t>(element.a)].push_back(static_cast<int>(i));
  }
}

Piece Draftsman::draw(const Block& block, double line) const {
  switch (block.kind) {
    case Block::Kind::element:
      return element(block);
    case Block::Kind::parallel:
      return draw_parallel(*this, block, line);
    case Block::Kind::omitted:
      return omission_in_row(block);
    case Block::Kind::series:
      break;
  }
  return draw_row(*this, block, line);
}

Piece Draftsman::element(const Block& block) const {
  const double size = detail_.symbol;
  Piece piece;
  const Reach reach = reach_of(block.of_support ? support_symbol() : symbol_of(scene_, block.element));
  piece.up = reach.up * size;
  piece.down = reach.down * size;
  double text = 0;
  std::vector<Label> labels;
  if (detail_.names) {
    const Caption caption = block.of_support ? support_caption(scene_, block.element) : caption_of(scene_, block.element, detail_.values, detail_.typed);
    text = caption_around(caption, 0, piece.up, piece.down, labels) + 14;
    piece.up += line_height + name_gap;
    piece.down += line_height * static_cast<double>(caption.values.size()) + 2;
  }
  piece.width = std::max(size + 2 * lead, text);
  const double middle = piece.width / 2, left = middle - size / 2, right = middle + size / 2;
  for (Label& each : labels) {
    each.at.x += middle;
    piece.ink.labels.push_back(std::move(each));
  }
  piece.ink.marks.push_back({.element = block.element,
                             .box = {left, -size / 2, right, size / 2},
                             .mirrored = !block.of_support && scene_.elements[static_cast<std::size_t>(block.element)].a != block.left,
                             .ends = {{block.left, {left, 0}}, {block.right, {right, 0}}},
                             .of_support = block.of_support});
  piece.wire(block.left, {{0, 0}, {left, 0}});
  piece.wire(block.right, {{right, 0}, {piece.width, 0}});
  return piece;
}

Label omission_label(int times, Point middle) {
  return {std::to_string(times) + " more", middle, true, value_size, Label::Kind::value};
}

Piece Draftsman::omission_in_row(const Block& block) const {
  constexpr double stub = 14, room = 62;
  Piece piece;
  piece.width = room + 2 * stub;
  piece.up = line_height + 4;
  piece.down = 6;
  piece.wire(block.left, {{0, 0}, {stub, 0}});
  piece.wire(block.right, {{piece.width - stub, 0}, {piece.width, 0}});
  const double middle = piece.width / 2;
  for (const double x : {-12.0, 0.0, 12.0}) piece.ink.joints.push_back({middle + x, 0});
  piece.ink.labels.push_back(omission_label(block.times, {middle, -8}));
  return piece;
}

// An arrow that ends at the node, to its left, or begins there, to its right. It points backward if what it stands for acts in the negative direction.
void Draftsman::drive(Stand& stand, int element, bool from_left) const {
  const double size = detail_.drive;
  const NodeId node = scene_.elements[static_cast<std::size_t>(element)].a;
  const Reach reach = reach_of(symbol_of(scene_, element));
  const double above = reach.up * size, below = reach.down * size;
  std::vector<Label> labels;
  double width = size;
  stand.up = std::max(stand.up, above);
  stand.down = std::max(stand.down, below);
  if (detail_.names) {
    const Caption caption = caption_of(scene_, element, detail_.values, detail_.typed);
    width = std::max(width, caption_around(caption, 0, above, below, labels) + 12);
    stand.up = std::max(stand.up, above + line_height + name_gap);
    stand.down = std::max(stand.down, below + line_height * static_cast<double>(caption.values.size()) + 2);
  }
  for (Label& each : labels) {
    each.at.x += stand.width + width / 2;
    stand.ink.labels.push_back(std::move(each));
  }
  // In the middle of its texts, which are wider than it is.
  const double left = stand.width + (width - size) / 2;
  const Point end{from_left ? left + size : left, 0};
  stand.ink.marks.push_back({element, {left, -size / 2, left + size, size / 2}, acts_backward(scene_, element), {{node, end}}});
  stand.wire(node, {end, {from_left ? stand.width + width : stand.bar, 0}});
  stand.width += width;
}

// An arrow on a pole above the node, as the coordinate of a mass is drawn.
void Draftsman::drive_above(Stand& stand, int element, double& top) const {
  const double size = detail_.drive;
  const NodeId node = scene_.elements[static_cast<std::size_t>(element)].a;
  const Reach reach = reach_of(symbol_of(scene_, element));
  const double y = top - reach.down * size - 4;
  stand.wire(node, {{stand.bar, 0}, {stand.bar, y}});
  stand.ink.marks.push_back(
      {element, {stand.bar, y - size / 2, stand.bar + size, y + size / 2}, acts_backward(scene_, element), {{node, {stand.bar, y}}}});
  stand.width = std::max(stand.width, stand.bar + size);
  top = y - reach.up * size;
  if (detail_.names) {
    const Caption caption = caption_of(scene_, element, detail_.values, detail_.typed);
    std::vector<std::string> lines{caption.name};
    lines.insert(lines.end(), caption.values.begin(), caption.values.end());
    double baseline = top - 4 - line_height * static_cast<double>(lines.size() - 1);
    top = baseline - line_height;
    for (std::size_t i = 0; i < lines.size(); ++i, baseline += line_height) {
      stand.ink.labels.push_back(
          label(lines[i], {stand.bar + 3, baseline}, i == 0 ? Label::Kind::name : Label::Kind::value, false));
      stand.width = std::max(stand.width, stand.ink.labels.back().box().right + 4);
    }
  }
  stand.up = std::max(stand.up, -top);
}

// A box with its name and value in it. Returns its middle.
double Draftsman::body(Stand& stand, NodeId node, int element, const Place& place) const {
  const double least = 0.62 * detail_.symbol;
  double width = least, height = least;
  std::vector<Label> labels;
  if (detail_.names) {
    const Caption caption = caption_of(scene_, element, detail_.values, detail_.typed);
    std::vector<std::string> lines{caption.name};
    lines.insert(lines.end(), caption.values.begin(), caption.values.end());
    height = std::max(height, line_height * static_cast<double>(lines.size()) + 16);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double y = (static_cast<double>(i) - 0.5 * static_cast<double>(lines.size() - 1)) * line_height + 4;
      labels.push_back(label(lines[i], {0, y}, i == 0 ? Label::Kind::name : Label::Kind::value));
      width = std::max(width, width_of(labels.back()) + 12);
    }
  }
  constexpr double margin = 12;
  const double top = place.stretched ? std::min(-height / 2, place.low - margin) : -height / 2;
  const double bottom = place.stretched ? std::max(height / 2, place.high + margin) : height / 2;
  const double middle = stand.width + width / 2;
  for (Label& each : labels) {
    each.at = {middle, each.at.y + (top + bottom) / 2};
    stand.ink.labels.push_back(std::move(each));
  }
  stand.ink.marks.push_back(
      {element, {stand.width, top, stand.width + width, bottom}, false, {{node, {middle, 0}}}, least});
  stand.width += width;
  stand.up = std::max(stand.up, -top);
  stand.down = std::max(stand.down, bottom);
  return middle;
}

// Ground stands wherever it is met. Elements without effect, both of whose ends are ground, are beside a wall of their own.
Draftsman::Stand Draftsman::wall(const Place& place) const {
  Stand stand;
  const bool right = !place.first;
  stand.bar = right ? 2 : wall_depth;
  stand.width = wall_depth + 2;
  stand.ink.walls.push_back({stand.bar, place.low - wall_margin, place.high + wall_margin, right});
  stand.up = wall_margin - place.low;
  stand.down = wall_margin + place.high;
  stand.wire(ground, {{stand.bar, place.low}, {stand.bar, place.high}});
  if (!place.first || !place.last) return stand;
  for (const int element : bodies_[ground]) {
    const double middle = body(stand, ground, element, place);
    stand.wire(ground, {{stand.bar, 0}, {middle, 0}});
  }
  for (const int element : drives_[ground]) drive(stand, element, false);
  return stand;
}

Draftsman::Stand Draftsman::stand(NodeId node, const Place& place) const {
  if (node == ground) return wall(place);
  std::vector<int> drives = drives_[static_cast<std::size_t>(node)];
  const std::vector<int>& bodies = bodies_[static_cast<std::size_t>(node)];
  Stand stand;
  stand.up = -place.low;
  stand.down = place.high;
  const auto next_drive = [&drives] {
    const int first = drives.front();
    drives.erase(drives.begin());
    return first;
  };
  const std::string& name = scene_.nodes[static_cast<std::size_t>(node)].name;
  const bool named = detail_.nodes && !is_unnamed(name);
  const double half = named ? width_of(label(name, {}, Label::Kind::node)) / 2 + 2 : 2;
  const bool driven_from_left = place.first && !drives.empty();
  if (driven_from_left) drive(stand, next_drive(), true);
  const double edge = stand.width;
  double foot = place.high, from = bodies.empty() ? stand.width + half : 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double middle = body(stand, node, bodies[i], place);
    foot = std::max(foot, stand.ink.marks.back().box.bottom);
    if (i == 0) from = std::max(middle, edge + half);
    if (i > 0) stand.wire(node, {{from, 0}, {middle, 0}});
    if (i == 0 && middle < from) stand.wire(node, {{middle, 0}, {from, 0}});
  }
  stand.bar = from;
  stand.width = std::max(stand.width, from + half);
  if (driven_from_left) stand.wire(node, {{edge, 0}, {stand.bar, 0}});
  stand.wire(node, {{stand.bar, place.low}, {stand.bar, place.high}});
  if (place.last && !place.first && !drives.empty()) drive(stand, next_drive(), false);
  double top = bodies.empty() ? place.low : -stand.up;
  while (!drives.empty()) drive_above(stand, next_drive(), top);
  if (named) {
    stand.ink.labels.push_back(label(name, {stand.bar, foot + 11}, Label::Kind::node));
    stand.down = std::max(stand.down, foot + 14);
  }
  return stand;
}

}  // namespace rheonet::draw
