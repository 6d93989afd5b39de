#include "tools/draw/layers.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace rheonet::draw {
namespace {

constexpr double apart = 10;  // px between items of a layer

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The pieces of lines from layer to layer.
struct Step {
  int from, to;
  double in;  ///< from the axis of `to`
};

std::vector<Step> steps_of(const Layers& graph) {
  std::vector<Step> steps;
  for (const Layers::Line& line : graph.lines) {
    if (line.back) continue;
    int from = line.from;
    for (const int item : line.through) {
      steps.push_back({from, item, 0});
      from = item;
    }
    steps.push_back({from, line.to, line.in});
  }
  return steps;
}

}  // namespace

void Layers::arrange() {
  find_loops();
  find_layers();
  split_long_lines();
  layers.clear();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (layers.size() <= at(items[i].layer)) layers.resize(at(items[i].layer) + 1);
    layers[at(items[i].layer)].push_back(static_cast<int>(i));
  }
  order();
  find_heights();
  straighten(true);
  level_long_lines();
  straighten(false);
}

// By depth first from what nothing comes into: a line to an item whose own lines are being followed closes a loop.
void Layers::find_loops() {
  enum class State { unseen, open, done };
  std::vector<State> states(items.size(), State::unseen);
  std::vector<std::vector<int>> out(items.size());
  std::vector<int> ins(items.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    out[at(lines[k].from)].push_back(static_cast<int>(k));
    ++ins[at(lines[k].to)];
  }
  const auto follow = [&](int start) {
    std::vector<std::pair<int, std::size_t>> path{{start, 0}};
    states[at(start)] = State::open;
    while (!path.empty()) {
      auto& [item, next] = path.back();
      if (next == out[at(item)].size()) {
        states[at(item)] = State::done;
        path.pop_back();
        continue;
      }
      Line& line = lines[at(out[at(item)][next++])];
      if (states[at(line.to)] == State::open) line.back = true;
      if (states[at(line.to)] != State::unseen) continue;
      states[at(line.to)] = State::open;
      path.emplace_back(line.to, 0);
    }
  };
  for (const bool sources : {true, false})
    for (std::size_t i = 0; i < items.size(); ++i)
      if (states[i] == State::unseen && (!sources || ins[i] == 0)) follow(static_cast<int>(i));
}

void Layers::find_layers() {
  // Each item as far to the left as its inputs allow. Without loops this takes at most as many rounds as there are items.
  for (bool changed = true; changed;) {
    changed = false;
    for (const Line& line : lines) {
      if (line.back || items[at(line.to)].layer > items[at(line.from)].layer) continue;
      items[at(line.to)].layer = items[at(line.from)].layer + 1;
      changed = true;
    }
  }
  // An item without inputs stands just before the first item that it leads to.
  for (std::size_t i = 0; i < items.size(); ++i) {
    int next = std::numeric_limits<int>::max();
    bool source = true;
    for (const Line& line : lines) {
      if (line.to == static_cast<int>(i)) source = false;
      if (line.from == static_cast<int>(i) && !line.back) next = std::min(next, items[at(line.to)].layer);
    }
    if (source && next < std::numeric_limits<int>::max()) items[i].layer = next - 1;
  }
}

void Layers::split_long_lines() {
  constexpr double half = 4;
  for (Line& line : lines) {
    if (line.back) continue;
    for (int layer = items[at(line.from)].layer + 1; layer < items[at(line.to)].layer; ++layer) {
      line.through.push_back(static_cast<int>(items.size()));
      items.push_back({half, half, layer, 0});
    }
  }
}

// Orders each layer by the mean place of the items before it, then by that of the items behind it, and again.
void Layers::order() {
  const std::vector<Step> steps = steps_of(*this);
  std::vector<double> place(items.size());
  const auto number = [&](const std::vector<int>& layer) {
    for (std::size_t k = 0; k < layer.size(); ++k) place[at(layer[k])] = static_cast<double>(k);
  };
  for (const auto& layer : layers) number(layer);
  constexpr int rounds = 12;
  for (int round = 0; round < rounds; ++round) {
    const bool forward = round % 2 == 0;
    std::vector<double> sum(items.size()), count(items.size());
    for (std::size_t k = 0; k < layers.size(); ++k) {
      std::vector<int>& layer = layers[forward ? k : layers.size() - 1 - k];
      for (const Step& step : steps) {
        const int here = forward ? step.to : step.from, there = forward ? step.from : step.to;
        if (items[at(here)].layer != items[at(layer.front())].layer) continue;
        sum[at(here)] += place[at(there)] + (forward ? step.in : 0) * 1e-4;
        count[at(here)] += 1;
      }
      const auto wish = [&](int i) { return count[at(i)] > 0 ? sum[at(i)] / count[at(i)] : place[at(i)]; };
      std::stable_sort(layer.begin(), layer.end(), [&](int a, int b) { return wish(a) < wish(b); });
      number(layer);
    }
  }
}

// Each item where its neighbours on one side want it, as far as the order lets it; from both sides in turns.
void Layers::find_heights() {
  const std::vector<Step> steps = steps_of(*this);
  const auto distance = [this](int above, int below) { return items[at(above)].down + apart + items[at(below)].up; };
  for (const auto& layer : layers)
    for (std::size_t k = 1; k < layer.size(); ++k)
      items[at(layer[k])].y = items[at(layer[k - 1])].y + distance(layer[k - 1], layer[k]);
  constexpr int rounds = 9;
  for (int round = 0; round < rounds; ++round) {
    const bool forward = round % 2 == 0;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      std::vector<int>& layer = layers[forward ? k : layers.size() - 1 - k];
      std::vector<double> sum(items.size()), count(items.size());
      for (const Step& step : steps) {
        const int here = forward ? step.to : step.from;
        sum[at(here)] += forward ? items[at(step.from)].y - step.in : items[at(step.to)].y + step.in;
        count[at(here)] += 1;
      }
      for (const int i : layer)
        if (count[at(i)] > 0) items[at(i)].y = sum[at(i)] / count[at(i)];
      // Items that have come too close move apart, each by half of the overlap.
      std::vector<double> down(layer.size()), up(layer.size());
      for (std::size_t j = 0; j < layer.size(); ++j) {
        down[j] = items[at(layer[j])].y;
        if (j > 0) down[j] = std::max(down[j], down[j - 1] + distance(layer[j - 1], layer[j]));
      }
      for (std::size_t j = layer.size(); j-- > 0;) {
        up[j] = items[at(layer[j])].y;
        if (j + 1 < layer.size()) up[j] = std::min(up[j], up[j + 1] - distance(layer[j], layer[j + 1]));
      }
      for (std::size_t j = 0; j < layer.size(); ++j) items[at(layer[j])].y = (down[j] + up[j]) / 2;
    }
  }
}

std::pair<double, double> Layers::room(int item) const {
  const std::vector<int>& layer = layers[at(items[at(item)].layer)];
  const auto here = std::find(layer.begin(), layer.end(), item);
  double low = std::numeric_limits<double>::lowest(), high = std::numeric_limits<double>::max();
  if (here != layer.begin()) low = items[at(here[-1])].y + items[at(here[-1])].down + apart + items[at(item)].up;
  if (here + 1 != layer.end()) high = items[at(here[1])].y - items[at(here[1])].up - apart - items[at(item)].down;
  return {low, high};
}

// An item with a single incoming line goes to the height of that line, where there is room.
void Layers::straighten(bool passing_too) {
  const std::vector<Step> steps = steps_of(*this);
  std::vector<int> ins(items.size());
  if (!passing_too)
    for (const Line& line : lines)
      for (const int item : line.through) ++ins[at(item)];
  for (const Step& step : steps) ++ins[at(step.to)];
  for (std::size_t layer = 0; layer < layers.size(); ++layer)
    for (const Step& step : steps) {
      if (at(items[at(step.to)].layer) != layer || ins[at(step.to)] != 1) continue;
      const double wish = items[at(step.from)].y - step.in;
      const auto [low, high] = room(step.to);
      if (low <= wish && wish <= high) items[at(step.to)].y = wish;
    }
}

// A line through several layers goes through all of them at one height, if there is one: near its end.
void Layers::level_long_lines() {
  for (const Line& line : lines) {
    double low = std::numeric_limits<double>::lowest(), high = std::numeric_limits<double>::max();
    for (const int item : line.through) {
      const auto [above, below] = room(item);
      low = std::max(low, above);
      high = std::min(high, below);
    }
    if (low > high) continue;
    for (const int item : line.through) items[at(item)].y = std::clamp(items[at(line.to)].y + line.in, low, high);
  }
}

}  // namespace rheonet::draw
