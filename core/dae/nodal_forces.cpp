#include "core/dae/nodal_forces.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

double NodalForces::lacking(std::size_t n, double accepted) const {
  const double out = std::abs(sum[n]) - accepted;
  return out > numerics::balance_roundoff * magnitude[n] + rounding[n] ? -std::copysign(out, sum[n]) : 0;
}

double force_of_deflection(const DeflectionBatch& batch, std::size_t i, double p) {
  return p == 0 ? 0 : batch.slope(i, p, batch.direction(i)) * std::abs(p);
}

NodalForces nodal_forces(const EventNetwork& net, const State& state, const std::vector<double>& slider_force, bool rates) {
  const std::vector<double> none(net.structure.kind.size(), 0);
  NodalForces result{none, none, none};
  const auto add = [&](NodeId node, double f) {
    if (node < 0) return;
    result.sum[at(node)] += f;
    result.magnitude[at(node)] += std::abs(f);
  };
  const auto add_branch = [&](const Branch& b, double f) {
    add(b.a, f);
    add(b.b, -f);
  };
  std::vector<double> f(state.p.size()), c(f);
  for (const Laws<DeflectionBatch>& laws : net.network.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &c[at(laws.first)]);
  }
  for (const Laws<DeflectionBatch>& laws : net.network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const Branch& b = net.network.deflections[j];
      add_branch(b, f[j]);
      const double more = numerics::deflection_force_share * force_of_deflection(*laws.batch, i, state.p[j]) - std::abs(f[j]);
      for (const NodeId node : {b.a, b.b}) result.magnitude[at(node)] += std::max(0.0, more);
    }
  }
  for (std::size_t k = 0; k < slider_force.size(); ++k) add_branch(net.network.sliders[k].branch, slider_force[k]);
  for (const Laws<RateBatch>& laws : net.network.rate_laws) {
    for (std::size_t i = 0; rates && i < laws.batch->size(); ++i) {
      const Branch& b = net.network.rates[at(laws.first) + i];
      const double va = state.velocity[at(b.a)], vb = state.velocity[at(b.b)], w = va - vb;
      const double force = laws.batch->force_at(i, w);
      add_branch(b, force);
      if (!(laws.batch->growth(i).exponent < 1)) continue;
      // This law is solved for its force, to the round-off of velocities: near rest that round-off changes the force.
      const double left = numerics::equation_roundoff * (std::abs(va) + std::abs(vb));
      const double rounding = std::max(laws.batch->force_at(i, w + left) - force, force - laws.batch->force_at(i, w - left));
      for (const NodeId node : {b.a, b.b}) result.rounding[at(node)] += rounding;
    }
  }
  for (std::size_t k = 0; k < net.network.trains.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) add(net.network.trains[k].node[i], net.network.trains[k].factor[i] * state.train_force[k]);
  }
  for (std::size_t k = 0; k < net.network.forces.size(); ++k) {
    add(net.network.forces[k].a, -net.inputs.force[k]);
    add(net.network.forces[k].b, net.inputs.force[k]);
  }
  return result;
}

NodalForces together(const EventNetwork& net, const NodalForces& single) {
  const std::vector<double> none(single.sum.size(), 0);
  NodalForces result{none, none, none};
  for (std::size_t n = 0; n < none.size(); ++n) {
    const std::size_t speaks = at(net.speaker(static_cast<NodeId>(n)));
    result.sum[speaks] += single.sum[n];
    result.magnitude[speaks] += single.magnitude[n];
    result.rounding[speaks] += single.rounding[n];
  }
  return result;
}

}  // namespace rheonet
