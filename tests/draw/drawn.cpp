#include "tests/draw/drawn.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tests/support/program.hpp"
#include "tools/draw/symbol_path.hpp"

namespace rheonet::test {

namespace {

using namespace rheonet::draw;
using draw::Box;  // not that of a law

constexpr double touch = 0.02;  // px: coordinates this close are one

/// A horizontal or vertical piece of a wire.
struct Piece {
  NodeId node;
  Point from, to;  ///< from.x <= to.x, from.y <= to.y
  const Wire* wire;

  bool horizontal() const { return to.y - from.y < touch; }
  bool holds(Point p) const {
    return p.x > from.x - touch && p.x < to.x + touch && p.y > from.y - touch && p.y < to.y + touch;
  }
};

bool meet(const Piece& a, const Piece& b) {
  return a.from.x < b.to.x + touch && b.from.x < a.to.x + touch && a.from.y < b.to.y + touch &&
         b.from.y < a.to.y + touch;
}

/// Groups of things that are joined.
class Groups {
 public:
  explicit Groups(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), std::size_t{0}); }
  std::size_t of(std::size_t i) {
    while (of_[i] != i) i = of_[i] = of_[of_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { of_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> of_;
};

/// The area of a symbol, slightly shrunk.
Box covered(const Mark& mark, const Scene& scene) {
  const Reach reach = reach_of((mark.of_support ? support_symbol() : symbol_of(scene, mark.element)));
  const double height = mark.box.bottom - mark.box.top, middle = (mark.box.top + mark.box.bottom) / 2;
  return {mark.box.left + 0.5, middle - reach.up * height + 0.5, mark.box.right - 0.5,
          middle + reach.down * height - 0.5};
}

class Inspection {
 public:
  Inspection(const Picture& picture, const Scene& scene) : picture_(picture), scene_(scene) {
    for (const Wire& wire : picture.wires)
      for (std::size_t i = 0; i + 1 < wire.points.size(); ++i) {
        const Point a = wire.points[i], b = wire.points[i + 1];
        pieces_.push_back(
            {wire.node, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}, &wire});
        if (std::abs(a.x - b.x) > touch && std::abs(a.y - b.y) > touch) say("a wire of {} is oblique", name(wire.node));
      }
  }

  std::string faults() {
    elements();
    nodes();
    crossings();
    overlaps();
    signals();
    inside();
    return faults_;
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    faults_ += fmt::format(text, std::forward<Args>(args)...) + '\n';
  }
  const std::string& name(NodeId n) const { return scene_.nodes[static_cast<std::size_t>(n)].name; }
  const std::string& element(int i) const { return scene_.elements[static_cast<std::size_t>(i)].name; }

  void elements() {
    std::vector<int> marks(scene_.elements.size());
    for (const Mark& mark : picture_.marks) {
      if (!mark.of_support) ++marks[static_cast<std::size_t>(mark.element)];
      const SceneElement& of = scene_.elements[static_cast<std::size_t>(mark.element)];
      const bool block = components()[static_cast<std::size_t>(of.declaration)]->role == Role::block;
      std::vector<NodeId> nodes, expected;
      for (const Mark::End& end : mark.ends) nodes.push_back(end.node);
      if (mark.of_support) expected = {of.b, of.support};
      else if (!block) expected = of.at ? std::vector{of.a} : std::vector{of.a, of.b};
      std::sort(nodes.begin(), nodes.end());
      std::sort(expected.begin(), expected.end());
      if (nodes != expected) say("{} ends at other nodes", of.name);
      // Mirrored or not, its port a is the one on the side of its first end.
      if (!mark.of_support && expected.size() == 2 && (mark.ends.front().node == of.a) == mark.mirrored)
        say("{} is the wrong way round", of.name);
    }
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (scene_.elements[i].part != SceneElement::Part::none) marks[i] = 1 - marks[i];  // none is drawn
    if (static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 0)) == picture_.omitted)
      std::replace(marks.begin(), marks.end(), 0, 1);
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (marks[i] != 1) say("{} has {} symbols", element(static_cast<int>(i)), marks[i]);
  }

  void nodes() {
    Groups groups(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (pieces_[i].node == pieces_[k].node && meet(pieces_[i], pieces_[k])) groups.join(i, k);
    std::map<NodeId, std::map<std::size_t, bool>> parts;  // of each node: its groups, and whether they reach a wall
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i];
      const bool wall = std::any_of(picture_.walls.begin(), picture_.walls.end(), [&](const Wall& w) {
        return w.x > piece.from.x - touch && w.x < piece.to.x + touch && w.top < piece.to.y && piece.from.y < w.bottom;
      });
      bool& walled = parts[piece.node][groups.of(i)];
      walled = walled || wall;
    }
    for (const auto& [node, of_node] : parts) {
      if (node != ground && of_node.size() != 1) say("the wires of {} are {} pieces", name(node), of_node.size());
      for (const auto& [group, walled] : of_node)
        if (walled != (node == ground)) say("{} {} a wall", name(node), walled ? "has" : "lacks");
    }
    for (const Mark& mark : picture_.marks)
      for (const Mark::End& end : mark.ends)
        if (!alone(end.node) && std::none_of(pieces_.begin(), pieces_.end(),
                                             [&](const Piece& p) { return p.node == end.node && p.holds(end.at); }))
          say("{} is not joined to {}", element(mark.element), name(end.node));
  }

  /// A mass with nothing else at its node.
  bool alone(NodeId node) const {
    return std::count_if(scene_.elements.begin(), scene_.elements.end(),
                         [node](const SceneElement& e) { return node != ground && (e.a == node || e.b == node); }) == 1;
  }

  void crossings() {
    for (const Piece& a : pieces_)
      for (const Piece& b : pieces_) {
        if (a.node == b.node || !meet(a, b)) continue;
        const bool hops = a.horizontal() != b.horizontal() && [&] {
          const Piece& over = a.horizontal() ? a : b;
          const Piece& under = a.horizontal() ? b : a;
          return std::any_of(over.wire->hops.begin(), over.wire->hops.end(),
                             [&](double x) { return std::abs(x - under.from.x) < touch; });
        }();
        if (!hops) say("wires of {} and {} meet", name(a.node), name(b.node));
      }
  }

  void overlaps() {
    const auto& labels = picture_.labels;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Box box = labels[i].box();
      for (std::size_t k = 0; k < i; ++k)
        if (box.overlaps(labels[k].box())) say("`{}` overlaps `{}`", labels[i].text, labels[k].text);
      for (const Piece& piece : pieces_)
        if (box.overlaps({piece.from.x, piece.from.y, piece.to.x, piece.to.y}) && !hidden(piece, box))
          say("a wire of {} runs through `{}`", name(piece.node), labels[i].text);
    }
    for (std::size_t i = 0; i < picture_.marks.size(); ++i) {
      const Mark& mark = picture_.marks[i];
      const Box box = covered(mark, scene_);
      for (std::size_t k = 0; k < i; ++k)
        if (box.overlaps(covered(picture_.marks[k], scene_)))
          say("{} overlaps {}", element(mark.element), element(picture_.marks[k].element));
      for (const Label& label : labels)
        if (box.overlaps(label.box()) && !is_body(mark)) say("`{}` is on {}", label.text, element(mark.element));
      for (const Piece& piece : pieces_)
        if (box.overlaps({piece.from.x, piece.from.y, piece.to.x, piece.to.y}) &&
            !(mark.ends.size() == 1 && mark.ends.front().node == piece.node))
          say("a wire of {} runs through {}", name(piece.node), element(mark.element));
    }
  }

  bool is_body(const Mark& mark) const {
    const SceneElement& of = scene_.elements[static_cast<std::size_t>(mark.element)];
    return components()[static_cast<std::size_t>(of.declaration)]->role == Role::mass;
  }
  /// Wires behind the box of a mass are not seen.
  bool hidden(const Piece& piece, const Box& label) const {
    return std::any_of(picture_.marks.begin(), picture_.marks.end(), [&](const Mark& mark) {
      return is_body(mark) && mark.ends.front().node == piece.node && mark.box.left <= label.left &&
             label.right <= mark.box.right && mark.box.top <= label.top && label.bottom <= mark.box.bottom;
    });
  }

  struct SignalPiece {
    std::size_t line;
    Box box;
  };

  void signals() {
    // For an element with a law of the netlist, only signals from other blocks are drawn, each once.
    const auto of = [&](int block) -> const SceneElement& { return scene_.elements[static_cast<std::size_t>(scene_.blocks[static_cast<std::size_t>(block)].element)]; };
    std::size_t expected = 0;
    std::set<std::pair<int, std::string>> taken;
    for (const SceneFeed& feed : scene_.feeds) expected += of(feed.block).part == SceneElement::Part::none;
    for (std::size_t b = 0; b < scene_.blocks.size(); ++b) {
      const SceneElement& taker = of(static_cast<int>(b));
      if (taker.part == SceneElement::Part::none) expected += scene_.blocks[b].inputs.size();
      for (const SceneBlock::Input& input : scene_.blocks[b].inputs)
        if (taker.part != SceneElement::Part::none && input.from_block && of(input.index).part == SceneElement::Part::none) taken.emplace(input.index, taker.name.substr(0, taker.name.rfind('.')));
    }
    expected += taken.size();
    if (picture_.signals.size() != expected) say("{} signals instead of {}", picture_.signals.size(), expected);
    std::vector<SignalPiece> pieces;
    for (std::size_t k = 0; k < picture_.signals.size(); ++k) {
      const std::vector<Point>& points = picture_.signals[k].points;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Point a = points[i], b = points[i + 1];
        if (std::abs(a.x - b.x) > touch && std::abs(a.y - b.y) > touch) say("signal {} is oblique", k);
        pieces.push_back({k, {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)}});
      }
      if (!begins(picture_.signals[k])) say("signal {} begins nowhere", k);
      if (!ends(points.back())) say("signal {} ends nowhere", k);
    }
    for (const SignalPiece& piece : pieces) {
      const auto runs_through = [&](Box box) {
        box = {box.left + 0.5, box.top + 0.5, box.right - 0.5, box.bottom - 0.5};
        return box.overlaps({piece.box.left, piece.box.top, piece.box.right, piece.box.bottom});
      };
      for (const Label& label : picture_.labels)
        if (runs_through(label.box())) say("signal {} runs through `{}`", piece.line, label.text);
      for (const Mark& mark : picture_.marks)
        if (runs_through(covered(mark, scene_))) say("signal {} runs through {}", piece.line, element(mark.element));
      for (const SignalPiece& other : pieces)
        if (other.line < piece.line && !same_signal(other.line, piece.line) && on_each_other(piece.box, other.box))
          say("signals {} and {} run on each other", other.line, piece.line);
    }
  }
  static bool on_each_other(const Box& a, const Box& b) {
    const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
    const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
    return width > -touch && height > -touch && std::max(width, height) > touch &&
           (a.right - a.left < touch) == (b.right - b.left < touch);
  }
  bool same_signal(std::size_t a, std::size_t b) const {
    const Point p = picture_.signals[a].points.front(), q = picture_.signals[b].points.front();
    return std::abs(p.x - q.x) < touch && std::abs(p.y - q.y) < touch;
  }
  bool begins(const SignalLine& line) const {
    const Point p = line.points.front();
    if (line.from < 0)
      return std::any_of(picture_.labels.begin(), picture_.labels.end(), [p](const Label& label) {
        const Box box = label.box();
        return std::abs(p.x - box.right) < 5 && box.top < p.y && p.y < box.bottom;
      });
    return std::any_of(picture_.marks.begin(), picture_.marks.end(), [&](const Mark& mark) {
      return mark.element == scene_.blocks[static_cast<std::size_t>(line.from)].element &&
             std::abs(mark.box.right - p.x) < touch && std::abs((mark.box.top + mark.box.bottom) / 2 - p.y) < touch;
    });
  }
  bool ends(Point p) const {
    return std::any_of(picture_.labels.begin(), picture_.labels.end(),
                       [p](const Label& label) {
                         const Box box = label.box();
                         return std::abs(box.left - p.x) < 5 && box.top < p.y && p.y < box.bottom;
                       }) ||
           std::any_of(picture_.marks.begin(), picture_.marks.end(), [p](const Mark& mark) {
             return mark.ends.empty() && std::abs(mark.box.left - p.x) < touch && mark.box.top < p.y &&
                    p.y < mark.box.bottom;
           });
  }

  void inside() {
    const auto check = [this](const Box& box, const std::string& what) {
      if (box.left < 0 || box.top < 0 || box.right > picture_.width || box.bottom > picture_.height)
        say("{} is outside", what);
    };
    for (const Mark& mark : picture_.marks) check(covered(mark, scene_), element(mark.element));
    for (const Label& label : picture_.labels) check(label.box(), '`' + label.text + '`');
    for (const Piece& piece : pieces_)
      check({piece.from.x, piece.from.y, piece.to.x, piece.to.y}, "a wire of " + name(piece.node));
    for (const SignalLine& line : picture_.signals)
      for (const Point& p : line.points) check({p.x, p.y, p.x, p.y}, "a signal");
    for (const Wall& wall : picture_.walls) check({wall.x - 8, wall.top, wall.x + 8, wall.bottom}, "a wall");
  }

  const Picture& picture_;
  const Scene& scene_;
  std::vector<Piece> pieces_;
  std::string faults_;
};

Scene sound(const ReadResult& result) {
  for (const Diagnostic& diagnostic : result.diagnostics)
    if (diagnostic.severity == Severity::error) FAIL(format(diagnostic, result.sources));
  REQUIRE(result.scene);
  return *result.scene;
}

const std::filesystem::path netlists = RHEONET_SOURCE_DIR "/netlists";

}  // namespace

Scene scene_from_file(const std::string& path) {
  ReadOptions options;
  options.model_folders = {netlists};
  return sound(read_scene(path, declarations(), options));
}

Scene scene_from(const std::string& netlist) {
  const Folder folder(netlist + "\n[simulate]\nstop = \"1 s\"\n");
  return scene_from_file((folder.path() / "scene.toml").string());
}

std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(netlists))
    if (entry.path().extension() == ".toml" && *std::filesystem::relative(entry.path(), netlists).begin() != "library")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string faults_of(const Picture& picture, const Scene& scene) { return Inspection(picture, scene).faults(); }

}  // namespace rheonet::test
