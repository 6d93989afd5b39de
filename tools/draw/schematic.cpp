#include "tools/draw/schematic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/draw/abridge.hpp"
#include "tools/draw/diagram.hpp"
#include "tools/draw/draftsman.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/plot/text.hpp"

namespace rheonet::draw {
namespace {

constexpr std::size_t few = 45;  // elements: names and values fit on a page
constexpr double margin = 16, between = 26, title_size = 15;

/// The detail for this many elements.
Detail detail_of(std::size_t count, const Look& look) {
  constexpr std::size_t many = 120;
  Detail detail;
  detail.values = look.values && count <= few;
  detail.nodes = count <= few;
  if (detail.values && look.sources) detail.typed = Typed(*look.sources);
  if (count > many) {
    detail.names = false;
    detail.symbol = 30;
    detail.drive = 22;
    detail.gap = 3;
  }
  // A page somewhat wider than high, however much is on it.
  const double area = static_cast<double>(count) * detail.symbol * detail.symbol * (detail.names ? 3.5 : 1.3);
  detail.line = std::max(1000.0, 1.5 * std::sqrt(area));
  detail.column = std::max(detail.names ? 900.0 : 0.0, 0.6 * detail.line);
  return detail;
}

/// Puts pieces beside each other as far as they fit, and below each other.
class Page {
 public:
  explicit Page(double width) : width_(width) {}

  void add(const Piece& piece) {
    if (x_ > margin && x_ + piece.width > margin + width_) new_shelf();
    shelf_.push_back({piece, x_});
    x_ += piece.width + between;
    right_ = std::max(right_, x_ - between);
  }

  Picture finish(const std::string& title) {
    new_shelf();
    picture_.title = title;
    picture_.width = right_ + margin;
    picture_.height = y_ - between + margin;
    return std::move(picture_);
  }
  void leave(double height) { y_ += height; }

  void new_shelf() {
    if (shelf_.empty()) return;
    double up = 0, down = 0;
    for (const Placed& placed : shelf_) {
      up = std::max(up, placed.piece.up);
      down = std::max(down, placed.piece.down);
    }
    for (const Placed& placed : shelf_) picture_.add(placed.piece.ink, {placed.x, y_ + up});
    y_ += up + down + between;
    x_ = margin;
    shelf_.clear();
  }

 private:
  struct Placed {
    Piece piece;
    double x;
  };

  double width_, x_ = margin, y_ = margin, right_ = 0;
  std::vector<Placed> shelf_;
  Picture picture_;
};

/// The network in the order in which it is drawn; `drawn` is how many elements that is.
Forest drawn_part(const Scene& scene, const Look& look, std::size_t& drawn) {
  drawn = scene.elements.size() - scene.blocks.size();
  const auto limit = [&](std::size_t most) {
    if (drawn > most)
      throw plot::Mistake(fmt::format("a drawing of {} elements would show nothing; it may have {}", drawn, most),
                          "fewer of a `repeat` show its structure as well: --set PATH.repeat.count=5");
  };
  limit(look.all ? most_drawn : most_elements);
  Forest forest = forest_of(scene);
  if (!look.all && drawn > few) drawn -= abridge(forest, scene);
  limit(most_drawn);
  return forest;
}

}  // namespace

Picture schematic(const Scene& scene, const Look& look) {
  std::size_t drawn = 0;
  const Forest forest = drawn_part(scene, look, drawn);
  const Detail detail = detail_of(drawn, look);
  const Draftsman draftsman(scene, detail);
  Page page(detail.line);
  const double title_height = 1.3 * title_size;
  const std::vector<std::string> title = plot::lines_of(look.title, title_size, detail.line);
  page.leave(title_height * static_cast<double>(title.size()));
  for (const Block& row : forest.rows) page.add(draftsman.draw(row));
  for (const Mesh& mesh : forest.meshes) page.add(draw_mesh(draftsman, mesh));
  if (!scene.blocks.empty()) {
    page.new_shelf();
    for (const Piece& piece : draw_blocks(scene, detail_of(scene.blocks.size(), look))) page.add(piece);
  }
  Picture picture = page.finish(look.title);
  picture.omitted = scene.elements.size() - scene.blocks.size() - drawn;
  picture.stroke = detail.names ? 1.4 : 1;
  for (std::size_t i = 0; i < title.size(); ++i) {
    picture.labels.push_back({title[i],
                              {margin, margin + title_size + title_height * static_cast<double>(i) - 4},
                              false,
                              title_size,
                              Label::Kind::title});
    picture.width = std::max(picture.width, picture.labels.back().box().right + margin);
  }
  return picture;
}

}  // namespace rheonet::draw
