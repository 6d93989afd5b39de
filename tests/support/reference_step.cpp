#include "tests/support/reference_step.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rheonet::test {

namespace {

// The series spring of a steep law is this much stiffer than all around it: few corrections of its preload are needed. If
// its rounding is then too much, less has to do.
constexpr double stiffer[] = {1e3, 10};
constexpr int corrections = 200, stiffen_after = 8;
constexpr int newton_steps = 200;
// Losses follow the force that a transmission passes on, to this fraction of the largest force.
constexpr double followed = 1e-9;
// A node counts as resting up to this part of the largest velocity that its forces could have given it.
constexpr double left_of_rest = 1e-13;
constexpr int rounds_of_slips = 20, rounds_of_losses = 100;
// A balance is found to this part of the forces that meet there: some rounding errors.
constexpr double balanced = 3e-14;
// Fraction of the round-off of a series spring that remains after the corrections.
constexpr double corrected = 1e-2;
// The stretch of a series spring that is left, against a force of the network in the spring.
constexpr double unstretched = 1e-8;

/// Solves a symmetric positive definite system in place; `a` is overwritten by its Cholesky factor.
void solve(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    double d = a[j * n + j];
    for (std::size_t k = 0; k < j; ++k) d -= a[j * n + k] * a[j * n + k];
    // A direction without stiffness: as if there were very little.
    d = std::max(d, 1e-15 * a[j * n + j]);
    a[j * n + j] = std::sqrt(d);
    for (std::size_t i = j + 1; i < n; ++i) {
      double s = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) s -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = s / a[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

}  // namespace

ReferenceNetwork::ReferenceNetwork(std::vector<Node> nodes, std::vector<ReferenceBundle> bundles, std::vector<Gear> gears)
    : nodes_(std::move(nodes)), bundles_(std::move(bundles)), gears_(std::move(gears)) {
  for (const Node& node : nodes_) total_mass_ += node.mass;
  unknown_.assign(nodes_.size(), -1);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].prescribed) continue;
    unknown_[n] = static_cast<int>(node_of_.size());
    node_of_.push_back(static_cast<NodeId>(n));
  }
  for (const ReferenceBundle& b : bundles_) {
    for (const ReferenceBundle::Member& m : b.members()) rounding_ += 1e-15 * m.law.coulomb();
  }
  x_.assign(nodes_.size(), 0);
  nodal_ = x_;
  points_.resize(bundles_.size());
  preload_.assign(bundles_.size(), 0);
  K_ = preload_;
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    for (const ReferenceBundle::Member& m : bundles_[k].members()) preload_[k] += m.sign * m.law.force();
  }
  gradient_.assign(node_of_.size(), 0);
  size_ = gradient_;
  matrix_.assign(node_of_.size() * node_of_.size(), 0);
}

/// Fills points_, gradient_, size_ and unbalance_ at x_.
void ReferenceNetwork::evaluate(const Input& input) {
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  std::fill(size_.begin(), size_.end(), 0.0);
  largest_force_ = largest_step_ = blur_ = 0;
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    const ReferenceBundle& b = bundles_[k];
    const int i = unknown_[at(b.a)], j = unknown_[at(b.b)];
    if (i < 0 && j < 0) continue;
    const double total = x_[at(b.a)] - x_[at(b.b)];
    points_[k] = K_[k] > 0 ? b.with_spring(total, K_[k], preload_[k], input.h) : b.at(total, input.h);
    const double f = points_[k].force;
    largest_step_ = std::max(largest_step_, std::abs(total));
    // The rounding of the positions of both ends shows in the force.
    const double magnitude = std::abs(f) + std::abs(points_[k].slope) * (std::abs(x_[at(b.a)]) + std::abs(x_[at(b.b)]));
    largest_force_ = std::max(largest_force_, std::abs(f));
    blur_ = std::max(blur_, (K_[k] > 0 ? corrected : 1) * balanced * magnitude);
    if (i >= 0) gradient_[at(i)] += f, size_[at(i)] += magnitude;
    if (j >= 0) gradient_[at(j)] -= f, size_[at(j)] += magnitude;
  }
  for (Gear& gear : gears_) {
    double sum = 0, magnitude = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      sum += gear.factor[e] * x_[at(gear.node[e])];
      magnitude += std::abs(gear.factor[e] * x_[at(gear.node[e])]);
    }
    gear.found = gear.force + gear.K * sum;
    largest_force_ = std::max(largest_force_, std::abs(gear.found));
    magnitude = std::abs(gear.found) + gear.K * magnitude;
    blur_ = std::max(blur_, corrected * balanced * magnitude);
    for (std::size_t e = 0; e < 3; ++e) {
      const int i = unknown_[at(gear.node[e])];
      if (i >= 0) gradient_[at(i)] += gear.factor[e] * gear.found, size_[at(i)] += std::abs(gear.factor[e]) * magnitude;
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < node_of_.size(); ++i) {
    const Node& node = nodes_[at(node_of_[i])];
    const double F = input.applied[at(node_of_[i])], x = x_[at(node_of_[i])];
    const double inertia = node.mass * (x / input.h - node.velocity) / span(input);
    gradient_[i] += inertia - F;
    size_[i] += std::abs(F) + node.mass * (std::abs(x / input.h) + std::abs(node.velocity)) / span(input);
    worst = std::max(worst, std::abs(gradient_[i]) / tolerance(size_[i]));
  }
  unbalance_ = worst;
  if (largest_force_ > 0) blur_ /= largest_force_;
}

/// Imbalance that round-off may cause where the magnitudes of the forces sum to `size`.
double ReferenceNetwork::tolerance(double size) const { return balanced * (size + 1e-2 * largest_force_) + rounding_; }

double ReferenceNetwork::slope_along(const Input& input, const std::vector<double>& direction) {
  evaluate(input);
  const double slope = std::inner_product(gradient_.begin(), gradient_.end(), direction.begin(), 0.0);
  return std::isfinite(slope) ? slope : HUGE_VAL;  // beyond all numbers it is uphill
}

/// Goes along `direction` from the point last evaluated to where the slope of the convex function has all but vanished,
/// and evaluates there. False if it never does.
bool ReferenceNetwork::search(const Input& input, const std::vector<double>& direction) {
  const std::vector<double> from = x_;
  const auto go = [&](double t) {
    for (std::size_t i = 0; i < node_of_.size(); ++i) x_[at(node_of_[i])] = from[at(node_of_[i])] + t * direction[i];
    return slope_along(input, direction);
  };
  // Whether the round-off of the forces hides a slope along the search direction.
  const auto blurred = [&](double slope) {
    double noise = 0;
    for (std::size_t i = 0; i < node_of_.size(); ++i) noise += 1e-15 * size_[i] * std::abs(direction[i]);
    return !(noise <= 0.1 * slope);
  };
  const double first = std::inner_product(gradient_.begin(), gradient_.end(), direction.begin(), 0.0);
  if (first >= 0) return true;  // rounding: no way down any more
  double low = 0, high = 1, at_low = first, at_high = go(1);
  while (at_high == HUGE_VAL && high > 1e-300) at_high = go(high *= 1e-4);
  const bool close = blurred(-first);
  while (close && high > 1e-60 && blurred(-first)) at_high = go(high /= 16);
  while (at_high < 0.5 * first) {
    low = high, at_low = at_high;
    if (close || (high *= 4) > 1e30) return false;
    at_high = go(high);
  }
  // The function is convex: beyond its lowest point only these bounds on it tell that it is lower there than at the start,
  // and without that two points may lead to each other for ever.
  const auto lower = [&](double t, double slope) { return slope <= 0 || at_low * low + slope * (t - low) < 0; };
  for (int iteration = 0; iteration < 100 && !(at_high <= -0.5 * first && lower(high, at_high)); ++iteration) {
    // Regula falsi, kept off the ends.
    const double share = std::clamp(at_low / (at_low - at_high), 0.05, 0.95), middle = low + share * (high - low);
    const double value = go(middle);
    if (std::abs(value) <= -0.5 * first && lower(middle, value)) return true;
    if (high - low <= 1e-15 * high) return true;
    (value < 0 ? low : high) = middle;
    (value < 0 ? at_low : at_high) = value;
  }
  return true;
}

bool ReferenceNetwork::newton(const Input& input) {
  const std::size_t n = node_of_.size();
  evaluate(input);
  double worst = unbalance_, before = INFINITY;
  int stalled = 0;
  for (int iteration = 0; iteration < newton_steps && worst > 1; ++iteration) {
    std::fill(matrix_.begin(), matrix_.end(), 0.0);
    for (std::size_t k = 0; k < bundles_.size(); ++k) {
      const int i = unknown_[at(bundles_[k].a)], j = unknown_[at(bundles_[k].b)];
      const double slope = points_[k].slope;
      if (i >= 0) matrix_[at(i) * n + at(i)] += slope;
      if (j >= 0) matrix_[at(j) * n + at(j)] += slope;
      if (i >= 0 && j >= 0) matrix_[at(i) * n + at(j)] -= slope, matrix_[at(j) * n + at(i)] -= slope;
    }
    for (const Gear& gear : gears_) {
      for (std::size_t e = 0; e < 3; ++e) {
        for (std::size_t o = 0; o < 3; ++o) {
          const int i = unknown_[at(gear.node[e])], j = unknown_[at(gear.node[o])];
          if (i >= 0 && j >= 0) matrix_[at(i) * n + at(j)] += gear.K * gear.factor[e] * gear.factor[o];
        }
      }
    }
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      matrix_[i * n + i] += nodes_[at(node_of_[i])].mass / (input.h * span(input));
      largest = std::max(largest, matrix_[i * n + i]);
    }
    for (std::size_t i = 0; i < n; ++i) matrix_[i * n + i] += 1e-14 * matrix_[i * n + i] + 1e-30 * largest + 1e-200;
    std::vector<double> direction(n);
    for (std::size_t i = 0; i < n; ++i) direction[i] = -gradient_[i];
    solve(matrix_, direction);
    // A full step that does well needs no search, which sees nothing of a node that moves too little: its share of the
    // slope is lost in the rounding of the others'.
    const std::vector<double> from = x_, slope = gradient_, size = size_;
    for (std::size_t i = 0; i < n; ++i) x_[at(node_of_[i])] += direction[i];
    evaluate(input);
    // By the measure that held before: far away any force is small beside the rounding there.
    double left = 0, uphill = 0;
    for (std::size_t i = 0; i < n; ++i) {
      uphill += (gradient_[i] + 0.5 * slope[i]) * direction[i] - tolerance(size[i]) * std::abs(direction[i]);
      left = std::isfinite(gradient_[i]) ? std::max(left, std::abs(gradient_[i]) / tolerance(size[i])) : HUGE_VAL;
      if (left == HUGE_VAL) break;
    }
    if (!(left <= 0.5 * worst && uphill <= 0)) {
      x_ = from;
      gradient_ = slope;
      if (!search(input, direction)) return worst <= 1e4;  // no way down is left but in rounding
    }
    worst = unbalance_;
    // Rounding sets a floor that the estimate of it may miss by a little.
    stalled = worst < 0.5 * before ? 0 : stalled + 1;
    before = std::min(before, worst);
    if (stalled > 3 && worst < 1e4) return true;
  }
  return worst <= 1e4;
}

/// The stiffness of the network around a bundle, which the bundle works against.
double ReferenceNetwork::around(std::size_t bundle, double h) const {
  double compliance = 0, largest = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    double stiffness = nodes_[n].mass / (h * h);
    for (std::size_t k = 0; k < bundles_.size(); ++k) {
      if (k != bundle && (at(bundles_[k].a) == n || at(bundles_[k].b) == n)) stiffness += bundles_[k].typical_slope(h);
    }
    largest = std::max(largest, stiffness);
    const bool end = at(bundles_[bundle].a) == n || at(bundles_[bundle].b) == n;
    if (end && unknown_[n] >= 0 && stiffness > 0) compliance += 1 / stiffness;
  }
  // If there are only sliders around it, the network beyond the sliders.
  const double stiffness = compliance > 0 ? 1 / compliance : largest;
  return stiffness > 0 ? stiffness : 1;
}

/// The same for a gear.
double ReferenceNetwork::around(const Gear& gear, double h) const {
  double compliance = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    const NodeId node = gear.node[e];
    if (unknown_[at(node)] < 0) continue;
    double stiffness = nodes_[at(node)].mass / (h * h);
    for (const ReferenceBundle& b : bundles_) {
      if (b.a == node || b.b == node) stiffness += b.typical_slope(h);
    }
    if (stiffness > 0) compliance += gear.factor[e] * gear.factor[e] / stiffness;
  }
  return compliance > 0 ? 1 / compliance : 1;
}

/// Where a law is steep, or a gear holds, the minimum is sought with a stiff spring in series. The spring is then given the force found as
/// its preload, so that it need not stretch for it, and so on until it is not stretched (method of multipliers).
bool ReferenceNetwork::minimise(const Input& input) {
  const std::vector<double> from = x_;
  for (const double factor : stiffer) {
    if (minimise(input, factor)) return true;
    x_ = from;
  }
  return false;
}

bool ReferenceNetwork::minimise(const Input& input, double factor) {
  bool any = false;
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    const bool free = unknown_[at(bundles_[k].a)] >= 0 || unknown_[at(bundles_[k].b)] >= 0;
    K_[k] = free && bundles_[k].steep() ? factor * around(k, input.h) : 0;
    any = any || K_[k] > 0;
  }
  for (Gear& gear : gears_) gear.K = factor * around(gear, input.h);
  for (int correction = 0; correction < corrections; ++correction) {
    if (!newton(input)) return false;
    typical_step_ = std::max(typical_step_, largest_step_);
    bool settled = true;
    for (std::size_t k = 0; k < bundles_.size(); ++k) {
      if (K_[k] == 0) continue;
      const double stretching = K_[k] * (std::abs(x_[at(bundles_[k].a)]) + std::abs(x_[at(bundles_[k].b)]));
      const double change = std::abs(points_[k].force - preload_[k]);
      if (change > 10 * rounding_ + 10 * balanced * stretching &&
          (change > unstretched * largest_force_ || change > little_stretch * K_[k] * typical_step_)) {
        settled = false;
      }
      preload_[k] = points_[k].force;
    }
    for (Gear& gear : gears_) {
      double stretching = 0;
      for (std::size_t e = 0; e < 3; ++e) stretching += gear.K * std::abs(gear.factor[e] * x_[at(gear.node[e])]);
      const double change = std::abs(gear.found - gear.force);
      if (change > 10 * rounding_ + 10 * balanced * stretching &&
          (change > unstretched * largest_force_ || change > little_stretch * gear.K * typical_step_)) {
        settled = false;
      }
      gear.force = gear.found;
    }
    if (settled) return true;
    // Where there is little motion, or nothing but friction around, it was not stiff enough.
    if (correction % stiffen_after == stiffen_after - 1) {
      for (double& K : K_) K *= 10;
      for (Gear& gear : gears_) gear.K *= 10;
    }
  }
  return false;
}

bool ReferenceNetwork::losses() const {
  return std::any_of(gears_.begin(), gears_.end(), [](const Gear& gear) { return gear.friction.has_value(); });
}

/// Makes the friction of each lossy gear fit the force just found; true if that changed any.
bool ReferenceNetwork::follow_losses() {
  bool changed = false;
  for (const Gear& gear : gears_) {
    if (!gear.friction) continue;
    ReferenceLaw& law = bundles_[gear.friction->bundle].law(gear.friction->member);
    const auto [low, high] = gear.equation.friction(gear.force);
    if (std::max(std::abs(low - law.range().low), std::abs(high - law.range().high)) <= followed * largest_force_) continue;
    law.set_range({low, high});
    changed = true;
  }
  return changed;
}

bool ReferenceNetwork::step(const Input& input) {
  typical_step_ = 0;
  for (const Input::Bound& b : input.bounds) bundles_[b.bundle].law(b.member).bound(b.bounds);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    x_[n] = nodes_[n].prescribed ? input.displacement[n] : nodes_[n].velocity * input.h;
  }
  // A slider sticks up to its breakaway force and slips at its Coulomb force: which of the two is the map of this step
  // depends on the step. So do the losses of gears. Each round begins where the last one ended.
  for (int round = 0; round < (losses() ? rounds_of_losses : rounds_of_slips); ++round) {
    if (!minimise(input)) return false;
    bool again = false;
    for (std::size_t k = 0; k < bundles_.size(); ++k) {
      ReferenceBundle& b = bundles_[k];
      if (unknown_[at(b.a)] < 0 && unknown_[at(b.b)] < 0) {
        double total = x_[at(b.a)] - x_[at(b.b)];
        // The difference of two equal motions may be left with some rounding.
        const double rounding = 1e-15 * (std::abs(nodes_[at(b.a)].position) + std::abs(nodes_[at(b.b)].position)) +
                                1e-13 * (std::abs(x_[at(b.a)]) + std::abs(x_[at(b.b)]));
        if (std::abs(total) <= rounding) total = 0;
        points_[k] = total == 0 ? ReferenceBundle::Point{0, b.preferred(input.h), 0} : b.at(total, input.h);
        if (b.follow_slips(total) && total != 0) points_[k] = b.at(total, input.h);
        if (std::isinf(points_[k].force)) return false;
      } else {
        again = b.follow_slips(points_[k].step) || again;
      }
    }
    again = follow_losses() || again;
    if (!again) break;
  }
  // With gears all may be at rest all the time, in forces that none of them determines: their impulse tells what would be a motion.
  impulse_ += largest_force_ * input.h;
  still_ = little_stretch * typical_step_;
  if (!gears_.empty()) still_ = std::max(still_, left_of_rest * impulse_ / total_mass_ * input.h);
  note_ambiguity();
  std::fill(nodal_.begin(), nodal_.end(), 0.0);
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    ReferenceBundle& b = bundles_[k];
    nodal_[at(b.a)] += points_[k].force;
    nodal_[at(b.b)] -= points_[k].force;
    b.accept(points_[k].step, points_[k].force, input.h);
  }
  for (const Gear& gear : gears_) {
    for (std::size_t e = 0; e < 3; ++e) nodal_[at(gear.node[e])] += gear.factor[e] * gear.force;
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    nodes_[n].position += x_[n];
    const double velocity = nodes_[n].prescribed ? input.velocity[n] : x_[n] / input.h;
    nodes_[n].acceleration = (velocity - nodes_[n].velocity) / span(input);
    nodes_[n].velocity = velocity;
  }
  before_ = input.h;
  return true;
}

bool ReferenceNetwork::turned_since(const ReferenceNetwork& before) const {
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    for (std::size_t m = 0; m < bundles_[k].members().size(); ++m) {
      if (bundles_[k].members()[m].law.turned_since(before.bundles_[k].members()[m].law)) return true;
    }
  }
  return false;
}

bool ReferenceNetwork::could_slip_on(const ReferenceNetwork& before) const {
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    if (bundles_[k].could_slip_on(before.bundles_[k])) return true;
  }
  return false;
}

bool ReferenceNetwork::follow(const ReferenceNetwork& other, const ReferenceNetwork& before) {
  bool any = false;
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    for (std::size_t m = 0; m < bundles_[k].members().size(); ++m) {
      any = bundles_[k].law(m).follow(other.bundles_[k].members()[m].law, before.bundles_[k].members()[m].law) || any;
    }
  }
  return any;
}

}  // namespace rheonet::test
