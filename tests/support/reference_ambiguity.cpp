// Forces at rest that no balance determines.
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tests/support/reference_step.hpp"

namespace rheonet::test {

/// With gears: whether the equations of the gears and of the elements at rest are linearly dependent.
bool ReferenceNetwork::open_at_rest() const {
  if (gears_.empty()) return false;
  std::vector<Eigen::VectorXd> rows;
  const auto add = [&](auto terms) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(node_of_.size()));
    for (const auto& [node, factor] : terms) {
      if (unknown_[at(node)] >= 0) row[unknown_[at(node)]] += factor;
    }
    rows.push_back(row);
  };
  for (const Gear& gear : gears_) {
    std::vector<std::pair<NodeId, double>> terms;
    for (std::size_t e = 0; e < 3; ++e) terms.emplace_back(gear.node[e], gear.factor[e]);
    add(terms);
  }
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    // Friction that grows with a force may jam, or slip, in one and the same state.
    if (!bundles_[k].set_valued() || (!losses() && std::abs(points_[k].step) > still_)) continue;
    if (unknown_[at(bundles_[k].a)] < 0 && unknown_[at(bundles_[k].b)] < 0) continue;
    add(std::vector<std::pair<NodeId, double>>{{bundles_[k].a, 1}, {bundles_[k].b, -1}});
  }
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(node_of_.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = rows[r];
  return matrix.fullPivLu().rank() < matrix.rows();
}

/// Bundles at rest that form a loop (prescribed nodes count as one) can carry any force around it. A cfm there goes on to
/// relax from its own.
void ReferenceNetwork::note_ambiguity() {
  ambiguous_ = false;
  bool loop = false, relaxing = false;
  std::vector<std::size_t> part(nodes_.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto root = [&](NodeId node) {
    std::size_t n = nodes_[at(node)].prescribed ? 0 : at(node);
    while (part[n] != n) n = part[n];
    return n;
  };
  for (std::size_t k = 0; k < bundles_.size(); ++k) {
    const ReferenceBundle& b = bundles_[k];
    // Where several solutions fit, the one found may leave some a little beside rest.
    if (std::abs(points_[k].step) > still_ || !b.set_valued()) continue;
    const std::size_t i = root(b.a), j = root(b.b);
    const bool cfms = std::none_of(b.members().begin(), b.members().end(), [](const ReferenceBundle::Member& m) {
      return m.law.rigid();
    });
    const bool given = unknown_[at(b.a)] < 0 && unknown_[at(b.b)] < 0;
    if (b.ambiguous_at_rest()) ambiguous_ = true;
    if (i == j && !(cfms && given)) loop = true;
    if (b.relaxing() && !given) relaxing = true;
    part[i] = j;
  }
  loop = loop || open_at_rest();
  ambiguous_ = ambiguous_ || loop;
  forked_ = forked_ || (loop && (relaxing || losses()));
}

}  // namespace rheonet::test
