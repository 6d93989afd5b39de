#include "core/network/linear_network.hpp"

#include <algorithm>

#include "core/base/index.hpp"

namespace rheonet {

LinearNetwork::LinearNetwork(const Scene& scene, const std::vector<int>& kind, const std::vector<Law>& laws, const std::vector<char>& stays,
                     const std::vector<char>& alone)
    : count_(scene.elements.size()), kind_(kind), stays_(stays), alone_(alone), law_(laws), share_(count_), at_(scene.nodes.size()),
      degree_(scene.nodes.size(), 0), gone_(scene.nodes.size(), 0) {
  for (std::size_t e = 0; e < count_; ++e) {
    const SceneElement& element = scene.elements[e];
    a_.push_back(element.a);
    b_.push_back(element.at ? element.a : element.b);
    home_.push_back(e);
    parent_.push_back(e);
    at_[at(element.a)].push_back(e);
    ++degree_[at(element.a)];
    if (element.at || element.a == element.b) continue;
    at_[at(element.b)].push_back(e);
    ++degree_[at(element.b)];
  }
}

void LinearNetwork::merge_all() {
  for (std::size_t e = 0; e < count_; ++e) {
    if (linear(e)) put(e);
  }
  for (std::size_t n = 1; n < at_.size(); ++n) queue_.push_back(static_cast<NodeId>(n));
  for (std::size_t k = 0; k < queue_.size(); ++k) merge_at(queue_[k]);
}

LinearNetwork::Key LinearNetwork::key(std::size_t id) const {
  const auto [low, high] = std::minmax(a_[id], b_[id]);
  return static_cast<Key>(low) << 32 | static_cast<Key>(high);
}

/// Merges an element with those in parallel until none is left.
void LinearNetwork::put(std::size_t id) {
  if (alone_[home_[id]]) return;
  auto& between = between_[kind_[home_[id]] - 1];
  while (true) {
    const auto [there, fresh] = between.try_emplace(key(id), id);
    if (fresh || there->second == id) return;
    const std::size_t other = there->second;
    between.erase(there);
    id = parallel(other, id);
  }
}

void LinearNetwork::merge_at(NodeId node) {
  if (degree_[at(node)] != 2 || stays_[at(node)] || gone_[at(node)]) return;
  std::vector<std::size_t> here;
  for (std::size_t e : at_[at(node)]) {
    Share share;
    e = find(e, share);
    if ((a_[e] == node || b_[e] == node) && std::find(here.begin(), here.end(), e) == here.end()) here.push_back(e);
  }
  if (here.size() != 2) return;
  const auto [one, other] = std::pair(here[0], here[1]);
  if (!linear(one) || kind_[home_[one]] != kind_[home_[other]] || alone_[home_[one]] || alone_[home_[other]]) return;
  const NodeId end = a_[one] == node ? b_[one] : a_[one];
  if (end == (a_[other] == node ? b_[other] : a_[other])) return;
  put(series(one, other, node));
}

std::size_t LinearNetwork::series(std::size_t first, std::size_t second, NodeId node) {
  auto& between = between_[kind_[home_[first]] - 1];
  between.erase(key(first));
  between.erase(key(second));
  const bool forward = b_[first] == node;
  const double s = forward == (a_[second] == node) ? 1 : -1;
  const NodeId end = a_[second] == node ? b_[second] : a_[second];
  const auto [K1, R1] = law_[first];
  const auto [K2, R2] = law_[second];
  const Law law{1 / (1 / K1 + 1 / K2), R1 + s * R2};
  const double P1 = law.K / K1, P2 = s * law.K / K2;
  gone_[at(node)] = 1;
  degree_[at(node)] = 0;
  const std::size_t id = stand_for(first, second, forward ? a_[first] : end, forward ? end : b_[first], law,
                                   {.P = P1, .Q = R1 - P1 * law.R, .G = 1, .H = 0}, {.P = P2, .Q = R2 - P2 * law.R, .G = s, .H = 0});
  at_[at(end)].push_back(id);
  return id;
}

std::size_t LinearNetwork::parallel(std::size_t first, std::size_t second) {
  const double s = a_[first] == a_[second] ? 1 : -1;
  const auto [K1, R1] = law_[first];
  const auto [K2, R2] = law_[second];
  const double K = K1 + K2;
  const Law law{K, (K1 * R1 + s * K2 * R2) / K};
  for (const NodeId node : {a_[first], b_[first]}) {
    if (--degree_[at(node)] == 2) queue_.push_back(node);
  }
  return stand_for(first, second, a_[first], b_[first], law, {.P = 1, .Q = 0, .G = K1 / K, .H = K1 * (law.R - R1)},
                   {.P = s, .Q = 0, .G = s * K2 / K, .H = K2 * (s * law.R - R2)});
}

std::size_t LinearNetwork::stand_for(std::size_t first, std::size_t second, NodeId a, NodeId b, const Law& law, const Share& of_first,
                                 const Share& of_second) {
  const std::size_t id = parent_.size();
  parent_.push_back(id);
  share_.emplace_back();
  a_.push_back(a);
  b_.push_back(b);
  law_.push_back(law);
  home_.push_back(std::min(home_[first], home_[second]));
  parent_[first] = parent_[second] = id;
  share_[first] = of_first;
  share_[second] = of_second;
  return id;
}

std::size_t LinearNetwork::find(std::size_t element, Share& share) {
  std::vector<std::size_t> path;
  std::size_t root = element;
  for (; parent_[root] != root; root = parent_[root]) path.push_back(root);
  // From the root down, so that the share of each element refers to the root.
  for (std::size_t k = path.size(); k-- > 0;) {
    const std::size_t id = path[k], above = parent_[id];
    if (above == root) continue;
    const Share up = share_[above];
    Share& own = share_[id];
    own = {.P = own.P * up.P, .Q = own.P * up.Q + own.Q, .G = own.G * up.G, .H = own.G * up.H + own.H};
    parent_[id] = root;
  }
  share = share_[element];
  return root;
}

}  // namespace rheonet
