#include <fmt/format.h>

#include <cmath>

#include "core/dae/dae.hpp"

namespace rheonet {

namespace {

/// The initial displacement (`d0`) that an element was given; NaN if none.
double initial_displacement(const Network& network, const Branch& branch) {
  const SceneElement& element = network.scene->elements[static_cast<std::size_t>(branch.element)];
  const Declaration& declaration = *declarations()[static_cast<std::size_t>(element.declaration)];
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    const Parameter& p = declaration.parameters[k];
    if (p.kind == Parameter::Kind::initial && p.quantity == Quantity::position) return element.values[k];
  }
  return not_given;
}

/// Gives nodes whose position the user left open the one that follows from the initial displacement of an element.
void follow_displacements(const Network& network, std::vector<double>& x, std::vector<char>& fixed) {
  std::vector<const Branch*> open;
  const auto collect = [&](const std::vector<Branch>& branches) {
    for (const Branch& b : branches) {
      if (!std::isnan(initial_displacement(network, b))) open.push_back(&b);
    }
  };
  collect(network.deflections);
  collect(network.rates);
  for (bool again = true; again;) {
    again = false;
    for (const Branch*& b : open) {
      if (!b) continue;
      const auto a = static_cast<std::size_t>(b->a), c = static_cast<std::size_t>(b->b);
      const double d0 = initial_displacement(network, *b);
      if (fixed[a] && fixed[c]) {
        if (std::abs(x[a] - x[c] - d0) > 1e-9 * (std::abs(x[a]) + std::abs(x[c]) + std::abs(d0))) {
          throw SimulationError(fmt::format(
              "element `{}` cannot start with the displacement d0 = {:g}: nodes `{}` and `{}` start {:g} apart; leave out "
              "`d0` or a position",
              network.name_of(*b), d0, network.node_name(b->a), network.node_name(b->b), x[a] - x[c]));
        }
        b = nullptr;
      } else if (fixed[a] || fixed[c]) {
        (fixed[a] ? x[c] : x[a]) = fixed[a] ? x[a] - d0 : x[c] + d0;
        fixed[a] = fixed[c] = 1;
        b = nullptr;
        again = true;
      }
    }
    if (again) continue;
    // Displacements between nodes that are all free: one of them stays at 0.
    for (const Branch* b : open) {
      if (!b) continue;
      fixed[static_cast<std::size_t>(b->b)] = 1;
      again = true;
      break;
    }
  }
}

}  // namespace

void Dae::initial(double t, std::vector<double>& y) {
  const Scene& scene = *network_->scene;
  const std::size_t nodes = scene.nodes.size();
  std::vector<double> x(nodes, 0);
  std::vector<char> fixed(nodes, 0);
  fixed[ground] = 1;
  for (std::size_t n = 1; n < nodes; ++n) {
    if (std::isnan(scene.nodes[n].position)) continue;
    x[n] = scene.nodes[n].position;
    fixed[n] = 1;
  }
  for (const Network::Motion& m : network_->motions) {
    const std::size_t n = at(m.node);
    const SceneNode& node = scene.nodes[n];
    const std::string& name = scene.elements[at(m.element)].name;
    const double velocity = m.position ? m.signal.piece(t).rate(t) : m.signal.value(t);
    if (m.position) {
      const double before = m.signal.before(t), after = m.signal.value(t);
      const double tolerance = 1e-9 * (std::abs(before) + std::abs(after));
      if (fixed[n] && std::abs(x[n] - before) > tolerance && std::abs(x[n] - after) > tolerance) {
        throw SimulationError(fmt::format(
            "node `{}` cannot start at position {:g}: motion `{}` puts it at {:g}; leave out one of them", node.name, x[n],
            name, after));
      }
      x[n] = before;
    }
    if (!std::isnan(node.velocity) && std::abs(node.velocity - velocity) > 1e-9 * std::abs(velocity)) {
      throw SimulationError(fmt::format(
          "node `{}` cannot start with velocity {:g}: motion `{}` gives it {:g}; leave out one of them", node.name,
          node.velocity, name, velocity));
    }
    fixed[n] = 1;
  }
  follow_displacements(*network_, x, fixed);
  drive_ = std::make_unique<Drive>(*network_, t, x);

  y.assign(at(size_), 0);
  for (std::size_t n = 1; n < nodes; ++n) {
    if (ix_[n] >= 0) y[at(ix_[n])] = x[n];
    if (structure_->kind[n] == Kind::massive && !std::isnan(scene.nodes[n].velocity)) {
      y[at(iv_[n])] = scene.nodes[n].velocity;
    }
  }
  for (const Laws<DeflectionBatch>& laws : network_->deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const Branch& b = network_->deflections[j];
      const double d = x[at(b.a)] - x[at(b.b)];
      const double d0 = initial_displacement(*network_, b);
      const double p = laws.batch->start(i, std::isnan(d0) ? d : d0);
      offset_[j] = d - p;
      if (ip_[j] >= 0) y[at(ip_[j])] = p;
    }
  }
}

}  // namespace rheonet
