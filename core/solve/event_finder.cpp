#include "core/solve/event_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr int parts = numerics::arc_parts, finer = parts;
constexpr std::size_t places = parts * finer + 1;

/// Lagrange's polynomials for values at the ends of the parts: their values at places `1/finer` of a part apart.
constexpr std::array<std::array<double, parts + 1>, places> lagrange() {
  std::array<std::array<double, parts + 1>, places> result{};
  for (std::size_t p = 0; p < places; ++p) {
    for (int i = 0; i <= parts; ++i) {
      double product = 1;
      for (int j = 0; j <= parts; ++j) {
        if (j != i) product *= (static_cast<double>(p) / finer - j) / (i - j);
      }
      result[p][static_cast<std::size_t>(i)] = product;
    }
  }
  return result;
}

}  // namespace

EventFinder::EventFinder(const EventFunctions& functions, bool locate, Look look)
    : functions_(functions), locate_(locate), look_(std::move(look)), fired_(at(functions.count()), 0), left_(fired_.size(), 0), between_(left_), right_(left_), later_(left_), band_(left_) {}

void EventFinder::take(int which) {
  std::fill(fired_.begin(), fired_.end(), 0);
  fired_[at(which)] = 1;
}

std::optional<double> EventFinder::in_step(double begin, double end) {
  look_(end, right_);
  return fire(begin, end);
}

/// Between equal parts of the step a function is a polynomial of degree 4 as far as one can see; where that comes near 0, the function
/// itself is looked at, before the first event that the ends of the parts show.
std::optional<double> EventFinder::in_long_step(double begin, double end) {
  std::vector<Seen> seen{{begin, left_}};
  for (int k = 1; k <= parts; ++k) seen.push_back(look_at(k == parts ? end : begin + (end - begin) * k / parts));
  const std::optional<double> event = first_of(seen);
  const std::vector<double> dips = find_dips(seen, event.value_or(end));
  if (dips.empty()) return event;
  const std::vector<double> functions = left_;
  const std::vector<int> fired = fired_;
  std::erase_if(seen, [&](const Seen& one) { return one.time >= event.value_or(end); });
  for (const double t : dips) {
    const auto behind = std::lower_bound(seen.begin(), seen.end(), t, [](const Seen& one, double then) { return one.time < then; });
    if (behind == seen.end() || behind->time != t) seen.insert(behind, look_at(t));
  }
  if (const std::optional<double> earlier = first_of(seen)) return earlier;
  left_ = functions;
  fired_ = fired;
  return event;
}

/// The first event that these show.
std::optional<double> EventFinder::first_of(const std::vector<Seen>& seen) {
  for (std::size_t k = 1; k < seen.size(); ++k) {
    left_ = seen[k - 1].functions;
    right_ = seen[k].functions;
    if (const std::optional<double> event = fire(seen[k - 1].time, seen[k].time)) return event;
  }
  return {};
}

EventFinder::Seen EventFinder::look_at(double t) const {
  Seen there{t, std::vector<double>(fired_.size())};
  look_(t, there.functions);
  return there;
}

/// Times before `end` at which some function comes near 0.
std::vector<double> EventFinder::find_dips(const std::vector<Seen>& seen, double end) const {
  static constexpr auto shares = lagrange();
  const double begin = seen.front().time, apart = (seen.back().time - begin) / (parts * finer), reach = std::min(apart, (end - begin) / 2);
  std::vector<double> dips;
  for (std::size_t f = 0; f < fired_.size(); ++f) {
    std::array<double, parts + 1> g;
    for (std::size_t k = 0; k < g.size(); ++k) g[k] = seen[k].functions[f];
    const auto [least, most] = std::minmax_element(g.begin(), g.end());
    // A polynomial of degree 4 does not fall below five equally spaced values by more than their difference.
    if (!(*least > 0) || *least > (1 + numerics::arc_dip) * (*most - *least)) continue;
    double lowest = std::numeric_limits<double>::infinity();
    std::size_t place = 0;
    // A dip may be nearest to the first place behind the end.
    for (std::size_t p = 0; p < places && (p == 0 || begin + apart * static_cast<double>(p - 1) < end); ++p) {
      const double value = std::inner_product(g.begin(), g.end(), shares[p].begin(), 0.0);
      if (value < lowest) lowest = value, place = p;
    }
    if (lowest > numerics::arc_dip * (*most - *least)) continue;
    const std::optional<double> t = minimum_near(f, begin + apart * static_cast<double>(place), begin, end, reach);
    if (t) dips.push_back(*t);
  }
  return dips;
}

/// Where a function has a minimum near t, by parabolas through three of its values, or a time at which it is not positive. Absent if it
/// only rises from the beginning, or falls to the end.
std::optional<double> EventFinder::minimum_near(std::size_t function, double t, double begin, double end, double apart) const {
  const auto value = [&](double then) { return look_at(then).functions[function]; };
  bool minimum = false;
  for (int n = 0; n < numerics::missed_event_refinements; ++n, apart /= parts * finer) {
    t = std::clamp(t, begin + apart, end - apart);
    const double before = value(t - apart), here = value(t), after = value(t + apart), bend = before - 2 * here + after;
    minimum = here <= 0 || (before >= here && after >= here);
    if (here <= 0 || !(bend > 0)) break;
    t += std::clamp((before - after) / (2 * bend), -1.0, 1.0) * apart;
  }
  return minimum ? std::optional(t) : std::nullopt;
}

/// True if some function has fallen through 0 since `left_`.
bool EventFinder::falls(const std::vector<double>& now) const {
  for (std::size_t k = 0; k < left_.size(); ++k) {
    if (left_[k] > 0 && now[k] <= 0) return true;
  }
  return false;
}

/// With the functions at both times in `left_` and `right_`.
std::optional<double> EventFinder::fire(double begin, double end) {
  if (locate_ && falls(right_)) end = locate(begin, end);
  const auto has_fired = [&](double before, double now) { return now <= 0 && (before > 0 || !locate_) ? 1 : 0; };
  std::transform(left_.begin(), left_.end(), right_.begin(), fired_.begin(), has_fired);
  left_.swap(right_);
  return std::find(fired_.begin(), fired_.end(), 1) != fired_.end() ? std::optional(end) : std::nullopt;
}

/// Share of the interval, from its end, at which the first function has a zero by the rule of false position, with the values at the beginning multiplied
/// by `weight`.
double EventFinder::share_to_zero(double weight) const {
  double share = 0;
  for (std::size_t k = 0; k < left_.size(); ++k) {
    if (left_[k] > 0 && right_[k] <= 0) share = std::max(share, right_[k] / (right_[k] - weight * left_[k]));
  }
  return share;
}

/// The time before `end` at which the first function is 0 along its secant through `end` and a later time; `end` if no function falls there.
double EventFinder::before_end(double end, double later) const {
  double ahead = 0;
  for (std::size_t k = 0; k < left_.size(); ++k) {
    if (left_[k] > 0 && right_[k] <= 0 && later_[k] < right_[k]) ahead = std::max(ahead, right_[k] / (later_[k] - right_[k]));
  }
  return end - ahead * (later - end);
}

/// Finds the time just behind the first event, by the Illinois variant of the rule of false position (Dowell and Jarratt, BIT 11 (1971)
/// 168), applied to the function that falls first. Near a simple zero the same end moves twice in a row at most. If it moves more often, a function hardly
/// changes before it falls, as where sliders share a load: all but one stay at their bounds until the last one is overloaded. From then on
/// secants through points behind the event are tried. A round that does not halve the interval is followed by one that does.
double EventFinder::locate(double begin, double end) {
  const double near = numerics::event_time_ulps * std::numeric_limits<double>::epsilon() * (std::abs(end) + (end - begin));
  for (std::size_t k = 0; k < left_.size(); ++k) {
    const double b = left_[k] > 0 && right_[k] <= 0 ? functions_.band(static_cast<int>(k)) : 0;
    band_[k] = left_[k] > b ? b : 0;
  }
  const auto take_bands = [&](std::vector<double>& functions) {
    for (std::size_t k = 0; k < functions.size(); ++k) functions[k] -= band_[k];
  };
  take_bands(left_);
  take_bands(right_);
  double weight = 1;   // of the functions at the beginning
  int in_a_row = 0;    // moves of the same end; below 0 for the beginning
  double later = end;  // the end before it moved last, with the functions in `later_`
  bool by_secants = false, halve = true;
  while (end - begin > near) {
    const double length = end - begin, middle = begin + length / 2;
    double guess = by_secants ? middle : end - share_to_zero(weight) * length;
    if (by_secants && !halve && later > end) guess = before_end(end, later);
    // The last secant led to the beginning, so the zero is near it, but how near is unknown: half way, in the logarithm, to the least distance.
    if (!(guess > begin)) guess = begin + std::sqrt(near * length);
    const double t = std::clamp(guess, begin + near / 2, end - near / 2);
    look_(t, between_);
    take_bands(between_);
    const int move = falls(between_) ? 1 : -1;
    in_a_row = move * in_a_row > 0 ? in_a_row + move : move;
    weight = std::abs(in_a_row) == 1 ? 1 : move > 0 ? weight / 2 : 2 * weight;
    if (move > 0) {
      later = std::exchange(end, t);
      later_.swap(right_);
      right_.swap(between_);
    } else {
      begin = t;
      left_.swap(between_);
    }
    by_secants = by_secants || std::abs(in_a_row) > 2;
    halve = 2 * (end - begin) > length;
  }
  return end;
}

}  // namespace rheonet
