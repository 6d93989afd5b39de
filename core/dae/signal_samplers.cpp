#include "core/dae/signal_samplers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"

namespace rheonet {

SignalSamplers::SignalSamplers(const Network& network) : start_(network.scene->start) {
  const std::vector<Blocks::Block>& blocks = network.blocks.blocks;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const double period = blocks[k].law.period;
    of_.push_back(period > 0 ? static_cast<int>(samplers_.size()) : -1);
    if (period == 0) continue;
    double number = std::floor(start_ / period);
    if (beat(0, number + 1, period).t <= start_) ++number;  // the quotient was rounded
    samplers_.push_back({.block = static_cast<int>(k), .period = period, .number = number, .next = 0.0, .taken = {}});
  }
}

TimePoint SignalSamplers::enter(double t) {
  constexpr double never = std::numeric_limits<double>::infinity();
  TimePoint next = never;
  for (Sampler& sampler : samplers_) {
    if (t >= sampler.next.t) {
      sampler.taking = true;
      sampler.next = beat(-start_, ++sampler.number, sampler.period);
      if (sampler.next.t <= t) sampler.next = std::nextafter(t, never);
    }
    next = std::min(next, sampler.next);
  }
  return next;
}

std::vector<int> SignalSamplers::due(double t) const {
  std::vector<int> result;
  for (const Sampler& sampler : samplers_) {
    if (t >= sampler.next.t) result.push_back(sampler.block);
  }
  return result;
}

double SignalSamplers::value(int block, double t) const {
  const Sampler& of_block = sampler(block);
  const std::deque<Taken>& taken = of_block.taken;
  const auto later = std::upper_bound(taken.begin(), taken.end(), t, [](double x, const Taken& s) { return x < s.t; });
  return later == taken.begin() ? of_block.value : std::prev(later)->value;
}

void SignalSamplers::take(const Sample& sample) {
  for (Sampler& sampler : samplers_) {
    if (sampler.taking) sampler.value = sample(sampler.block);
  }
}

bool SignalSamplers::hold(std::size_t round, double now, double reach, const Sample& sample) {
  const auto jumps = [&](const Sampler& sampler) {
    if (!sampler.taking) return false;
    const double here = sample(sampler.block);
    return std::abs(here - sampler.value) > numerics::function_jump * std::max({std::abs(here), std::abs(sampler.value), sampler.largest});
  };
  if (round < samplers_.size() && std::any_of(samplers_.begin(), samplers_.end(), jumps)) return false;
  for (Sampler& sampler : samplers_) {
    if (!std::exchange(sampler.taking, false)) continue;
    while (sampler.taken.size() > 1 && sampler.taken[1].t < now - reach) sampler.taken.pop_front();
    sampler.taken.push_back({now, sampler.value});
    sampler.largest = std::max(sampler.largest, std::abs(sampler.value));
  }
  return true;
}

}  // namespace rheonet
