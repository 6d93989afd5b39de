#pragma once

#include "core/base/index.hpp"
#include "core/dae/dae.hpp"

namespace rheonet {

/// A spring and its slider in a state of their bundle; positive from the spring's end to the slider's.
struct PairView {
  PairView(const Network& network, int k, const Dae::View& view)
      : pair(network.pairs[at(k)]),
        bundle((*network.bundles)[at(pair.bundle)]),
        branch(network.first_bundle + pair.bundle),
        p(view.p[at(branch)]) {}
  double force() const { return pair.sign * bundle.pair_force(pair.index, p); }
  double stretch() const { return pair.sign * bundle.stretch(pair.index, p); }
  double slide() const { return pair.sign * bundle.slide(pair.index, p); }
  bool slips() const { return bundle.pair_yields(pair.index, p); }

  const Pair& pair;
  const Iwan& bundle;
  int branch;
  double p;
};

}  // namespace rheonet
