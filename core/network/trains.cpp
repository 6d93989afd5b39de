#include "core/network/trains.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/rigid_links.hpp"
#include "core/network/train_shares.hpp"

namespace rheonet {

namespace {

class Trains {
 public:
  Trains(const Network& network, Structure& structure, const Modes* modes)
      : network_(network), s_(structure), modes_(modes), all_slip_(!modes), sets_(joined_by_links(network)), mass_(structure.kind.size(), 0), head_(structure.kind.size(), -1) {
    for (std::size_t n = 0; n < head_.size(); ++n) sets_.join(static_cast<NodeId>(n), s_.rigid[n]);
    for (const NodeId node : network.node_order) {
      const std::size_t set = at(sets_.find(node));
      mass_[set] += s_.mass[at(node)];
      // A known node speaks for its set, otherwise the first one that sliders do not join to another.
      const bool better = head_[set] < 0 || (known(node) && !known(head_[set]));
      if (s_.kind[at(node)] != Kind::joined && better) head_[set] = node;
    }
  }

  void assign() {
    find_train_forces();
    eliminate();
    find_forces();
    find_groups();
    for (const std::set<NodeId>& group : groups_) find_inertia(group);
    for (const Network::Train& train : network_.trains) {
      for (const NodeId node : train.node) {
        Kind& kind = s_.kind[at(node)];
        if (kind != Kind::known && kind != Kind::joined) kind = Kind::massive;
        Kind& of_head = s_.kind[at(head(node))];
        if (of_head == Kind::floating) of_head = Kind::massive;
      }
    }
  }

 private:
  using Row = std::map<NodeId, double>;  ///< factors of the heads of sets

  bool known(NodeId node) const { return s_.kind[at(node)] == Kind::known; }
  NodeId head(NodeId node) { return head_[at(sets_.find(node))]; }
  double mass(NodeId head) { return mass_[at(sets_.find(head))]; }
  const std::string& name(const Network::Train& train) const { return network_.scene->elements[at(train.element)].name; }

  /// The side to which the friction of a train slips; 0 if it sticks, or has none.
  int slips(const Network::Train& train) const {
    return modes_ && train.friction >= 0 && !s_.stuck[at(train.friction)] ? modes_->slider[at(train.friction)] : 0;
  }

  /// The force at each node of a train, for a force 1 that it hands on: losses that slip change it at the first node and at the support.
  void find_train_forces() {
    for (std::size_t k = 0; k < network_.trains.size(); ++k) {
      const Network::Train& train = network_.trains[k];
      s_.train_forces.push_back(train.factor);
      if (slips(train) == 0) continue;
      const double more = train.loss->line(slips(train), modes_->b_drives[k] != 0).factor - 1;
      s_.train_forces.back()[0] += more;
      s_.train_forces.back()[2] -= more;
    }
  }

  /// Brings the equations into reduced row echelon form. The lightest node of each is its pivot. The forces of the trains are eliminated with the
  /// equations: only at a pivot with a force left do the balances of the pivots determine the forces of all trains.
  void eliminate() {
    std::vector<Row> rows, columns;  // factors of the velocities, and forces
    for (std::size_t t = 0; t < network_.trains.size(); ++t) {
      const Network::Train& train = network_.trains[t];
      Row row, forces;
      double largest = 0;
      for (std::size_t k = 0; k < train.node.size(); ++k) {
        if (train.node[k] == ground) continue;
        if (head(train.node[k]) != ground) {
          row[head(train.node[k])] += train.factor[k];
          forces[head(train.node[k])] += s_.train_forces[t][k];
        }
        largest = std::max(largest, std::abs(train.factor[k]));
      }
      for (std::size_t r = 0; r < rows.size(); ++r) {
        subtract(rows[r], s_.train_equations[r].pivot, row);
        subtract(columns[r], s_.train_equations[r].pivot, forces);
      }
      NodeId pivot = -1;
      double least = 0;
      for (const auto& [node, factor] : row) {
        if (known(node) || std::abs(factor) <= numerics::equal_given_values * largest) continue;
        // With an efficiency of 0 the first node does not feel the force of the train.
        const double force = forces[node];
        if (std::abs(force) <= numerics::equal_given_values * largest) continue;
        const double weight = mass(node) / std::abs(factor * force);
        if (pivot >= 0 && weight >= least) continue;
        pivot = node;
        least = weight;
      }
      if (pivot < 0) {
        if (all_slip_) refuse_dependent(train);
        continue;
      }
      for (const auto& [own, others] : {std::pair(&row, &rows), std::pair(&forces, &columns)}) {
        const double divisor = (*own)[pivot];
        for (auto& [node, factor] : *own) factor = std::abs(factor) <= numerics::equal_given_values * largest ? 0 : factor / divisor;
        std::erase_if(*own, [](const auto& term) { return term.second == 0; });
        for (Row& other : *others) subtract(*own, pivot, other);
        others->push_back(std::move(*own));
      }
      s_.train_equations.push_back({pivot, {}, {}, static_cast<int>(t)});
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (const auto& [node, factor] : rows[r]) {
        if (node != s_.train_equations[r].pivot && factor != 0) s_.train_equations[r].terms.push_back({node, factor});
      }
    }
  }

  /// With losses that slip, the balances of the pivots give the forces of the trains by a system of their own, and these go to all other
  /// nodes.
  void find_forces() {
    const bool any = std::any_of(network_.trains.begin(), network_.trains.end(), [&](const Network::Train& train) { return slips(train) != 0; });
    for (Structure::TrainEquation& equation : s_.train_equations) {
      std::copy_if(equation.terms.begin(), equation.terms.end(), std::back_inserter(equation.shares), [&](const Structure::TrainEquation::Term& term) { return !known(term.node); });
    }
    if (!any) return;
    std::set<NodeId> nodes;
    for (const Structure::TrainEquation& equation : s_.train_equations) {
      for (const NodeId node : network_.trains[at(equation.train)].node) {
        if (!known(head(node))) nodes.insert(head(node));
      }
    }
    for (const Structure::TrainEquation& equation : s_.train_equations) nodes.erase(equation.pivot);
    std::vector<NodeId> heads;
    for (std::size_t n = 0; n < head_.size(); ++n) heads.push_back(head(static_cast<NodeId>(n)));
    TrainShares shares(network_, s_.train_equations, heads, {nodes.begin(), nodes.end()});
    const Eigen::MatrixXd& values = shares.take(s_.train_forces);
    const bool vary = std::any_of(network_.sliders.begin(), network_.sliders.end(), [](const Network::Slider& slider) { return slider.train >= 0 && !slider.varying.empty(); });
    for (std::size_t r = 0; r < s_.train_equations.size(); ++r) {
      s_.train_equations[r].shares.clear();
      for (std::size_t i = 0; i < shares.nodes().size(); ++i) {
        const double share = values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(r));
        if (share != 0 || vary) s_.train_equations[r].shares.push_back({shares.nodes()[i], share});
      }
    }
  }

  static void subtract(const Row& row, NodeId pivot, Row& from) {
    const auto found = from.find(pivot);
    if (found == from.end()) return;
    const double times = found->second;
    for (const auto& [node, factor] : row) {
      double& left = from[node];
      const double size = std::max(std::abs(left), std::abs(times * factor));
      left -= times * factor;
      // A term that cancels is left out: a factor of round-off would couple a node that the equation does not move.
      if (std::abs(left) <= numerics::equal_given_values * size) from.erase(node);
    }
    from.erase(pivot);
  }

  [[noreturn]] void refuse_dependent(const Network::Train& train) {
    std::vector<std::string> others;
    bool free = false;
    for (const NodeId node : train.node) free = free || !known(head(node));
    for (const Network::Train& other : network_.trains) {
      if (&other == &train) continue;
      others.push_back(name(other));
    }
    const std::string why = free ? fmt::format("the motion of its nodes follows from {} already: it could only repeat or contradict that",
                                               others.empty() ? "other transmissions" : format_list(others))
                                 : std::string("the motion of all its nodes is given: it could only repeat or contradict that");
    throw SimulationError(network_.spot_of(train.element), fmt::format("transmission `{}` is too many: {}; leave it out{}", name(train), why,
                                                                       free ? "" : ", or leave one of its nodes free"));
  }

  /// Sets of nodes that trains and inerters couple.
  void find_groups() {
    DisjointSets coupled(s_.kind.size());
    std::vector<char> in_train(s_.kind.size(), 0);
    const auto couple = [&](const auto& nodes) {
      NodeId first = -1;
      for (const NodeId node : nodes) {
        const NodeId of_set = head(node);
        if (known(of_set)) continue;
        if (first >= 0) coupled.join(of_set, first);
        first = of_set;
      }
      return first;
    };
    std::vector<NodeId> begins;
    for (const Network::Train& train : network_.trains) begins.push_back(couple(train.node));
    for (const Branch& b : s_.inerters) couple(std::array{b.a, b.b});
    for (const NodeId node : begins) {
      if (node >= 0) in_train[at(coupled.find(node))] = 1;
    }
    std::map<NodeId, std::set<NodeId>> groups;
    const auto add = [&](NodeId node) {
      const NodeId of_set = head(node);
      if (!known(of_set) && in_train[at(coupled.find(of_set))]) groups[coupled.find(of_set)].insert(of_set);
    };
    for (const Network::Train& train : network_.trains) {
      for (const NodeId node : train.node) add(node);
    }
    for (const Branch& b : s_.inerters) {
      add(b.a);
      add(b.b);
    }
    for (auto& [representative, group] : groups) groups_.push_back(std::move(group));
  }

  /// The inertia at each node of a group: the inverse of the diagonal of the inverse of [ M  C' ; C  0 ].
  void find_inertia(const std::set<NodeId>& group) {
    std::map<NodeId, Eigen::Index> place;
    for (const NodeId node : group) place.emplace(node, static_cast<Eigen::Index>(place.size()));
    const auto nodes = static_cast<Eigen::Index>(place.size());
    std::vector<const Structure::TrainEquation*> rows;
    for (const Structure::TrainEquation& equation : s_.train_equations) {
      if (place.contains(equation.pivot)) rows.push_back(&equation);
    }
    const Eigen::Index size = nodes + static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    const auto add = [&](NodeId a, NodeId b, double inertia) {
      const auto i = place.find(head(a)), j = place.find(head(b));
      if (i != place.end()) matrix(i->second, i->second) += inertia;
      if (j == place.end() || head(a) == head(b)) return;
      matrix(j->second, j->second) += inertia;
      if (i == place.end()) return;
      matrix(i->second, j->second) -= inertia;
      matrix(j->second, i->second) -= inertia;
    };
    for (const auto& [node, i] : place) matrix(i, i) += mass(node);
    for (std::size_t k = 0; k < s_.inerters.size(); ++k) add(s_.inerters[k].a, s_.inerters[k].b, network_.inerters[k].inertance);
    const double largest = matrix.topLeftCorner(nodes, nodes).cwiseAbs().maxCoeff();
    if (largest > 0) matrix /= largest;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Eigen::Index row = nodes + static_cast<Eigen::Index>(r);
      const auto put = [&](NodeId node, double factor) {
        const auto i = place.find(node);
        if (i != place.end()) matrix(row, i->second) = matrix(i->second, row) = factor;
      };
      put(rows[r]->pivot, 1);
      for (const auto& [node, factor] : rows[r]->terms) put(node, factor);
    }
    if (all_slip_) check_inertia(matrix, nodes, group);
    const Eigen::MatrixXd inverse = matrix.fullPivLu().inverse();
    for (const NodeId node : group) {
      const double yields = inverse(place.at(node), place.at(node));
      for (std::size_t n = 0; n < head_.size(); ++n) {
        const auto member = static_cast<NodeId>(n);
        if (yields > 0 && head(member) == node && s_.kind[n] != Kind::joined) s_.inertia[n] = std::max(s_.inertia[n], largest / yields);
      }
    }
  }

  /// With 1 for every inertia, the matrix is regular or singular whatever the values.
  void check_inertia(Eigen::MatrixXd matrix, Eigen::Index nodes, const std::set<NodeId>& group) {
    for (Eigen::Index i = 0; i < nodes; ++i) {
      double coupled = 0;
      for (Eigen::Index j = 0; j < nodes; ++j) {
        if (j == i || matrix(i, j) == 0) continue;
        matrix(i, j) = -1;
        ++coupled;
      }
      // Beside inerters within the group, a node has its own mass, or an inerter to a node outside.
      const double own = mass(*std::next(group.begin(), i)) > 0 || leads_out(*std::next(group.begin(), i), group) ? 1 : 0;
      matrix(i, i) = own + coupled;
    }
    if (matrix.fullPivLu().isInvertible()) return;
    std::vector<std::string> trains, light;
    int first = -1;
    for (const Network::Train& train : network_.trains) {
      const bool here = std::any_of(train.node.begin(), train.node.end(), [&](NodeId node) { return group.contains(head(node)); });
      if (!here) continue;
      trains.push_back(name(train));
      if (first < 0) first = train.element;
    }
    for (const NodeId node : group) {
      if (mass(node) == 0) light.push_back(network_.node_name(node));
    }
    throw SimulationError(network_.spot_of(first),
                          fmt::format("too few nodes at transmission{} {} have a mass: with losses, with a support that moves, or in a loop with other elements a "
                                      "transmission determines the motion of one massless node, but here are {}; give {} of them a mass",
                                      trains.size() > 1 ? "s" : "", format_list(trains), format_list(light), light.size() - trains.size() > 1 ? "more" : "one"));
  }

  bool leads_out(NodeId node, const std::set<NodeId>& group) {
    return std::any_of(s_.inerters.begin(), s_.inerters.end(), [&](const Branch& b) {
      return (head(b.a) == node && !group.contains(head(b.b))) || (head(b.b) == node && !group.contains(head(b.a)));
    });
  }

  const Network& network_;
  Structure& s_;
  const Modes* modes_;
  bool all_slip_;
  DisjointSets sets_;                      ///< nodes that rigid links or sticking sliders join
  std::vector<double> mass_;               ///< of each set
  std::vector<NodeId> head_;               ///< of each set: the node that stands for it
  std::vector<std::set<NodeId>> groups_;   ///< heads
};

}  // namespace

void assign_trains(const Network& network, Structure& structure, const Modes* modes) {
  if (!network.trains.empty()) Trains(network, structure, modes).assign();
}

}  // namespace rheonet
