#include "tools/plot/trace.hpp"

#include <algorithm>
#include <array>

namespace rheonet::plot {

void Trace::add(Point point) {
  if (points_.size() == capacity) compact();
  points_.push_back(point);
}

void Trace::compact() {
  // At most six points of twelve stay: half of the room is free again.
  constexpr std::size_t group = 12;
  std::size_t kept = 0;
  for (std::size_t begin = 0; begin < points_.size(); begin += group) {
    const std::size_t end = std::min(begin + group, points_.size());
    const auto by_x = [this](std::size_t a, std::size_t b) { return points_[a].x < points_[b].x; };
    const auto by_y = [this](std::size_t a, std::size_t b) { return points_[a].y < points_[b].y; };
    std::array<std::size_t, 6> stay{begin, begin, begin, begin, begin, end - 1};
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (by_x(i, stay[1])) stay[1] = i;
      if (by_x(stay[2], i)) stay[2] = i;
      if (by_y(i, stay[3])) stay[3] = i;
      if (by_y(stay[4], i)) stay[4] = i;
    }
    std::sort(stay.begin(), stay.end());
    const auto last = std::unique(stay.begin(), stay.end());
    for (auto i = stay.begin(); i != last; ++i) points_[kept++] = points_[*i];
  }
  points_.resize(kept);
}

}  // namespace rheonet::plot
