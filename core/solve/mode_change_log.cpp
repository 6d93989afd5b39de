#include "core/solve/mode_change_log.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/numerics.hpp"
#include "core/dae/polynomial.hpp"

namespace rheonet {

namespace {

/// The time at which g falls through 0 between two times, by the Illinois variant of the rule of false position (Dowell and
/// Jarratt, BIT 11 (1971) 168): immediate where g is almost straight.
template <class G>
double first_below_zero(const G& g, double left, double right) {
  double gl = g(left), gr = g(right);
  if (gl <= 0 || gr >= 0) return gl <= 0 ? left : right;
  const double enough = numerics::false_position_residual * (gl - gr);
  double best = -gr < gl ? right : left, least = std::min(gl, -gr);
  int kept = 0;  // 1: the right end stayed; -1: the left end did
  for (int k = 0; k < numerics::false_position_iterations; ++k) {
    const double t = left + (right - left) * (gl / (gl - gr));
    if (!(t > left && t < right)) break;
    const double now = g(t);
    if (std::abs(now) < least) {
      best = t;
      least = std::abs(now);
    }
    if (least <= enough) break;
    if (now > 0) {
      left = t;
      gl = now;
      if (kept > 0) gr /= 2;
      kept = 1;
    } else {
      right = t;
      gr = now;
      if (kept < 0) gl /= 2;
      kept = -1;
    }
  }
  return best;
}

/// Single deflections within the integrator's last step. The order of a step is so low that values at a few times determine
/// each unknown at all other times.
class WithinStep {
 public:
  WithinStep(const Integrator& integrator, const Dae& dae) : integrator_(integrator), dae_(dae) {}

  double deflection(int branch, double t) {
    const int unknown = dae_.indices().deflection[at(branch)];
    if (unknown < 0) return dae_.driven().deflection(at(branch), t);
    if (samples_[0].empty()) take_samples();
    double p[step_points];
    for (std::size_t k = 0; k < step_points; ++k) p[k] = samples_[k][static_cast<std::size_t>(unknown)];
    return interpolate(times_, p, step_points, t);
  }

 private:
  void take_samples() {
    const double begin = integrator_.previous_time(), end = integrator_.time();
    for (std::size_t k = 0; k < step_points; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(step_points - 1);
      times_[k] = begin + share * (end - begin);
      integrator_.interpolate(times_[k], 0, samples_[k]);
    }
  }

  const Integrator& integrator_;
  const Dae& dae_;
  double times_[step_points] = {};
  std::vector<double> samples_[step_points];
};

}  // namespace

ModeChangeLog::ModeChangeLog(const Network& network, const Inputs& inputs)
    : network_(network), inputs_(inputs), blocks_(inputs.blocks()), sides_(network.blocks.blocks.size(), 0), switches_(sides_.size()) {
  last_.slider.assign(network.sliders.size(), Modes::stuck);
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    if (laws.batch.get() == network.bundles) continue;
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->events(i) == 0) continue;
      const int element = network.deflections[static_cast<std::size_t>(laws.first) + i].element;
      laws_.push_back({laws.batch.get(), i, element, {}});
      laws_.back().last = laws_.back().now();
    }
  }
  for (std::size_t k = 0; network.bundles && k < network.bundles->size(); ++k) {
    const Iwan& law = (*network.bundles)[k];
    bundles_.push_back({.branch = network.first_bundle + static_cast<int>(k),
                        .law = &law,
                        .pairs = std::vector<int>(law.size()),
                        .mode = std::vector<signed char>(law.size(), 0),
                        .slipping = {}});
  }
  for (std::size_t k = 0; k < network.pairs.size(); ++k) {
    const Pair& pair = network.pairs[k];
    bundles_[static_cast<std::size_t>(pair.bundle)].pairs[pair.index] = static_cast<int>(k);
  }
}

const std::vector<Event>& ModeChangeLog::follow(double t, const Modes& modes, const std::vector<double>& p) {
  events_.clear();
  for (Law& law : laws_) {
    const Condition now = law.now();
    if (now.direction != law.last.direction) {
      turn(t, law.element, law.last.direction, now.direction, "stop", "start");
    } else if (now.bound != law.last.bound) {
      events_.push_back({t, law.element, now.bound ? "yield" : "release", now.direction});
    }
    if (now.contact != law.last.contact) {
      events_.push_back({t, law.element, now.contact == 0 ? "release" : "contact", now.contact == 0 ? -law.last.contact : now.contact});
    }
    law.last = now;
  }
  for (std::size_t k = 0; k < modes.slider.size(); ++k) {
    if (modes.slider[k] == last_.slider[k] || network_.sliders[k].contact) continue;  // the gauge tells of contacts
    const Bounds& bounds = inputs_.box(k).at(modes.slider[k] != 0 ? modes.slider[k] : last_.slider[k]);
    turn(t, network_.sliders[k].branch.element, last_.slider[k], modes.slider[k], "stick",
         bounds.breakaway > bounds.sliding ? "breakaway" : "slip");
    last_.slider[k] = modes.slider[k];
  }
  for (Bundle& bundle : bundles_) follow(t, bundle, p[static_cast<std::size_t>(bundle.branch)]);
  follow_blocks(t);
  return events_;
}

void ModeChangeLog::follow_blocks(double t) {
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    if (const FunctionBlock* function = blocks_.function(static_cast<int>(k))) {
      std::vector<double>& before = switches_[k];
      before.resize(function->sides().size(), SwitchedFunction::no_side);
      double change = 0;
      for (std::size_t i = 0; i < before.size() && change == 0; ++i) {
        const double now = function->sides()[i];
        if (!std::isnan(now) && !std::isnan(before[i])) change = now - before[i];
      }
      if (change != 0) events_.push_back({t, network_.blocks.blocks[k].element, "switch", change < 0 ? -1 : 1});
      before = function->sides();
      continue;
    }
    const int side = blocks_.side(static_cast<int>(k));
    if (side == sides_[k]) continue;
    events_.push_back({t, network_.blocks.blocks[k].element, side == 0 ? "release" : "limit", side});
    sides_[k] = side;
  }
}

void ModeChangeLog::follow(double t, Bundle& bundle, double p) {
  const Iwan& law = *bundle.law;
  if (bundle.on != law.branch()) {
    // The bundle has reversed, perhaps more than once: a pair that slipped sticks, unless it is at a bound again. Or its
    // pairs were only ranked anew: then a pair that slipped goes on.
    bundle.on = law.branch();
    std::vector<std::size_t> before;
    before.swap(bundle.slipping);
    for (std::size_t rank = 0; rank < law.yielded(p); ++rank) yield(t, bundle, law.in_order(rank));
    for (std::size_t pair : before) {
      if (!law.pair_yields(pair, p)) {
        tell(t, bundle, pair, bundle.mode[pair], 0);
        bundle.mode[pair] = 0;
      }
    }
  }
  for (std::size_t rank = bundle.slipping.size(); rank < law.yielded(p); ++rank) yield(t, bundle, law.in_order(rank));
}

void ModeChangeLog::yield(double t, Bundle& bundle, std::size_t pair) {
  const auto direction = static_cast<signed char>(bundle.law->direction());
  tell(t, bundle, pair, bundle.mode[pair], direction);
  bundle.mode[pair] = direction;
  bundle.slipping.push_back(pair);
}

void ModeChangeLog::tell(double t, const Bundle& bundle, std::size_t index, int before, int after) {
  if (before == after) return;
  const Pair& pair = network_.pairs[static_cast<std::size_t>(bundle.pairs[index])];
  const int sign = pair.sign * pair.slider_sign < 0 ? -1 : 1;
  turn(t, pair.slider, sign * before, sign * after, "stick", "slip");
}

const std::vector<Event>& ModeChangeLog::follow_step(const Integrator& integrator, const Dae& dae,
                                                const std::vector<double>& p, bool timed) {
  events_.clear();
  if (bundles_.empty()) return events_;
  WithinStep step(integrator, dae);
  const double end = integrator.time();
  for (Bundle& bundle : bundles_) {
    const Iwan& law = *bundle.law;
    double t = integrator.previous_time();
    const std::size_t yielded = law.yielded(p[static_cast<std::size_t>(bundle.branch)]);
    for (std::size_t rank = bundle.slipping.size(); rank < yielded; ++rank) {
      const auto left = [&](double at) {
        return law.direction() * (law.yield_point(rank) - step.deflection(bundle.branch, at));
      };
      t = timed ? first_below_zero(left, t, end) : end;
      yield(t, bundle, law.in_order(rank));
    }
  }
  std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
  return events_;
}

void ModeChangeLog::turn(double t, int element, int before, int after, const char* to_rest, const char* from_rest) {
  events_.push_back({t, element, after == 0 ? to_rest : before == 0 ? from_rest : "reversal", after});
}

}  // namespace rheonet
