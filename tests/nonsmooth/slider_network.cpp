#include "tests/nonsmooth/slider_network.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rheonet::test {

double SliderNetwork::largest_load() const {
  double largest = 0;
  for (const double f : load) largest = std::max(largest, std::abs(f));
  return largest;
}

void SliderNetwork::push(const std::vector<double>& force) {
  load.assign(static_cast<std::size_t>(nodes), 0);
  for (std::size_t k = 0; k < branches.size(); ++k) {
    if (branches[k].a >= 0) load[static_cast<std::size_t>(branches[k].a)] += force[k];
    if (branches[k].b >= 0) load[static_cast<std::size_t>(branches[k].b)] -= force[k];
  }
}

SliderNetwork random_network(Random& random, double scale, double spread, double part) {
  SliderNetwork network{.nodes = 1 + random.below(5), .branches = {}, .load = {}};
  const int nodes = network.nodes, branches = nodes + random.below(5);
  std::vector<double> force;
  for (int k = 0; k < branches; ++k) {
    // The first ones make a tree.
    int a = k < nodes ? k : random.below(nodes), b = random.below(k < nodes ? k + 1 : nodes + 1) - 1;
    if (a == b) b = -1;
    if (random.sign() > 0) std::swap(a, b);
    const double bound = random.around(scale, spread);
    network.branches.push_back({a, b, -bound, bound});
    force.push_back(part * random.sign() * bound * random.uniform(0.5, 1));
  }
  network.push(force);
  return network;
}

SliderNetwork random_grid(Random& random, int side, double spread) {
  SliderNetwork network{.nodes = side * side - 1, .branches = {}, .load = {}};
  std::vector<double> force;
  const auto join = [&](int a, int b) {
    const double bound = random.around(1, spread);
    network.branches.push_back({a - 1, b - 1, -bound, bound});  // the corner is held
    force.push_back(random.sign() * bound * random.uniform(0.5, 1));
  };
  for (int n = 0; n < side * side; ++n) {
    if (n % side > 0) join(n, n - 1);
    if (n >= side) join(n, n - side);
  }
  network.push(force);
  return network;
}

}  // namespace rheonet::test
