#include "core/dae/event_network.hpp"

#include "core/dae/convex.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

EventNetwork::EventNetwork(const Network& of, const Structure& classified, Inputs& given)
    : network(of), structure(classified), inputs(given), firm_(firm_nodes(of, classified)) {
  std::vector<char> known;
  for (const Kind kind : classified.kind) known.push_back(kind == Kind::known);
  led_by_ = linked_to(of, known);
}

bool EventNetwork::may_stand(int branch) const {
  const Branch& b = network.deflections[at(branch)];
  if (!massless(b.a) && !massless(b.b)) return false;
  std::size_t i = 0;
  return network.batch_of(branch, i).can_hold(i);
}

void EventNetwork::tie_trains(ConvexNetwork& problem, const std::vector<double>& given) const {
  for (std::size_t k = 0; k < network.trains.size(); ++k) {
    const Network::Train& train = network.trains[k];
    problem.tie({slot(train.node[0]), slot(train.node[1]), slot(train.node[2])}, train.factor, given[k]);
  }
}

}  // namespace rheonet
