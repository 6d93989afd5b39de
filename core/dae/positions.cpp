#include "core/dae/positions.hpp"

#include <variant>

#include "core/base/index.hpp"

namespace rheonet {

namespace {

class PositionFinder {
 public:
  PositionFinder(const Network& network, const Structure& structure, const std::vector<char>& needed)
      : network_(network), structure_(structure), needed_(needed), tight_(network.nodes()), stuck_(tight_.size()),
        beside_(tight_.size()), tied_(tight_.size()), reached_(tight_.size(), 0) {
    result_.of.assign(tight_.size(), {});
    list_neighbours();
  }

  Positions find() {
    begin();
    spread();
    for (NodeId node : network_.node_order) {
      integrate_neighbours();
      if (needed_[at(node)] && !reached_[at(node)]) integrate(node, ground);
    }
    integrate_neighbours();
    put_in_order();
    return std::move(result_);
  }

 private:
  void list_neighbours() {
    const auto list = [](std::vector<std::vector<int>>& at_node, const Branch& b, int index) {
      at_node[at(b.a)].push_back(index);
      at_node[at(b.b)].push_back(index);
    };
    const auto meet = [&](const Branch& b) {
      beside_[at(b.a)].push_back(b.b);
      beside_[at(b.b)].push_back(b.a);
    };
    for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const int j = laws.first + static_cast<int>(i);
        const Branch& b = network_.deflections[at(j)];
        if (laws.batch->creeps(i)) meet(b); else list(tight_, b, j);
      }
    }
    for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
      const Branch& b = network_.sliders[k].branch;
      meet(b);
      if (structure_.stuck[k] && needed_[at(b.a)] && needed_[at(b.b)]) list(stuck_, b, static_cast<int>(k));
    }
    for (const Branch& b : network_.rates) meet(b);
    for (std::size_t r = 0; r < structure_.train_equations.size(); ++r) {
      for (const NodeId node : nodes_of(structure_.train_equations[r])) tied_[at(node)].push_back(static_cast<int>(r));
    }
  }

  static std::vector<NodeId> nodes_of(const Structure::TrainEquation& equation) {
    std::vector<NodeId> nodes{equation.pivot};
    for (const Structure::TrainEquation::Term& term : equation.terms) nodes.push_back(term.node);
    return nodes;
  }

  bool follows_time(NodeId node) const { return structure_.kind[at(node)] == Kind::known && structure_.of_time[at(node)]; }

  /// The node of a train whose position follows from those of the others, all of which are reached. Beside positions that are functions of
  /// time only one: of two that are integrated, the sum might be small beside their errors. -1 if there is none.
  NodeId last_of(int equation, NodeId& parent) const {
    NodeId last = -1;
    parent = ground;
    for (const NodeId node : nodes_of(structure_.train_equations[at(equation)])) {
      if (!reached_[at(node)]) {
        if (last >= 0 || structure_.kind[at(node)] == Kind::known || !needed_[at(node)]) return -1;
        last = node;
      } else if (!follows_time(node)) {
        if (parent != ground || !needed_[at(node)]) return -1;
        parent = node;
      }
    }
    return last;
  }

  /// Starts from known nodes, and from nodes whose position is an unknown of its own.
  void begin() {
    for (NodeId node : network_.node_order) {
      if (structure_.kind[at(node)] != Kind::known) continue;
      if (structure_.of_time[at(node)]) reach(node);
      else integrate_alone(node);
    }
    // Locked trains, whose equations have no other node.
    for (std::size_t r = 0; r < structure_.train_equations.size(); ++r) {
      NodeId parent = ground;
      const NodeId last = last_of(static_cast<int>(r), parent);
      if (last < 0) continue;
      result_.of[at(last)] = {.train_equation = static_cast<int>(r), .parent = parent};
      reach(last);
    }
    for (const Blocks::Sensor& sensor : network_.blocks.sensors) {
      const bool of_position = sensor.what == Blocks::Sensor::What::position && sensor.motion < 0;
      if (of_position && !result_.of[at(sensor.index)].integrated) integrate_alone(sensor.index);
    }
  }

  void integrate_alone(NodeId node) {
    result_.of[at(node)] = {.integrated = true};  // a slider that sticks may have reached it
    result_.integrated.push_back(node);
    if (!reached_[at(node)]) reach(node);
  }

  void integrate(NodeId node, NodeId parent) {
    result_.of[at(node)] = {.parent = parent, .integrated = true};
    result_.integrated.push_back(node);
    reach(node);
    spread();
  }

  /// Nodes joined by sticking sliders move as one, and those of a train in a ratio: no deflection comes between.
  void reach(NodeId node) {
    reached_[at(node)] = 1;
    order_.push_back(node);
    for (std::size_t k = order_.size() - 1; k < order_.size(); ++k) {
      const NodeId from = order_[k];
      for (int slider : stuck_[at(from)]) {
        const Branch& b = network_.sliders[at(slider)].branch;
        const NodeId other = b.a == from ? b.b : b.a;
        if (reached_[at(other)] || structure_.kind[at(other)] == Kind::known) continue;
        reached_[at(other)] = 1;
        result_.of[at(other)] = {.sign = b.a == other ? 1.0 : -1.0, .slider = slider, .parent = from};
        order_.push_back(other);
      }
      for (const int equation : tied_[at(from)]) {
        NodeId parent = ground;
        const NodeId last = last_of(equation, parent);
        if (last < 0) continue;
        reached_[at(last)] = 1;
        result_.of[at(last)] = {.train_equation = equation, .parent = parent};
        order_.push_back(last);
      }
    }
  }

  void spread() {
    for (; spread_ < order_.size(); ++spread_) {
      const NodeId node = order_[spread_];
      for (int j : tight_[at(node)]) {
        const Branch& b = network_.deflections[at(j)];
        const NodeId other = b.a == node ? b.b : b.a;
        if (reached_[at(other)]) continue;
        if (isolated(node, other)) {
          integrate_alone(other);
          continue;
        }
        result_.of[at(other)] = {.sign = b.a == other ? 1.0 : -1.0, .branch = j, .parent = node};
        reach(other);
      }
    }
  }

  /// The motion of a mass may be small beside the motion that drives it, as on a soft spring. The difference between that motion and a
  /// deflection would have the errors of both, so the position of the mass is integrated.
  bool isolated(NodeId moving, NodeId mass) const {
    const int m = structure_.motion[at(moving)];
    return needed_[at(mass)] && structure_.kind[at(mass)] == Kind::massive && m >= 0 && moves(network_.motions[at(m)]);
  }

  static bool moves(const Network::Motion& motion) {
    const auto* constant = std::get_if<Signal::Constant>(&motion.signal.shape());
    return motion.block >= 0 || !constant || (!motion.position && constant->value != 0);
  }

  void integrate_neighbours() {
    for (; looked_ < order_.size(); ++looked_) {
      const NodeId node = order_[looked_];
      for (NodeId other : beside_[at(node)]) {
        if (needed_[at(other)] && !reached_[at(other)]) integrate(other, node);
      }
    }
  }

  void put_in_order() {
    std::vector<char> wanted(needed_.size(), 0);
    for (std::size_t n = 0; n < needed_.size(); ++n) {
      if (!needed_[n]) continue;
      for (auto node = static_cast<NodeId>(n); !wanted[at(node)]; node = result_.of[at(node)].parent) wanted[at(node)] = 1;
    }
    for (NodeId node : order_) {
      if (wanted[at(node)]) result_.order.push_back(node);
    }
  }

  const Network& network_;
  const Structure& structure_;
  const std::vector<char>& needed_;
  std::vector<std::vector<int>> tight_, stuck_;   // at each node: branches whose deflection is their displacement; sliders
  std::vector<std::vector<NodeId>> beside_;       // neighbours across creep, sliders and rate laws
  std::vector<std::vector<int>> tied_;            // at each node: equations of trains
  std::vector<char> reached_;
  std::vector<NodeId> order_;
  std::size_t spread_ = 0, looked_ = 0;           // positions in order_
  Positions result_;
};

}  // namespace

Positions find_positions(const Network& network, const Structure& structure, const std::vector<char>& needed) {
  return PositionFinder(network, structure, needed).find();
}

}  // namespace rheonet
