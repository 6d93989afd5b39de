#include "core/solve/stop_chains.hpp"

#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

namespace {

/// The number of branches and forces at a node, and the pseudoplastic dashpots among them.
struct Around {
  int count = 0;
  std::vector<int> pseudoplastic;
};

std::vector<Around> look_around(const Network& network, const Structure& structure) {
  std::vector<Around> around(structure.kind.size());
  const auto touch = [&](const Branch& b) {
    if (b.a == b.b) return;
    ++around[at(b.a)].count;
    ++around[at(b.b)].count;
  };
  for (const Branch& b : structure.deflections) touch(b);
  for (const Branch& b : structure.sliders) touch(b);
  for (const Network::Force& force : network.forces) {
    ++around[at(structure.rigid[at(force.a)])].count;
    if (force.b >= 0) ++around[at(structure.rigid[at(force.b)])].count;
  }
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = structure.rates[at(laws.first) + i];
      touch(b);
      if (b.a == b.b || !(laws.batch->growth(i).exponent < 1)) continue;
      for (const NodeId node : {b.a, b.b}) around[at(node)].pseudoplastic.push_back(laws.first + static_cast<int>(i));
    }
  }
  return around;
}

}  // namespace

std::vector<StopChain> find_stop_chains(const Network& network, const Structure& structure) {
  const std::vector<Around> around = look_around(network, structure);
  const auto heavy = [&](NodeId node) { return structure.kind[at(node)] == Kind::known || structure.kind[at(node)] == Kind::massive; };
  std::vector<char> walked(structure.rates.size(), 0);
  std::vector<StopChain> chains;
  for (NodeId start = 0; at(start) < around.size(); ++start) {
    if (!heavy(start)) continue;
    for (const int first : around[at(start)].pseudoplastic) {
      StopChain chain{start, start, {}};
      for (int next = first; next >= 0 && !std::exchange(walked[at(next)], 1);) {
        const Branch& b = structure.rates[at(next)];
        chain.rates.push_back(next);
        chain.b = b.a == chain.b ? b.b : b.a;
        const Around& end = around[at(chain.b)];
        const bool goes_on = !heavy(chain.b) && end.count == 2 && end.pseudoplastic.size() == 2;
        next = !goes_on ? -1 : end.pseudoplastic[0] == next ? end.pseudoplastic[1] : end.pseudoplastic[0];
      }
      if (!chain.rates.empty() && heavy(chain.b) && chain.a != chain.b) chains.push_back(std::move(chain));
    }
  }
  return chains;
}

}  // namespace rheonet
