#include "core/solve/headway.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

Headway::Headway(std::size_t causes, double accuracy) : accuracy_(accuracy), count_(causes, 0) {}

void Headway::reset() {
  begun_ = false;
  for (int cause : fired_) count_[static_cast<std::size_t>(cause)] = 0;
  fired_.clear();
}

bool Headway::Watched::changed(const std::vector<double>& now, double accuracy) {
  for (double x : now) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (std::abs(now[k] - before[k]) > accuracy * largest) return true;
  }
  return false;
}

bool Headway::lost(double t, const std::vector<int>& causes, const State& state) {
  const bool moved = velocity_.changed(state.velocity, accuracy_);
  if (deflection_.changed(state.p, accuracy_) || moved) reset();
  if (!begun_) {
    begun_ = true;
    since_ = t;
    velocity_.before = state.velocity;
    deflection_.before = state.p;
  }
  bool often = false;
  for (int cause : causes) {
    int& count = count_[static_cast<std::size_t>(cause)];
    if (count++ == 0) fired_.push_back(cause);
    often = often || count >= enough;
  }
  return often;
}

std::vector<int> Headway::busiest() const {
  std::vector<int> result = fired_;
  std::stable_sort(result.begin(), result.end(), [&](int a, int b) {
    return count_[static_cast<std::size_t>(a)] > count_[static_cast<std::size_t>(b)];
  });
  return result;
}

}  // namespace rheonet
