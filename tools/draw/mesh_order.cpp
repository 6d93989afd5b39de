#include "tools/draw/mesh_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rheonet::draw {
namespace {

/// Links from a station to each of the others, by breadth first.
std::vector<double> distances(const Mesh& mesh, int from) {
  std::vector<double> distance(mesh.stations.size(), std::numeric_limits<double>::infinity());
  std::vector<int> reached{from};
  distance[static_cast<std::size_t>(from)] = 0;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const Mesh::Link& link : mesh.links) {
      const int to = link.left == reached[i] ? link.right : link.right == reached[i] ? link.left : -1;
      if (to < 0 || std::isfinite(distance[static_cast<std::size_t>(to)])) continue;
      distance[static_cast<std::size_t>(to)] = distance[static_cast<std::size_t>(reached[i])] + 1;
      reached.push_back(to);
    }
  return distance;
}

int length_of(const Mesh& mesh, const std::vector<int>& position) {
  int sum = 0;
  for (const Mesh::Link& link : mesh.links)
    if (link.right >= 0)
      sum += std::abs(position[static_cast<std::size_t>(link.left)] - position[static_cast<std::size_t>(link.right)]);
  return sum;
}

/// Exchanges neighbours as long as that makes the ways shorter. The first `from` and the last `behind` stay.
void shorten(const Mesh& mesh, std::vector<int>& order, std::size_t from, std::size_t behind) {
  std::vector<int> position(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  constexpr int most_rounds = 50;
  int length = length_of(mesh, position);
  for (int round = 0; round < most_rounds; ++round) {
    bool shorter = false;
    for (std::size_t i = from; i + 1 + behind < order.size(); ++i) {
      int &a = position[static_cast<std::size_t>(order[i])], &b = position[static_cast<std::size_t>(order[i + 1])];
      std::swap(a, b);
      const int other = length_of(mesh, position);
      if (other < length) {
        std::swap(order[i], order[i + 1]);
        length = other;
        shorter = true;
      } else {
        std::swap(a, b);
      }
    }
    if (!shorter) return;
  }
}

/// Where a link ends in units of columns: one that leads nowhere else ends before the next.
double end_of(const Mesh::Link& link) { return link.right < 0 ? link.left + 0.9 : link.right; }

bool overlap(const Mesh::Link& a, const Mesh::Link& b) { return a.left < end_of(b) && b.left < end_of(a); }

/// Gives links their rows, and betters that.
class RowSearch {
 public:
  explicit RowSearch(const Mesh& mesh) : mesh_(mesh), rows_(mesh.links.size(), -1) {
    std::vector<std::size_t> order(mesh.links.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return end_of(mesh.links[a]) - mesh.links[a].left < end_of(mesh.links[b]) - mesh.links[b].left;
    });
    for (const std::size_t link : order) {
      while (!free(link, ++rows_[link], link)) {
      }
    }
  }

  std::vector<int> better() {
    double cost = cost_of();
    // Enough for the best order of a dozen links; what it is for hundreds nobody would see.
    double work = 3e7;
    const double each = static_cast<double>(mesh_.links.size() * mesh_.stations.size());
    for (bool better = true; better && work > 0;) {
      better = false;
      const int most = *std::max_element(rows_.begin(), rows_.end()) + 1;
      for (std::size_t a = 0; a < rows_.size() && work > 0; ++a) {
        for (int row = -1; row <= most; ++row, work -= each) better = try_row(a, row, cost) || better;
        for (std::size_t b = 0; b < a; ++b, work -= each) better = try_exchange(a, b, cost) || better;
      }
    }
    std::vector<int> used = rows_;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (int& row : rows_) row = static_cast<int>(std::lower_bound(used.begin(), used.end(), row) - used.begin());
    return rows_;
  }

 private:
  /// Whether no link overlaps `link` in `row`; `other` does not count.
  bool free(std::size_t link, int row, std::size_t other) const {
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (k != link && k != other && rows_[k] == row && overlap(mesh_.links[link], mesh_.links[k])) return false;
    return true;
  }

  double cost_of() const {
    const std::vector<BarSpan> bars = bars_of(mesh_, rows_);
    double cost = 0;
    for (const BarSpan& bar : bars) cost += bar.bottom - bar.top;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      for (int station = mesh_.links[k].left + 1; station < mesh_.links[k].right; ++station)
        if (crosses(mesh_.links[k], rows_[k], station, bars)) cost += 100;
    const auto [top, bottom] = std::minmax_element(rows_.begin(), rows_.end());
    return cost + 0.5 * (*bottom - *top);
  }

  bool keep_if_better(double& cost, const std::vector<int>& before) {
    const double now = cost_of();
    if (now < cost - 1e-9) {
      cost = now;
      return true;
    }
    rows_ = before;
    return false;
  }
  bool try_row(std::size_t link, int row, double& cost) {
    if (row == rows_[link] || !free(link, row, link)) return false;
    const std::vector<int> before = rows_;
    rows_[link] = row;
    return keep_if_better(cost, before);
  }
  bool try_exchange(std::size_t a, std::size_t b, double& cost) {
    if (rows_[a] == rows_[b] || !free(a, rows_[b], b) || !free(b, rows_[a], a)) return false;
    const std::vector<int> before = rows_;
    std::swap(rows_[a], rows_[b]);
    return keep_if_better(cost, before);
  }

  const Mesh& mesh_;
  std::vector<int> rows_;
};

}  // namespace

void put_in_order(Mesh& mesh, int start, bool grounded) {
  const std::size_t count = mesh.stations.size();
  const std::vector<double> from_start = distances(mesh, start);
  std::vector<double> way(count);
  if (grounded) {
    const std::vector<double> to_ground = distances(mesh, static_cast<int>(count) - 1);
    for (std::size_t i = 0; i < count; ++i) way[i] = from_start[i] / (from_start[i] + to_ground[i]);
  } else {
    way = from_start;
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return way[static_cast<std::size_t>(a)] < way[static_cast<std::size_t>(b)]; });
  shorten(mesh, order, 1, grounded ? 1 : 0);

  std::vector<Station> stations;
  std::vector<int> position(count);
  for (std::size_t i = 0; i < count; ++i) {
    position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    stations.push_back(std::move(mesh.stations[static_cast<std::size_t>(order[i])]));
  }
  mesh.stations = std::move(stations);
  for (Mesh::Link& link : mesh.links) {
    link.left = position[static_cast<std::size_t>(link.left)];
    if (link.right < 0) continue;
    link.right = position[static_cast<std::size_t>(link.right)];
    if (link.left < link.right) continue;
    std::swap(link.left, link.right);
    link.block.reverse();
  }
}

std::vector<int> rows_of(const Mesh& mesh) { return RowSearch(mesh).better(); }

std::vector<BarSpan> bars_of(const Mesh& mesh, const std::vector<int>& rows) {
  std::vector<BarSpan> bars(mesh.stations.size(), {std::numeric_limits<int>::max(), std::numeric_limits<int>::min()});
  for (std::size_t k = 0; k < mesh.links.size(); ++k)
    for (const int station : {mesh.links[k].left, mesh.links[k].right}) {
      if (station < 0) continue;
      BarSpan& bar = bars[static_cast<std::size_t>(station)];
      bar.top = std::min(bar.top, rows[k]);
      bar.bottom = std::max(bar.bottom, rows[k]);
    }
  return bars;
}

bool crosses(const Mesh::Link& link, int row, int station, const std::vector<BarSpan>& bars) {
  const BarSpan& bar = bars[static_cast<std::size_t>(station)];
  return link.left < station && station < link.right && bar.top < row && row < bar.bottom;
}

}  // namespace rheonet::draw
