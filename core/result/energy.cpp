#include "core/result/energy.hpp"

#include <algorithm>
#include <cmath>

#include "core/network/time_grain.hpp"

namespace rheonet {

EnergyAccount::EnergyAccount(double tolerance) : tolerance_(tolerance) {}

void EnergyAccount::attach(Dae& dae, Consistency& consistency) {
  dae_ = &dae;
  consistency_ = &consistency;
  const Network& network = dae.network();
  const Structure& structure = dae.structure();
  const std::vector<char>& driven = structure.driven;
  const auto given = [&](NodeId node) {
    return node < 0 || structure.kind[static_cast<std::size_t>(structure.rigid[static_cast<std::size_t>(node)])] == Kind::known;
  };
  const auto between_given = [&](const auto& branch) { return given(branch.a) && given(branch.b); };
  adaptive_ = std::any_of(driven.begin(), driven.end(), [](char d) { return d != 0; }) ||
              std::any_of(network.rates.begin(), network.rates.end(), between_given) ||
              std::any_of(network.forces.begin(), network.forces.end(), between_given) ||
              std::any_of(network.masses.begin(), network.masses.end(),
                          [&](const Network::Mass& m) { return given(m.node); }) ||
              std::any_of(structure.sliders.begin(), structure.sliders.end(), between_given);
}

void EnergyAccount::begin(double t, const std::vector<double>& y, const std::vector<double>& yp, double heat) {
  dae_->view(t, y.data(), yp.data());
  last_ = {dae_->supplied_power(), dae_->dissipated_power()};
  heat_ = dae_->heat_of_laws();
  const double stored = dae_->stored_energy();
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

EnergyAccount::Power EnergyAccount::power(const Integrator& integrator, double t) {
  integrator.interpolate(t, 0, y_);
  integrator.interpolate(t, 1, yp_);
  if (dae_->rough() || dae_->follows_time()) {
    consistency_->collocate(t, 1 / (integrator.time() - integrator.previous_time()), y_, yp_);
  }
  dae_->view(t, y_.data(), yp_.data());
  return {dae_->supplied_power(), dae_->dissipated_power()};
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
  constexpr int deepest = 14;
  // The difference of the two rules overestimates the error of the better one by far.
  if (error <= tolerance_ * largest_ || depth >= deepest || half <= time_grain(b)) return better;
  const Power left = lobatto(integrator, a, middle, pa, pm, depth + 1);
  const Power right = lobatto(integrator, middle, b, pm, pb, depth + 1);
  return {left.supplied + right.supplied, left.dissipated + right.dissipated};
}

void EnergyAccount::step(const Integrator& integrator) {
  const double a = integrator.previous_time(), b = integrator.time();
  if (!(b > a)) return;
  const Power pa = last_, pb = power(integrator, b);
  stored_ = dae_->stored_energy();
  last_ = pb;
  const double heat = dae_->heat_of_laws();
  sum_.dissipated += heat - heat_;
  heat_ = heat;
  const Power added = lobatto(integrator, a, b, pa, pb, 0);
  sum_.supplied += added.supplied;
  sum_.dissipated += added.dissipated;
  largest_ = std::max({largest_, std::abs(stored_), std::abs(sum_.supplied), std::abs(sum_.dissipated)});
}

}  // namespace rheonet
