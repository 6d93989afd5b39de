#include "tools/draw/abridge.hpp"

#include <algorithm>
#include <string>

#include "core/network/component.hpp"

namespace rheonet::draw {
namespace {

constexpr std::size_t many = 6;    // times the same
constexpr std::size_t before = 2;  // of them are drawn, and the last

/// Equal parts one after the other: `times` times `period` parts from `begin` on.
struct Run {
  std::size_t begin, period, times;
};

/// The next run from `begin` on that is worth abridging.
bool find_run(const std::vector<std::string>& parts, std::size_t begin, Run& run) {
  constexpr std::size_t longest = 8;
  for (; begin < parts.size(); ++begin)
    for (std::size_t period = 1; period <= longest && begin + many * period <= parts.size(); ++period) {
      std::size_t end = begin + period;
      while (end < parts.size() && parts[end] == parts[end - period]) ++end;
      run = {begin, period, (end - begin) / period};
      if (run.times >= many) return true;
    }
  return false;
}

class Abridgement {
 public:
  explicit Abridgement(const Scene& scene) : scene_(scene), at_(scene.nodes.size()) {
    for (std::size_t i = 0; i < scene.elements.size(); ++i) {
      const SceneElement& element = scene.elements[i];
      const bool block = components()[static_cast<std::size_t>(element.declaration)]->role == Role::block;
      if (element.at && !block) at_[static_cast<std::size_t>(element.a)].push_back(static_cast<int>(i));
    }
  }

  void abridge(Block& block) {
    for (Block& part : block.parts) abridge(part);
    for (Station& station : block.stations)
      for (Block& way : station.hanging) abridge(way);
    if (block.kind == Block::Kind::parallel) abridge_parallel(block);
    if (block.kind == Block::Kind::series) abridge_series(block);
  }

  std::size_t omitted() const { return omitted_; }

 private:
  const std::vector<int>& at(const Station& station) const { return at_[static_cast<std::size_t>(station.node)]; }

  /// A text that is the same for parts that look the same.
  std::string shape_of(const Block& block) const {
    if (block.kind == Block::Kind::omitted) return "...";
    if (block.kind == Block::Kind::element) {
      const SceneElement& element = scene_.elements[static_cast<std::size_t>(block.element)];
      return std::to_string(element.declaration) + (block.of_support ? "s" : element.a == block.left ? "" : "r");
    }
    std::string shape = block.kind == Block::Kind::parallel ? "(" : "[";
    for (std::size_t i = 0; i < block.parts.size(); ++i) {
      if (i > 0 && i < block.stations.size()) shape += shape_of(block.stations[i]);
      shape += shape_of(block.parts[i]) + ",";
    }
    return shape + (block.kind == Block::Kind::parallel ? ")" : "]");
  }
  std::string shape_of(const Station& station) const {
    std::string shape = "<";
    for (const int element : at(station))
      shape += std::to_string(scene_.elements[static_cast<std::size_t>(element)].declaration) + ",";
    for (const Block& way : station.hanging) shape += shape_of(way) + ",";
    return shape + ">";
  }

  std::size_t elements_in(const Block& block) const {
    std::size_t count = block.kind == Block::Kind::element ? 1 : 0;
    for (const Block& part : block.parts) count += elements_in(part);
    for (std::size_t i = 0; i < block.stations.size(); ++i)
      if ((i > 0 || block.opens) && (i + 1 < block.stations.size() || block.closes))
        count += elements_in(block.stations[i]);
    return count;
  }
  std::size_t elements_in(const Station& station) const {
    std::size_t count = station.node == ground ? 0 : at(station).size();
    for (const Block& way : station.hanging) count += elements_in(way);
    return count;
  }

  static Block omission(const Run& run, NodeId left, NodeId right) {
    Block block;
    block.kind = Block::Kind::omitted;
    block.left = left;
    block.right = right;
    block.times = static_cast<int>(run.times - before - 1);
    return block;
  }

  void abridge_parallel(Block& block) {
    std::vector<std::string> shapes;
    for (const Block& part : block.parts) shapes.push_back(shape_of(part));
    std::vector<Block> kept;
    std::size_t copied = 0;
    const auto keep_to = [&](std::size_t end) {
      for (; copied < end; ++copied) kept.push_back(std::move(block.parts[copied]));
    };
    Run run{};
    for (std::size_t begin = 0; find_run(shapes, begin, run); begin = run.begin + run.period * run.times) {
      keep_to(run.begin + before * run.period);
      kept.push_back(omission(run, block.left, block.right));
      for (const std::size_t end = run.begin + (run.times - 1) * run.period; copied < end; ++copied)
        omitted_ += elements_in(block.parts[copied]);
    }
    keep_to(block.parts.size());
    block.parts = std::move(kept);
  }

  void abridge_series(Block& block) {
    std::vector<std::string> shapes;  // of each part and the station before it
    for (std::size_t i = 0; i < block.parts.size(); ++i) {
      const bool own = i > 0 || block.opens;
      shapes.push_back((own ? shape_of(block.stations[i]) : "<>") + shape_of(block.parts[i]));
    }
    std::vector<Block> parts;
    std::vector<Station> stations;
    std::size_t copied = 0;
    const auto keep_to = [&](std::size_t end) {
      for (; copied < end; ++copied) {
        stations.push_back(std::move(block.stations[copied]));
        parts.push_back(std::move(block.parts[copied]));
      }
    };
    Run run{};
    for (std::size_t begin = 0; find_run(shapes, begin, run); begin = run.begin + run.period * run.times) {
      keep_to(run.begin + before * run.period);
      const std::size_t end = run.begin + (run.times - 1) * run.period;
      parts.push_back(omission(run, block.stations[copied].node, block.stations[end].node));
      for (std::size_t i = copied; i < end; ++i) {
        omitted_ += elements_in(block.parts[i]);
        if (i > copied) omitted_ += elements_in(block.stations[i]);
      }
      stations.push_back(std::move(block.stations[copied]));
      copied = end;
    }
    keep_to(block.parts.size());
    stations.push_back(std::move(block.stations.back()));
    block.parts = std::move(parts);
    block.stations = std::move(stations);
  }

  const Scene& scene_;
  std::vector<std::vector<int>> at_;  ///< elements at each node
  std::size_t omitted_ = 0;
};

}  // namespace

std::size_t abridge(Forest& forest, const Scene& scene) {
  Abridgement abridgement(scene);
  for (Block& row : forest.rows) abridgement.abridge(row);
  for (Mesh& mesh : forest.meshes)
    for (Mesh::Link& link : mesh.links) abridgement.abridge(link.block);
  return abridgement.omitted();
}

}  // namespace rheonet::draw
