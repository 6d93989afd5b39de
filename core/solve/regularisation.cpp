#include "core/solve/regularisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/rate_law.hpp"
#include "core/solve/stop_chains.hpp"

namespace rheonet {

Regularisation::Regularisation(const Network& network)
    : network_(network), applied_(network.rates.size(), not_given), least_velocity_(network.rates.size(), 0), stops_(network.rates.size(), 0),
      follows_(stops_), mass_(network.rates.size(), 0) {}

void Regularisation::attach(const Structure& structure) {
  std::fill(stops_.begin(), stops_.end(), 0);
  std::fill(mass_.begin(), mass_.end(), 0);
  std::fill(follows_.begin(), follows_.end(), 0);
  const auto heavy = [&](NodeId n) { return structure.kind[at(n)] == Kind::known || structure.kind[at(n)] == Kind::massive; };
  for (std::size_t r = 0; r < follows_.size(); ++r) follows_[r] = heavy(structure.rates[r].a) && heavy(structure.rates[r].b);
  // `structure` represents ends that sliders hold together by one node.
  const auto for_each_pseudoplastic = [&](auto visit) {
    for (const Laws<RateBatch>& laws : network_.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const std::size_t r = at(laws.first) + i;
        if (laws.batch->growth(i).exponent < 1 && structure.rates[r].a != structure.rates[r].b) visit(r, structure.rates[r]);
      }
    }
  };
  // Chains of pseudoplastic laws through massless nodes.
  DisjointSets chains(structure.kind.size());
  for_each_pseudoplastic([&](std::size_t, const Branch& b) {
    if (!heavy(b.a) && !heavy(b.b)) chains.join(b.a, b.b);
  });
  struct Ends { int heavy = 0; bool mass = false; };
  std::vector<Ends> ends(structure.kind.size());
  const auto ends_of = [&](const Branch& b) {
    Ends direct;
    Ends& sum = heavy(b.a) && heavy(b.b) ? direct : ends[at(chains.find(heavy(b.a) ? b.b : b.a))];
    for (const NodeId n : {b.a, b.b}) {
      sum.heavy += heavy(n) ? 1 : 0;
      sum.mass = sum.mass || structure.kind[at(n)] == Kind::massive;
    }
    return sum;
  };
  for_each_pseudoplastic([&](std::size_t, const Branch& b) { ends_of(b); });
  for_each_pseudoplastic([&](std::size_t r, const Branch& b) {
    const bool direct = heavy(b.a) && heavy(b.b);
    const Ends found = direct ? ends_of(b) : ends[at(chains.find(heavy(b.a) ? b.b : b.a))];
    stops_[r] = found.heavy > 1 && (found.mass || !direct);
  });
  const auto yields = [&](NodeId n) { return structure.kind[at(n)] == Kind::massive ? 1 / structure.inertia[at(n)] : 0; };
  for (const StopChain& chain : find_stop_chains(network_, structure)) {
    const double yielding = yields(chain.a) + yields(chain.b);
    for (const int r : chain.rates) mass_[at(r)] = yielding > 0 ? 1 / yielding : 0;
  }
}

void Regularisation::begin(const Inputs& inputs, const std::vector<double>& velocity) {
  const Inputs::Reach reach = coming_reach(inputs, velocity);
  applied_.assign(applied_.size(), not_given);
  std::fill(least_velocity_.begin(), least_velocity_.end(), 0.0);
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (!(laws.batch->growth(i).exponent > 1)) continue;
      const double coming_velocity = laws.batch->velocity_at(i, coming_force(*laws.batch, i, reach));
      least_velocity_[at(laws.first) + i] = std::numeric_limits<double>::epsilon() * coming_velocity;
    }
  }
}

/// The velocity [m/s] below which round-off of time hides that the law stops a mass: m w' = -B w^n takes m w^(1-n)/B.
double Regularisation::slowest_stop(std::size_t rate, const Growth& growth) const {
  const auto [B, n] = growth;
  const double shortest = numerics::regularised_duration * time_roundoff(network_.scene->stop - network_.scene->start);
  return std::pow(n * B * shortest / mass_[rate], 1 / (1 - n));
}

void Regularisation::apply(const Tolerances& tolerances) {
  const auto same = [](double a, double b) { return a == b || (a < numerics::regularisation_change * b && b < numerics::regularisation_change * a); };
  const double unresolved = tolerances.unresolved();
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const Growth growth = laws.batch->growth(i);
      double w = 0;
      if (growth.exponent > 1) w = std::max(least_velocity_[r], follows_[r] ? 0 : tolerances.dead_bands().unfelt_dilatant(static_cast<int>(r)));
      if (growth.exponent < 1 && stops_[r]) w = numerics::negligible_force * unresolved;
      // Even at such a small velocity the force may be large, and all of it vanishes at rest.
      if (growth.exponent < 1 && mass_[r] > 0) w = std::min(w, std::max(tolerances.unfelt(static_cast<int>(r)), slowest_stop(r, growth)));
      if (same(w, applied_[r])) continue;
      applied_[r] = w;
      laws.batch->regularise(i, w);
    }
  }
}

}  // namespace rheonet
