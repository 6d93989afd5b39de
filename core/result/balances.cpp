#include "core/result/balances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/component.hpp"
#include "core/network/linear_law.hpp"
#include "core/network/network.hpp"
#include "core/network/transmission.hpp"

namespace rheonet {

namespace {

/// Both ends of an element. An `at` element has its node twice.
std::pair<NodeId, NodeId> nodes_of(const SceneElement& element) { return {element.a, element.at ? element.a : element.b}; }

/// Flags the nodes whose motion follows from forces alone: without mass or motion, and not ground.
std::vector<char> massless_nodes(const Scene& scene) {
  std::vector<char> massless(scene.nodes.size(), 1);
  massless[at(ground)] = 0;
  for (const SceneElement& element : scene.elements) {
    const Component* component = law_of(scene, element).component;
    if (component && (component->role == Role::mass || component->role == Role::motion)) massless[at(element.a)] = 0;
    if (!component || (component->role != Role::inerter && component->role != Role::train)) continue;
    for_each_node(element, [&](NodeId node) { massless[at(node)] = 0; });
  }
  return massless;
}

/// Calls visit(record, its index, node) for each node that a record refers to.
template <class Visit>
void visit_nodes(const Scene& scene, Visit visit) {
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    for_each_operand(scene, scene.records[k], [&](const Record& record) {
    const auto both = [&](std::pair<NodeId, NodeId> ends) {
      visit(record, k, ends.first);
      if (ends.second != ends.first) visit(record, k, ends.second);
    };
    switch (record.subject) {
      case Record::Subject::node:
        visit(record, k, record.index);
        break;
      case Record::Subject::element:
        both(nodes_of(scene.elements[at(record.index)]));
        break;
      case Record::Subject::assembly:
        if (record.channel == Record::Channel::force) {
          for (const SceneAssembly::Term& term : scene.assemblies[at(record.index)].force) both(nodes_of(scene.elements[at(term.element)]));
        } else {
          both({scene.assemblies[at(record.index)].a, scene.assemblies[at(record.index)].b});
        }
        break;
      case Record::Subject::block:
      case Record::Subject::expression:
        break;
    }
    });
  }
}

}  // namespace

Balances::Balances(const Scene& scene) : scene_(scene), asked_(scene.records.size()) { find_nodes(scene); }

void Balances::find_nodes(const Scene& scene) {
  const std::vector<char> massless = massless_nodes(scene);
  std::map<NodeId, std::size_t> place;
  visit_nodes(scene, [&](const Record& record, std::size_t k, NodeId id) {
    if (!massless[at(id)]) return;
    const auto [found, fresh] = place.try_emplace(id, nodes_.size());
    if (fresh) nodes_.push_back({id, {}, {}, {}});
    Node& node = nodes_[found->second];
    // The imbalance is an error of this force itself; of other records it is the same share of their scale.
    const bool itself = record.channel == Record::Channel::force && scene.records[k].subject != Record::Subject::expression;
    std::vector<std::size_t>& records = itself ? node.forces : node.movements;
    if (records.empty() || records.back() != k) records.push_back(k);
  });
  std::map<int, std::size_t> force_of;  // index of an element to that of its record
  for (std::size_t k = 0; k < asked_; ++k) {
    const Record& record = scene.records[k];
    if (record.subject == Record::Subject::element && record.channel == Record::Channel::force) force_of.insert({record.index, k});
  }
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    const Component* component = law_of(scene, element).component;
    if (!component || component->role == Role::block || component->role == Role::nothing || component->role == Role::train) continue;
    // An applied force pushes its node; the force of any other element pulls its first end back.
    const double sign = component->role == Role::force ? -1 : 1;
    const auto meet = [&](NodeId id, double s) {
      const auto found = place.find(id);
      if (found == place.end()) return;
      const auto [record, fresh] = force_of.try_emplace(static_cast<int>(e), scene_.records.size());
      if (fresh) {
        scene_.records.push_back({.path = element.name + ".force", .subject = Record::Subject::element,
                                  .index = static_cast<int>(e), .channel = Record::Channel::force});
      }
      nodes_[found->second].terms.push_back({record->second, s / scene_.records[record->second].factor});
    };
    meet(element.a, sign);
    if (!element.at) meet(element.b, -sign);
  }
}

std::vector<Balances::Sum> Balances::sums(const RowStore& rows, double allowed, const std::vector<RecordError>& errors) const {
  std::vector<Sum> sums(nodes_.size());
  if (nodes_.empty()) return sums;
  RowStore::Reader first = rows.read();
  while (const double* const row = first.next()) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      for (const Term& term : nodes_[n].terms) sums[n].largest_force = std::max(sums[n].largest_force, std::abs(term.sign * row[1 + term.record]));
    }
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) sums[n].beyond.assign(nodes_[n].forces.size() + nodes_[n].movements.size(), not_given);
  RowStore::Reader second = rows.read();
  while (const double* const row = second.next()) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const Node& node = nodes_[n];
      Sum& sum = sums[n];
      double left = 0;
      for (const Term& term : node.terms) left += term.sign * row[1 + term.record];
      left = std::abs(left);
      const double rounding = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon() * sum.largest_force;
      if (left <= rounding) continue;
      for (std::size_t k = 0; k < sum.beyond.size(); ++k) {
        const bool force = k < node.forces.size();
        const double limit = force ? allowed * errors[node.forces[k]].scale / own(node.forces[k]) : allowed * sum.largest_force;
        if (std::isnan(sum.beyond[k]) && left > limit) sum.beyond[k] = row[0];
      }
      if (left <= sum.largest) continue;
      sum.largest = left;
      sum.time = row[0];
    }
  }
  return sums;
}

std::optional<Imbalance> Balances::raise(const RowStore& rows, double allowed, std::vector<RecordError>& errors) const {
  std::optional<Imbalance> worst;
  double most = allowed;
  const std::vector<Sum> all = sums(rows, allowed, errors);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const Sum& sum = all[n];
    if (sum.largest == 0) continue;
    for (std::size_t k = 0; k < sum.beyond.size(); ++k) {
      const bool force = k < node.forces.size();
      RecordError& error = errors[force ? node.forces[k] : node.movements[k - node.forces.size()]];
      const double off = force ? sum.largest * own(node.forces[k]) : sum.largest / sum.largest_force * error.scale;
      const double dead_band = numerics::sizeless_record * allowed * sum.largest_force * (force ? own(node.forces[k]) : 1);
      const bool sizeless = off > error.scale / 2 && std::max(off, error.scale) <= dead_band;
      if (off <= error.largest || (force && sizeless)) continue;
      error.beyond = std::fmin(error.beyond, sum.beyond[k]);
      error.largest = off;
      error.time = sum.time;
      if (error.relative() <= most) continue;
      most = error.relative();
      const SceneNode& place = scene_.nodes[at(node.id)];
      const double newton = own_unit(Quantity::force, std::abs(place.scale));
      worst = {place.name, node.id, {}, sum.largest * newton, sum.largest_force * newton, sum.time};
      for (const Term& term : node.terms) worst->elements.push_back(scene_.elements[at(scene_.records[term.record].index)].name);
    }
  }
  return worst;
}

std::string describe(const Scene& scene, const Imbalance& imbalance) {
  return fmt::format("the forces of {} at node `{}` sum to {}, {:.2g} of the largest of them, {}", format_list(imbalance.elements),
                     imbalance.node, fmt::format("{:.6g} {}", imbalance.sum, unit_of(Quantity::force, domain_of(scene, scene.nodes[at(imbalance.id)]))), imbalance.sum / imbalance.largest,
                     at_time(scene, imbalance.time - scene.start));
}

}  // namespace rheonet
