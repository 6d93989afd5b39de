#include "core/solve/chatter_detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"

namespace rheonet {

ChatterDetection::ChatterDetection(std::size_t causes, double accuracy) : accuracy_(accuracy), count_(causes, 0), last_event_(causes, std::numeric_limits<double>::quiet_NaN()) {}

void ChatterDetection::reset() {
  begun_ = false;
  counts_ = 0;
  for (int cause : fired_) count_[static_cast<std::size_t>(cause)] = 0;
  fired_.clear();
}

bool ChatterDetection::Watched::changed(const std::vector<double>& now, double accuracy) {
  for (double x : now) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (std::abs(now[k] - before[k]) > accuracy * largest) return true;
  }
  return false;
}

bool ChatterDetection::lost(double t, const std::vector<int>& causes, const State& state, double largest_velocity) {
  velocity_.largest = std::max(velocity_.largest, largest_velocity);
  const bool moved = velocity_.changed(state.velocity, accuracy_);
  if (deflection_.changed(state.p, accuracy_) || moved) reset();
  if (!begun_) {
    begun_ = true;
    since_ = first_ = t;
    velocity_.before = state.velocity;
    deflection_.before = state.p;
  }
  bool often = false;
  for (int cause : causes) {
    int& count = count_[static_cast<std::size_t>(cause)];
    if (count++ == 0) fired_.push_back(cause);
    often = often || count >= numerics::chatter_events;
  }
  return often;
}

bool ChatterDetection::without_end(double t, double instant) {
  if (++counts_ >= numerics::endless_counts && t - first_ < instant) return true;
  for (int cause : fired_) count_[static_cast<std::size_t>(cause)] = 0;
  fired_.clear();
  since_ = t;
  return false;
}

std::vector<int> ChatterDetection::busiest() const {
  std::vector<int> result = fired_;
  std::stable_sort(result.begin(), result.end(), [&](int a, int b) {
    return count_[static_cast<std::size_t>(a)] > count_[static_cast<std::size_t>(b)];
  });
  return result;
}

std::string ChatterDetection::describe(const Network& network, double t) const {
  const auto& elements = network.scene->elements;
  std::vector<int> busy = busiest();
  std::erase_if(busy, [&](int cause) { return static_cast<std::size_t>(cause) >= elements.size(); });
  std::vector<std::string> names;
  for (int cause : busy) names.push_back(elements[static_cast<std::size_t>(cause)].name);
  const bool several = busy.size() > 1;
  const auto is_function = [&](const Blocks::Block& block) { return block.function && !busy.empty() && block.element == busy.front(); };
  if (!several && std::any_of(network.blocks.blocks.begin(), network.blocks.blocks.end(), is_function)) {
    return fmt::format("the function {} switches over and over without getting anywhere, {} times within {:.2g} s: what it switches on takes it back at "
                       "once; a `lag` before it or a continuous expression would end it, and dry friction is a `slider`",
                       format_list(names, numerics::chatter_names), numerics::chatter_events, t - since_);
  }
  return fmt::format(
      "element{} {} switch{} over and over without getting anywhere, {} times within {:.2g} s; a dashpot beside {}, a mass "
      "at {} ends or a looser accuracy would end it",
      several ? "s" : "", format_list(names, numerics::chatter_names), several ? "" : "es", numerics::chatter_events, t - since_, several ? "them" : "it",
      several ? "their" : "its");
}

bool ChatterDetection::endless(double t, const std::vector<int>& causes, double left, bool impacts) {
  for (const int cause : causes) {
    const double before = std::exchange(last_event_[static_cast<std::size_t>(cause)], t);
    if (!std::isnan(before)) pauses_.push_back({t - before, cause});
    if (pauses_.size() > numerics::chatter_events) pauses_.pop_front();
  }
  if (pauses_.size() < numerics::chatter_events) return false;
  const auto sum = [](auto from, auto to) { return std::accumulate(from, to, 0.0, [](double length, const Pause& pause) { return length + pause.length; }); };
  const auto middle = pauses_.begin() + numerics::chatter_events / 2;
  const double first = sum(pauses_.begin(), middle), second = sum(middle, pauses_.end());
  if (impacts && second <= numerics::chatter_events / 2 * time_roundoff(t + left)) {  // at one time: they may lose their speeds
    if (++counts_at_one_time_ >= numerics::endless_counts) return true;
    pauses_.clear();
    return false;
  }
  counts_at_one_time_ = 0;
  // Where motion ends in infinitely many events, as that of a bouncing ball, each comes sooner by the same share.
  if (second < first) return false;
  // They come later by the same share from here on.
  const double growth = first > 0 ? second / first : std::numeric_limits<double>::infinity(), more = left * (growth - 1) / second;
  const double halves = more > 0 ? std::log1p(more) / std::log(growth) : left / second;
  return halves / 2 > numerics::endless_counts / numerics::endless_time;
}

double ChatterDetection::endless_time() const {
  return std::accumulate(pauses_.begin(), pauses_.end(), 0.0, [](double length, const Pause& pause) { return length + pause.length; });
}

std::string ChatterDetection::describe_endless(const Network& network, bool squeezed) const {
  std::vector<std::string> names;
  for (const Pause& pause : pauses_) {
    const std::string& name = network.scene->elements[static_cast<std::size_t>(pause.cause)].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  const std::string who = format_list(names, numerics::chatter_names);
  const char* const s = names.size() > 1 ? "" : "s";
  if (squeezed) {
    return fmt::format("{} hit{} over and over, each {:.2g} s after the last time: what moves between rigid stops has no room left there; let the motion that "
                       "closes the gap end before, or give a stop a finite `stiffness`", who, s, pauses_.back().length);
  }
  return fmt::format("{} switch{} over and over without getting anywhere, each {:.2g} s after the last time; a dashpot beside {}, a mass at {} ends or a looser "
                     "accuracy would end it", who, names.size() > 1 ? "" : "es", pauses_.back().length, names.size() > 1 ? "them" : "it", names.size() > 1 ? "their" : "its");
}

bool ChatterDetection::failing(double t, double within) {
  failures_.push_back(t);
  if (failures_.size() > numerics::solver_failures) failures_.pop_front();
  return failures_.size() == numerics::solver_failures && t - failures_.front() < within;
}

bool ChatterDetection::stalled(double t, double grain) {
  if (std::abs(t - reached_) > numerics::standstill_time * grain) {
    reached_ = t;
    steps_there_ = 0;
  }
  return ++steps_there_ > numerics::standstill_steps;
}

}  // namespace rheonet
