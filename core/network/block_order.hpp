#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/index.hpp"
#include "core/network/blocks.hpp"

namespace rheonet {

/// An order in which each block follows those whose outputs it needs: a depth-first topological sort. `stops(block)`: it needs no
/// present input. `refuse_loop` gets the blocks of a loop, and throws.
template <class Stops, class Refuse>
std::vector<int> block_order(const std::vector<Blocks::Block>& blocks, const Stops& stops, const Refuse& refuse_loop) {
  enum : char { fresh, open, done };
  std::vector<char> mark(blocks.size(), fresh);
  std::vector<int> order;
  for (std::size_t first = 0; first < mark.size(); ++first) {
    std::vector<std::pair<int, std::size_t>> path;  // blocks, and number of their inputs visited
    if (mark[first] == fresh) path.emplace_back(static_cast<int>(first), 0);
    while (!path.empty()) {
      auto& [index, next] = path.back();
      const Blocks::Block& block = blocks[at(index)];
      mark[at(index)] = open;
      while (next < block.inputs.size() && (stops(block) || !block.inputs[next].from_block || mark[at(block.inputs[next].index)] == done)) ++next;
      if (next == block.inputs.size()) {
        mark[at(index)] = done;
        order.push_back(index);
        path.pop_back();
        continue;
      }
      const int needed = block.inputs[next].index;
      if (mark[at(needed)] == open) {
        std::vector<int> loop;
        for (const auto& [on_path, unused] : path)
          if (!loop.empty() || on_path == needed) loop.push_back(on_path);
        std::reverse(loop.begin(), loop.end());
        refuse_loop(loop);
      }
      path.emplace_back(needed, 0);
    }
  }
  return order;
}

}  // namespace rheonet
