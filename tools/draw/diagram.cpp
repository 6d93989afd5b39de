#include "tools/draw/diagram.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "core/network/component.hpp"
#include "tools/draw/caption.hpp"
#include "tools/draw/layers.hpp"
#include "tools/draw/symbol_path.hpp"

namespace rheonet::draw {
namespace {

constexpr double port_distance = 17, track = 9, clearance = 16, channel = 10;

/// A block, or a name at either side of the blocks: that of a record which is sensed, or of a parameter which is fed.
struct Item {
  int block = -1;  ///< index into Scene::blocks
  std::string text;
  std::vector<Label> labels;   ///< around (0, 0)
  double half = 0;             ///< of its width
  double left = 0, right = 0;  ///< where lines come in and go out, from its middle
};

/// Lines of one signal through one gap between layers.
struct Net {
  double from;             ///< height at which it comes from the left
  std::vector<double> to;  ///< heights at which it goes on to the right
  double x = 0;            ///< of its vertical track
  double later = 0;        ///< of a second one, for those of `to` at which another net turns off before
  std::vector<double> late;

  bool straight() const {
    return std::all_of(to.begin(), to.end(), [this](double y) { return std::abs(y - from) < 0.01; });
  }
};

class Diagram {
 public:
  /// The diagram of some of the blocks, which nothing connects to the others.
  Diagram(const Scene& scene, const Detail& detail, const std::vector<int>& blocks)
      : scene_(scene), detail_(detail), size_(0.75 * detail.symbol) {
    for (const int block : blocks) add_block(block);
    for (const int block : blocks) add_inputs(block);
    const auto lead_to = [&](int block, const std::string& name, double sign) {
      const auto from = item_of_.find(block);
      if (from == item_of_.end()) return;
      graph_.lines.push_back({from->second, add_text(name), 0, false, {}});
      signs_.push_back(sign);
    };
    for (const SceneFeed& feed : scene.feeds) lead_to(feed.block, scene.elements[static_cast<std::size_t>(feed.element)].name, feed.sign);
    // A law takes a signal in once, whichever of its parts do.
    std::set<std::pair<int, std::string>> taken;
    for (const SceneBlock& part : scene.blocks) {
      const SceneElement& of = scene.elements[static_cast<std::size_t>(part.element)];
      const std::string owner = of.name.substr(0, of.name.rfind('.'));
      for (const SceneBlock::Input& input : part.inputs)
        if (of.part != SceneElement::Part::none && input.from_block && taken.emplace(input.index, owner).second) lead_to(input.index, owner, input.sign);
    }
    graph_.arrange();
    sort_ports();
    find_columns();
  }

  Piece draw() {
    Piece all;
    for (std::size_t i = 0; i < items_.size(); ++i) item(all, i);
    for (std::size_t k = 0; k < graph_.lines.size(); ++k) line(all, k);
    double top = graph_.items[0].y, bottom = top;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      top = std::min(top, graph_.items[i].y - graph_.items[i].up);
      bottom = std::max(bottom, graph_.items[i].y + graph_.items[i].down);
    }
    all.up = -top;
    all.down = std::max(bottom, bottom_);
    all.width = width_;
    return all;
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  int layer(std::size_t i) const { return graph_.items[i].layer; }

  const SceneElement& element(int block) const { return scene_.elements[at(scene_.blocks[at(block)].element)]; }
  double height_of(int block) const {
    return std::max(size_, port_distance * static_cast<double>(scene_.blocks[at(block)].inputs.size()) + 8);
  }
  /// Whether a block is drawn as a box: more than two inputs have no room at the side of a round symbol.
  bool framed(int block) const { return scene_.blocks[at(block)].inputs.size() > 2; }

  void add_block(int block) {
    Item item{.block = block, .text = {}, .labels = {}};
    const double half = height_of(block) / 2, side = size_ / 2;
    Layers::Item box{half, half, 0, 0};
    item.half = side;
    if (detail_.names) {
      const Caption caption = caption_of(scene_, scene_.blocks[at(block)].element, detail_.values, detail_.typed);
      item.labels.push_back({caption.name, {0, -half - name_gap}, true, 12, Label::Kind::name});
      for (std::size_t i = 0; i < caption.values.size(); ++i)
        item.labels.push_back(
            {caption.values[i], {0, half + 11 + line_height * static_cast<double>(i)}, true, 11, Label::Kind::value});
      for (const Label& label : item.labels) item.half = std::max(item.half, label.box().right + 3);
      box.up += line_height + name_gap;
      box.down += line_height * static_cast<double>(caption.values.size()) + 2;
    }
    item.left = -side;
    item.right = side;
    item_of_[block] = static_cast<int>(items_.size());
    items_.push_back(std::move(item));
    graph_.items.push_back(box);
  }

  int add_text(const std::string& text) {
    Item item{.block = -1, .text = text, .labels = {}};
    const Label label{text, {0, 4}, true, 11, Label::Kind::value};
    item.half = (detail_.names ? label.box().right : 4) + 4;
    item.left = -item.half;
    item.right = item.half;
    if (detail_.names) item.labels.push_back(label);
    items_.push_back(std::move(item));
    graph_.items.push_back({8, 8, 0, 0});
    return static_cast<int>(items_.size()) - 1;
  }

  void add_inputs(int block) {
    const std::vector<SceneBlock::Input>& inputs = scene_.blocks[at(block)].inputs;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      const int from =
          inputs[k].from_block ? item_of_.at(inputs[k].index) : add_text(scene_.sensed[at(inputs[k].index)].path);
      graph_.lines.push_back({from, item_of_.at(block), port(k, inputs.size()), false, {}});
      signs_.push_back(inputs[k].sign);
    }
  }
  static double port(std::size_t k, std::size_t count) {
    return port_distance * (static_cast<double>(k) - 0.5 * static_cast<double>(count - 1));
  }

  /// The inputs of a block from top to bottom as what they come from; those that lead back come from below.
  void sort_ports() {
    std::map<int, std::vector<std::size_t>> ins;
    for (std::size_t k = 0; k < graph_.lines.size(); ++k) ins[graph_.lines[k].to].push_back(k);
    for (auto& [to, lines] : ins) {
      if (items_[at(to)].block < 0) continue;
      std::stable_sort(lines.begin(), lines.end(),
                       [this](std::size_t a, std::size_t b) { return origin(a) < origin(b); });
      for (std::size_t k = 0; k < lines.size(); ++k) graph_.lines[lines[k]].in = port(k, lines.size());
    }
  }
  double origin(std::size_t k) const {
    const Layers::Line& line = graph_.lines[k];
    if (line.back) return 1e9;
    return graph_.items[at(line.through.empty() ? line.from : line.through.back())].y;
  }

  /// The gap to the left of layer 0 is gap 0.
  Net& net(int gap, int signal, double from) {
    Net& found = nets_[{gap, signal}];
    found.from = from;
    return found;
  }

  void find_columns() {
    const std::size_t count = graph_.layers.size();
    double bottom = 0;
    for (const Layers::Item& item : graph_.items) bottom = std::max(bottom, item.y + item.down);
    bottom_ = bottom;
    for (std::size_t k = 0; k < graph_.lines.size(); ++k) {
      const Layers::Line& line = graph_.lines[k];
      const double in = graph_.items[at(line.to)].y + line.in;
      if (line.back) {
        bottom_ += channel;
        net(layer(at(line.from)) + 1, line.from, graph_.items[at(line.from)].y).to.push_back(bottom_);
        net(layer(at(line.to)), returning(k), bottom_).to.push_back(in);
        channels_[k] = bottom_;
        continue;
      }
      int from = line.from;
      for (const int through : line.through) {
        net(layer(at(through)), from, graph_.items[at(from)].y).to.push_back(graph_.items[at(through)].y);
        from = through;
      }
      net(layer(at(line.to)), from, graph_.items[at(from)].y).to.push_back(in);
    }
    std::vector<double> halves(count);
    for (std::size_t i = 0; i < items_.size(); ++i)
      halves[at(layer(i))] = std::max(halves[at(layer(i))], items_[i].half);
    double x = 0;
    for (std::size_t gap = 0; gap <= count; ++gap) {
      x = place_tracks(static_cast<int>(gap), x + 4);
      if (gap == count) break;
      x += gap > 0 ? clearance : x > 4 ? clearance : 0;
      middles_.push_back(x + halves[gap]);
      x += 2 * halves[gap];
    }
    width_ = x;
  }
  /// The number of the end of a line that leads back: negative, where items have theirs from 0 on.
  int returning(std::size_t line) const { return -1 - static_cast<int>(line); }

  /// Gives each net of a gap that is not straight a vertical track; where the gap's tracks end.
  double place_tracks(int gap, double x) {
    std::vector<Net*> nets;
    for (auto& [key, each] : nets_)
      if (key.first == gap && !each.straight()) nets.push_back(&each);
    // First the nets that go down, the lowest first, then those that go up, the highest first: they cross each other least in this order.
    const auto rank = [](const Net* net) {
      const bool down = net->to.front() > net->from;
      return std::pair(!down, down ? -net->from : net->from);
    };
    std::stable_sort(nets.begin(), nets.end(), [&](const Net* a, const Net* b) { return rank(a) < rank(b); });
    std::vector<Net*> late;
    // A line that comes in at the height where another goes out must turn off before the other arrives.
    // Where two want that of each other, one of them arrives on a second track.
    const auto before = [](const Net* a, const Net* b) {
      return std::any_of(b->to.begin(), b->to.end(), [&](double y) { return std::abs(y - a->from) < 2; });
    };
    while (!nets.empty()) {
      auto next = std::find_if(nets.begin(), nets.end(), [&](const Net* candidate) {
        return std::none_of(nets.begin(), nets.end(),
                            [&](const Net* other) { return other != candidate && before(other, candidate); });
      });
      if (next == nets.end()) {
        next = nets.begin();
        late.push_back(*next);
        for (const double y : (*next)->to)
          if (std::any_of(nets.begin() + 1, nets.end(),
                          [&](const Net* other) { return std::abs(other->from - y) < 2; }))
            (*next)->late.push_back(y);
      }
      (*next)->x = x += track;
      nets.erase(next);
    }
    for (Net* const net : late) net->later = x += track;
    return x;
  }

  Point middle(std::size_t i) const { return {middles_[at(layer(i))], graph_.items[i].y}; }

  void item(Piece& all, std::size_t i) {
    const Point place = middle(i);
    for (Label label : items_[i].labels) {
      label.at = {label.at.x + place.x, label.at.y + place.y};
      all.ink.labels.push_back(std::move(label));
    }
    if (items_[i].block < 0) return;
    const double half = height_of(items_[i].block) / 2, side = size_ / 2;
    all.ink.marks.push_back({.element = scene_.blocks[at(items_[i].block)].element,
                             .box = {place.x - side, place.y - half, place.x + side, place.y + half},
                             .ends = {},
                             .framed = framed(items_[i].block)});
  }

  /// Takes out steps so small that they look like kinks: the line goes on at the height before such a step.
  static void straighten(std::vector<Point>& points) {
    constexpr double kink = 3;  // px
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double before = points[i - 1].y, after = points[i].y;
      if (before == after || std::abs(after - before) >= kink || points[i].x != points[i - 1].x) continue;
      for (std::size_t k = i; k < points.size() && points[k].y == after; ++k) points[k].y = before;
    }
    if (points.size() < 2) return;
    Point &tip = points.back(), &last = points[points.size() - 2];
    if (tip.x != last.x && tip.y != last.y) tip.y = last.y;
  }

  void line(Piece& all, std::size_t k) {
    const Layers::Line& line = graph_.lines[k];
    const Point start = middle(at(line.from)), end = middle(at(line.to));
    const double in = end.y + line.in;
    SignalLine drawn{{{start.x + items_[at(line.from)].right, start.y}}, items_[at(line.from)].block};
    const auto go = [&](int gap, int signal, double to) {
      const Net& through = nets_.at({gap, signal});
      if (through.straight()) return;
      const double y = drawn.points.back().y;
      drawn.points.push_back({through.x, y});
      if (std::find(through.late.begin(), through.late.end(), to) != through.late.end()) {
        const double aside = to + (y > to ? 5 : -5);
        drawn.points.push_back({through.x, aside});
        drawn.points.push_back({through.later, aside});
        drawn.points.push_back({through.later, to});
      } else {
        drawn.points.push_back({through.x, to});
      }
      if (through.to.size() > 1) all.ink.joints.push_back({through.x, y});
    };
    if (line.back) {
      go(layer(at(line.from)) + 1, line.from, channels_.at(k));
      go(layer(at(line.to)), returning(k), in);
    } else {
      int from = line.from;
      for (const int through : line.through) {
        go(layer(at(through)), from, graph_.items[at(through)].y);
        from = through;
      }
      go(layer(at(line.to)), from, in);
    }
    const double x = end.x + items_[at(line.to)].left;
    drawn.points.push_back({x, in});
    straighten(drawn.points);
    if (signs_[k] < 0 && detail_.names) {
      // Outside of the lines of a block's inputs, so that nobody takes it for that of the next one.
      const double tip = drawn.points.back().y, baseline = line.in > 0 ? tip + 10 : tip - 3.2;
      all.ink.labels.push_back({"−", {x - 10, baseline}, true, 11, Label::Kind::value});
    }
    all.ink.signals.push_back(std::move(drawn));
  }

  const Scene& scene_;
  const Detail& detail_;
  double size_;
  Layers graph_;
  std::map<int, int> item_of_;               ///< of each block
  std::vector<Item> items_;                  ///< the first of the graph's: blocks first
  std::vector<double> signs_;                ///< of the lines
  std::map<std::pair<int, int>, Net> nets_;  ///< by gap and signal
  std::map<std::size_t, double> channels_;   ///< heights of the lines that lead back
  std::vector<double> middles_;              ///< of the layers
  double bottom_ = 0, width_ = 0;
};

}  // namespace

namespace {

/// The parts of an element by a law are not.
bool is_drawn(const Scene& scene, std::size_t block) {
  return scene.elements[static_cast<std::size_t>(scene.blocks[block].element)].part == SceneElement::Part::none;
}

}  // namespace

std::vector<Piece> draw_blocks(const Scene& scene, const Detail& detail) {
  std::vector<int> group(scene.blocks.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    for (const SceneBlock::Input& input : scene.blocks[b].inputs) {
      if (!input.from_block || !is_drawn(scene, b)) continue;
      const int from = group[static_cast<std::size_t>(input.index)], to = group[b];
      std::replace(group.begin(), group.end(), std::max(from, to), std::min(from, to));
    }
  std::map<int, std::vector<int>> groups;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    if (is_drawn(scene, b)) groups[group[b]].push_back(static_cast<int>(b));
  std::vector<Piece> pieces;
  for (const auto& [first, blocks] : groups) pieces.push_back(Diagram(scene, detail, blocks).draw());
  return pieces;
}

}  // namespace rheonet::draw
