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

std::optional<Imbalance> Balances::raise(const Trajectory& trajectory, double allowed, std::vector<RecordError>& errors) const {
  std::optional<Imbalance> worst;
  double most = allowed;
  for (const Node& node : nodes_) {
    double largest = 0, sum = 0, time = 0;
    for (const std::vector<double>& row : trajectory.rows) {
      for (const Term& term : node.terms) largest = std::max(largest, std::abs(term.sign * row[term.record]));
    }
    const double rounding = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon() * largest;
    // The largest imbalance, and the first time at which it exceeds the limit of each record.
    std::vector<double> first(node.forces.size() + node.movements.size(), not_given);
    // The sum is in common units, the error of a record in its own unit.
    const auto own = [&](std::size_t record) { return std::abs(scene_.records[record].factor); };
    const auto allows = [&](std::size_t i) {
      return i < node.forces.size() ? allowed * errors[node.forces[i]].scale / own(node.forces[i]) : allowed * largest;
    };
    for (std::size_t i = 0; i < trajectory.rows.size(); ++i) {
      double left = 0;
      for (const Term& term : node.terms) left += term.sign * trajectory.rows[i][term.record];
      left = std::abs(left);
      if (left <= rounding) continue;
      for (std::size_t k = 0; k < first.size(); ++k) {
        if (std::isnan(first[k]) && left > allows(k)) first[k] = trajectory.times[i];
      }
      if (left <= sum) continue;
      sum = left;
      time = trajectory.times[i];
    }
    if (sum == 0) continue;
    for (std::size_t k = 0; k < first.size(); ++k) {
      const bool force = k < node.forces.size();
      RecordError& error = errors[force ? node.forces[k] : node.movements[k - node.forces.size()]];
      const double off = force ? sum * own(node.forces[k]) : sum / largest * error.scale;
      const bool sizeless = off > error.scale / 2 && std::max(off, error.scale) <= numerics::sizeless_record * allowed * largest * (force ? own(node.forces[k]) : 1);
      if (off <= error.largest || (force && sizeless)) continue;
      error.beyond = std::fmin(error.beyond, first[k]);
      error.largest = off;
      error.time = time;
      if (error.relative() <= most) continue;
      most = error.relative();
      worst = {scene_.nodes[at(node.id)].name, node.id, {}, sum * own_unit(Quantity::force, std::abs(scene_.nodes[at(node.id)].scale)), largest * own_unit(Quantity::force, std::abs(scene_.nodes[at(node.id)].scale)), time};
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
