#include "core/result/energy.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/state_powers.hpp"

namespace rheonet {

EnergyAccount::EnergyAccount(double tolerance, double length, bool parts) : tolerance_(tolerance), length_(length), parts_(parts) {}

void EnergyAccount::attach(Dae& dae, Consistency& consistency) {
  dae_ = &dae;
  consistency_ = &consistency;
  needs_rates_ = StatePowers::need_rates(dae);
  const Network& network = dae.network();
  const Structure& structure = dae.structure();
  // Nodes stuck to ground are known too, but at rest: nothing happens at them.
  const auto at_rest = [&](NodeId node) {
    return node < 0 || (structure.kind[at(structure.rigid[at(node)])] == Kind::known && structure.motion[at(structure.rigid[at(node)])] < 0);
  };
  const auto given = [&](NodeId node) { return at_rest(node) || structure.kind[at(structure.rigid[at(node)])] == Kind::known; };
  const auto between_given = [&](const auto& branch) {
    return given(branch.a) && given(branch.b) && !(at_rest(branch.a) && at_rest(branch.b));
  };
  const auto any_between_given = [&](const auto& branches) { return std::any_of(branches.begin(), branches.end(), between_given); };
  bool driven = false;
  for (std::size_t j = 0; j < network.deflections.size(); ++j)
    driven = driven || (structure.driven[j] != 0 && between_given(network.deflections[j]));
  adaptive_ = driven || any_between_given(network.rates) || any_between_given(network.forces) ||
              any_between_given(structure.sliders) ||
              std::any_of(network.masses.begin(), network.masses.end(),
                          [&](const Network::Mass& m) { return given(m.node) && !at_rest(m.node); });
  const Inputs& inputs = dae.inputs();
  hidden_ = adaptive_ && (inputs.fastest() > 0 || std::isfinite(inputs.next_signal_break()) || !network.blocks.blocks.empty());
}

void EnergyAccount::begin(double t, const std::vector<double>& y, const std::vector<double>& yp, double heat) {
  dae_->view(t, y.data(), yp.data());
  last_ = {StatePowers(*dae_).supplied(), StatePowers(*dae_).dissipated()};
  known_ = 0;
  remember(t, last_);
  heat_ = StatePowers(*dae_).heat_of_laws();
  const double stored = StatePowers(*dae_).stored();
  if (parts_) kinetic_ = StatePowers(*dae_).kinetic();
  if (!begun_) {
    stored_at_start_ = stored;
    begun_ = true;
  } else {
    sum_.supplied += stored - stored_ + heat;
    sum_.dissipated += heat;
  }
  stored_ = stored;
  largest_ = std::max(largest_, std::abs(stored_));
}

// Some unknowns do not follow the integrator's polynomial between steps.
bool EnergyAccount::solved_between_steps() const { return dae_->rough() || dae_->follows_time(); }

EnergyAccount::Power EnergyAccount::power_at_end(const Integrator& integrator) {
  if (solved_between_steps()) return power(integrator, integrator.time());
  yp_ = integrator.yp();
  return {StatePowers(*dae_).supplied(), StatePowers(*dae_).dissipated()};
}

// Rates at time t if the power depends on them, otherwise those of the end of the step.
EnergyAccount::Power EnergyAccount::power(const Integrator& integrator, double t) {
  integrator.interpolate(t, 0, y_);
  if (needs_rates_ || solved_between_steps()) integrator.interpolate(t, 1, yp_);
  if (solved_between_steps()) consistency_->collocate(t, 1 / (integrator.time() - integrator.previous_time()), y_, yp_);
  dae_->view(t, y_.data(), yp_.data());
  return {StatePowers(*dae_).supplied(), StatePowers(*dae_).dissipated()};
}

void EnergyAccount::remember(double t, const Power& power) {
  std::copy_backward(times_.begin(), times_.end() - 1, times_.end());
  times_[0] = t;
  known_ = std::min(known_ + 1, remembered);
  Power fresh = power;
  for (std::size_t k = 0; k < known_; ++k) {
    const Power old = differences_[k];
    differences_[k] = fresh;
    if (k + 1 == known_) break;
    const double apart = t - times_[k + 1];
    fresh = {(fresh.supplied - old.supplied) / apart, (fresh.dissipated - old.dissipated) / apart};
  }
}

// Integrates Newton's polynomial through the last step ends by Gauss's four-point rule, which is exact for it. Its last
// term, the difference to a polynomial with one point less, bounds the error. Over the run it may sum to the tolerance.
std::optional<EnergyAccount::Power> EnergyAccount::from_past(double a, double b) const {
  if (known_ < remembered || hidden_ || solved_between_steps()) return {};
  constexpr std::size_t points = 4;
  constexpr std::array<double, points> abscissae{0.33998104358485626, -0.33998104358485626, 0.86113631159405258, -0.86113631159405258};
  constexpr std::array<double, points> weights{0.65214515486254614, 0.65214515486254614, 0.34785484513745386, 0.34785484513745386};
  const double middle = (a + b) / 2, half = (b - a) / 2;
  std::array<double, points> t, basis;  // (t - times_[0]) (t - times_[1]) ..., with its weight
  for (std::size_t k = 0; k < points; ++k) t[k] = middle + half * abscissae[k];
  for (std::size_t k = 0; k < points; ++k) basis[k] = half * weights[k];
  std::array<double, remembered> integral;
  for (std::size_t i = 0; i < remembered; ++i) {
    integral[i] = (basis[0] + basis[1]) + (basis[2] + basis[3]);
    for (std::size_t k = 0; k < points; ++k) basis[k] *= t[k] - times_[i];
  }
  const double allowed = tolerance_ * largest_ * (b - a) / length_;
  const Power& last = differences_.back();
  const double most = std::max(std::abs(last.supplied), std::abs(last.dissipated)) * std::abs(integral.back());
  if (!(most <= allowed)) return {};
  Power sum;
  for (std::size_t i = 0; i < remembered; ++i) {
    sum.supplied += differences_[i].supplied * integral[i];
    sum.dissipated += differences_[i].dissipated * integral[i];
  }
  return sum;
}

// A step of an exact arc is a polynomial of degree 12 to round-off: Gauss's rule with 7 points, which is exact up to degree 13, gives the
// integral of a product of two such quantities to 1e-15.
EnergyAccount::Power EnergyAccount::along_arc(const Integrator& integrator, double a, double b) {
  constexpr std::array<double, 4> abscissae{0, 0.40584515137739717, 0.74153118559939444, 0.94910791234275852};
  constexpr std::array<double, 4> weights{0.41795918367346939, 0.38183005050511894, 0.27970539148927664, 0.12948496616886969};
  const double middle = (a + b) / 2, half = (b - a) / 2;
  Power sum;
  const auto add = [&](double t, double weight) {
    const Power p = power(integrator, t);
    sum.supplied += half * weight * p.supplied;
    sum.dissipated += half * weight * p.dissipated;
  };
  for (std::size_t k = 0; k < abscissae.size(); ++k) {
    add(middle + half * abscissae[k], weights[k]);
    if (k > 0) add(middle - half * abscissae[k], weights[k]);
  }
  return sum;
}

EnergyAccount::Power EnergyAccount::lobatto(const Integrator& integrator, double a, double b, const Power& pa,
                                            const Power& pb, int depth) {
  const double middle = (a + b) / 2, half = (b - a) / 2;
  const double inner = half / std::sqrt(5.0);
  const Power pl = power(integrator, middle - inner), pr = power(integrator, middle + inner);
  const auto four = [&](double Power::*q) { return half / 6 * (pa.*q + pb.*q + 5 * (pl.*q + pr.*q)); };
  Power result{four(&Power::supplied), four(&Power::dissipated)};
  if (!adaptive_) return result;

  const double outer = half * std::sqrt(2.0 / 3);
  const Power pm = power(integrator, middle), pll = power(integrator, middle - outer),
              prr = power(integrator, middle + outer);
  const auto seven = [&](double Power::*q) {
    return half / 1470 *
           (77 * (pa.*q + pb.*q) + 432 * (pll.*q + prr.*q) + 625 * (pl.*q + pr.*q) + 672 * pm.*q);
  };
  const Power better{seven(&Power::supplied), seven(&Power::dissipated)};
  const double error =
      std::max(std::abs(better.supplied - result.supplied), std::abs(better.dissipated - result.dissipated));
  largest_ = std::max({largest_, std::abs(sum_.supplied + better.supplied), std::abs(sum_.dissipated + better.dissipated)});
  // The difference of the two rules far exceeds the error of the better one.
  if (error <= tolerance_ * largest_ || depth >= numerics::energy_halvings || half <= time_roundoff(b)) return better;
  const Power left = lobatto(integrator, a, middle, pa, pm, depth + 1);
  const Power right = lobatto(integrator, middle, b, pm, pb, depth + 1);
  return {left.supplied + right.supplied, left.dissipated + right.dissipated};
}

void EnergyAccount::step(const Integrator& integrator) {
  const double a = integrator.previous_time(), b = integrator.time();
  if (!(b > a)) return;
  before_ = {a, b, sum_, stored_, last_.dissipated, heat_};
  const Power pa = last_, pb = power_at_end(integrator);
  stored_ = StatePowers(*dae_).stored();
  if (parts_) kinetic_ = StatePowers(*dae_).kinetic();
  last_ = pb;
  const double heat = StatePowers(*dae_).heat_of_laws();
  sum_.dissipated += heat - heat_;
  heat_ = heat;
  if (!integrator.exact()) remember(b, pb);
  const std::optional<Power> smooth = integrator.exact() ? along_arc(integrator, a, b) : from_past(a, b);
  const Power added = smooth ? *smooth : lobatto(integrator, a, b, pa, pb, 0);
  sum_.supplied += added.supplied;
  sum_.dissipated += added.dissipated;
  largest_ = std::max({largest_, std::abs(stored_), std::abs(sum_.supplied), std::abs(sum_.dissipated)});
}

void EnergyAccount::sample(double t) {
  const StatePowers now(*dae_);
  samples_.push_back({t, now.stored(), now.kinetic(), now.dissipated(), now.heat_of_laws()});
}

// The state gives the stored energy. The dissipated energy is the trapezoidal integral of the power over the samples; a correction that grows
// with time makes it equal to the account at the end of the step. The supplied energy is the sum of both.
std::vector<std::pair<double, EnergySoFar>> EnergyAccount::take_samples() {
  std::vector<std::pair<double, EnergySoFar>> result;
  if (samples_.empty()) return result;
  const Before& from = before_;
  const double length = from.end - from.t;
  double t = from.t, power = from.power, integral = 0;
  const auto add = [&](double next, double next_power) {
    integral += (next - t) * (power + next_power) / 2;
    t = next;
    power = next_power;
  };
  std::vector<double> integrals;
  for (const Sample& s : samples_) {
    add(s.t, s.power);
    integrals.push_back(integral);
  }
  add(from.end, last_.dissipated);
  const double off = sum_.dissipated - from.sum.dissipated - (heat_ - from.heat) - integral;
  const double missing_before = from.sum.supplied - (from.stored - stored_at_start_) - from.sum.dissipated;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const Sample& s = samples_[k];
    const double share = length > 0 ? (s.t - from.t) / length : 0;
    EnergySoFar then;
    then.stored = s.stored - stored_at_start_;
    then.dissipated = from.sum.dissipated + (s.heat - from.heat) + integrals[k] + share * off;
    then.supplied = then.stored + then.dissipated + missing_before + share * (missing() - missing_before);
    then.kinetic = s.kinetic;
    then.elastic = s.stored - s.kinetic;
    result.push_back({s.t, then});
  }
  samples_.clear();
  return result;
}

}  // namespace rheonet
