#include <algorithm>
#include <iterator>
#include <limits>

#include "tools/draw/network_tree.hpp"

namespace rheonet::draw {
namespace {

/// A block as the only part of a row.
Block row_of(Block block) {
  if (block.kind == Block::Kind::series) return block;
  Block row;
  row.kind = Block::Kind::series;
  row.left = block.left;
  row.right = block.right;
  row.stations = {Station{block.left, {}}, Station{block.right, {}}};
  row.parts.push_back(std::move(block));
  return row;
}

template <class T>
void append(std::vector<T>& all, std::vector<T>& others) {
  all.insert(all.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
}

}  // namespace

Block Block::of_element(int element, NodeId left, NodeId right) {
  Block block;
  block.left = left;
  block.right = right;
  block.element = element;
  return block;
}

Block Block::of_node(NodeId node) {
  Block block;
  block.kind = Kind::series;
  block.left = block.right = node;
  block.stations = {Station{node, {}}};
  block.opens = block.closes = true;
  return block;
}

Block Block::in_series(Block first, Station middle, Block second) {
  Block row = row_of(std::move(first));
  Block rest = row_of(std::move(second));
  row.right = rest.right;
  row.closes = rest.closes;
  rest.stations.front() = std::move(middle);
  row.stations.pop_back();
  append(row.stations, rest.stations);
  append(row.parts, rest.parts);
  return row;
}

Block Block::in_parallel(Block first, Block second) {
  if (first.kind != Kind::parallel) {
    Block all;
    all.kind = Kind::parallel;
    all.left = first.left;
    all.right = first.right;
    all.parts.push_back(std::move(first));
    first = std::move(all);
  }
  if (second.kind == Kind::parallel)
    append(first.parts, second.parts);
  else
    first.parts.push_back(std::move(second));
  return first;
}

Block Block::in_row(Station first, Block part, Station last, bool opens, bool closes) {
  Block row = row_of(std::move(part));
  row.left = first.node;
  row.right = last.node;
  row.stations.front() = std::move(first);
  row.stations.back() = std::move(last);
  row.opens = opens;
  row.closes = closes;
  return row;
}

void Block::reverse() {
  std::swap(left, right);
  std::swap(opens, closes);
  if (kind == Kind::series) {
    std::reverse(parts.begin(), parts.end());
    std::reverse(stations.begin(), stations.end());
  }
  for (Block& part : parts) part.reverse();
}

int Block::first_element() const {
  if (kind == Kind::element) return element;
  int first = std::numeric_limits<int>::max();
  for (const Block& part : parts) first = std::min(first, part.first_element());
  return first;
}

int Block::levels() const {
  int most = 0;
  for (const Block& part : parts) most = std::max(most, part.levels());
  return most + (kind == Kind::parallel ? 1 : 0);
}

}  // namespace rheonet::draw
