#include "core/dae/step_errors.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"

namespace rheonet {

void StepErrors::accept(const Branch& branch, double imbalance) {
  for (const NodeId node : {branch.a, branch.b}) accepted_[at(node)] += imbalance;
}

void StepErrors::take_back_excess(const Modes& modes, std::vector<double>& force) {
  for (std::size_t k = 0; k < force.size(); ++k) {
    // An impact has opened it: its force is over, and no error.
    if (apart(net_.network, net_.network.sliders[k])) force[k] = 0;
    const int side = force[k] > 0 ? 1 : -1;
    const double most = bounds_.bound(k, side), excess = std::abs(force[k]) - most;
    if (modes.slider[k] != Modes::stuck || !(excess > 0)) continue;
    force[k] = side * most;
    accept(net_.network.sliders[k].branch, excess);
  }
}

void StepErrors::keep_slipping(std::vector<double>& force) {
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double full = bounds_.slips(k) * bounds_.sliding(k, bounds_.slips(k)), lack = bounds_.slips(k) * (full - force[k]);
    if (!(lack > 0) || lack > numerics::step_error_of_balance * std::abs(full)) continue;
    force[k] = full;
    accept(net_.network.sliders[k].branch, lack);
  }
}

void StepErrors::stop_at_turns(const FiredGuards& fired, const Modes& modes, State& state) {
  if (std::none_of(fired.turns.begin(), fired.turns.end(), [&](int j) { return net_.may_stand(j); })) return;
  DisjointSets together(net_.structure.kind.size());
  for (std::size_t k = 0; k < net_.network.sliders.size(); ++k) {
    const Branch& b = net_.network.sliders[k].branch;
    if (modes.slider[k] == Modes::stuck) together.join(b.a, b.b);
  }
  for (const Laws<DeflectionBatch>& laws : net_.network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = net_.network.deflections[at(laws.first) + i];
      if (laws.batch->holds(i)) together.join(b.a, b.b);
    }
  }
  std::vector<char> heavy(net_.structure.kind.size(), 0);
  for (std::size_t n = 0; n < heavy.size(); ++n) {
    if (!net_.massless(static_cast<NodeId>(n))) heavy[at(together.find(static_cast<NodeId>(n)))] = 1;
  }
  const std::vector<double> before = state.velocity;
  for (const int j : fired.turns) {
    if (!net_.may_stand(j)) continue;
    const Branch& b = net_.network.deflections[at(j)];
    NodeId stops = together.find(b.a), beside = b.b;
    if (heavy[at(stops)]) std::tie(stops, beside) = std::pair(together.find(b.b), b.a);
    if (heavy[at(stops)] || together.find(beside) == stops) continue;
    const double velocity = state.velocity[at(beside)];
    for (std::size_t n = 0; n < heavy.size(); ++n) {
      if (together.find(static_cast<NodeId>(n)) == stops) state.velocity[n] = velocity;
    }
  }
  // The balances lack the forces of that velocity (large for a pseudoplastic dashpot): accept the imbalance.
  for (const Laws<RateBatch>& laws : net_.network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = net_.network.rates[at(laws.first) + i];
      const double w = before[at(b.a)] - before[at(b.b)], now = state.velocity[at(b.a)] - state.velocity[at(b.b)];
      if (now == w) continue;
      accept(b, std::abs(laws.batch->force_at(i, w) - laws.batch->force_at(i, now)));
    }
  }
}

}  // namespace rheonet
