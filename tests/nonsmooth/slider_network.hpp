#pragma once

#include <vector>

#include "core/nonsmooth/boxed_forces.hpp"
#include "tests/support/random.hpp"

namespace rheonet::test {

/// Sliders between free nodes and held ones (-1), and loads at the free nodes.
struct SliderNetwork {
  int nodes = 0;
  std::vector<BoxedBranch> branches;
  std::vector<double> load;

  double largest_load() const;
  void push(const std::vector<double>& force);  ///< loads that these forces balance
};

/// Up to 5 nodes and 9 sliders, some of them in parallel, whose bounds are `scale` times or divided by up to `spread`. Loads are
/// `part` times what some forces near the bounds balance: with more than 1, some networks are overloaded.
SliderNetwork random_network(Random& random, double scale, double spread, double part);

/// A square grid with `side` nodes a side, held at one corner.
SliderNetwork random_grid(Random& random, int side, double spread);

}  // namespace rheonet::test
