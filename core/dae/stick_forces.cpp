#include "core/dae/stick_forces.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/base/disjoint_sets.hpp"
#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/train_force_trials.hpp"
#include "core/network/adjacent_elements.hpp"
#include "core/network/overload_report.hpp"
#include "core/network/transmission.hpp"

namespace rheonet {

namespace {

/// Trains whose forces are open: those without an equation of their own, as it follows from others, and all that share a node with such a train.
std::vector<char> open_trains(const Network& network, const Structure& structure) {
  std::vector<char> open(network.trains.size(), 1);
  for (const Structure::TrainEquation& equation : structure.train_equations) open[at(equation.train)] = 0;
  DisjointSets together(structure.kind.size());
  const auto first_free = [&](const Network::Train& train) {
    NodeId first = -1;
    for (const NodeId node : train.node) {
      const NodeId head = structure.rigid[at(node)];
      if (structure.kind[at(head)] == Kind::known) continue;
      if (first >= 0) together.join(first, head);
      first = head;
    }
    return first;
  };
  std::vector<NodeId> first;
  for (const Network::Train& train : network.trains) first.push_back(first_free(train));
  std::vector<char> has_open(structure.kind.size(), 0);
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (open[k] && first[k] >= 0) has_open[at(together.find(first[k]))] = 1;
  }
  for (std::size_t k = 0; k < open.size(); ++k) open[k] = open[k] || (first[k] >= 0 && has_open[at(together.find(first[k]))]);
  return open;
}

double largest(const std::vector<double>& forces) {
  double result = 0;
  for (const double force : forces) result = std::max(result, std::abs(force));
  return result;
}

/// One line of a loss for each direction of slip.
struct LossLines { Loss::Line up, down; };

/// A slider that stands for the losses of a train, and the choices of its lines. `train_force`: index of the train's force in the problem.
struct LossySlider {
  std::size_t slider, train_force;
  const Loss* loss;
  std::vector<LossLines> lines;
};

/// The lines of which the loss to this side is the largest. Where both are below 0, as the bearings of a self-locking gear may help its load, nothing is lost.
std::vector<Loss::Line> lines_of(const Loss& loss, int side) {
  std::vector<Loss::Line> result{loss.line(side, false), loss.line(side, true)};
  const double steeper = result[0].factor - result[1].factor, meet = steeper == 0 ? 0 : (result[1].offset - result[0].offset) / steeper;
  if (side * (result[0].at(meet) - meet) < 0) result.push_back({1, 0});
  return result;
}

/// Without bearings all lines meet in 0: one node drives to one side, the other one to the other.
std::vector<LossLines> lines_of(const Loss& loss) {
  const std::vector<Loss::Line> up = lines_of(loss, 1), down = lines_of(loss, -1);
  if (loss.bearing_a == 0 && loss.bearing_b == 0) return {{up[0], down[1]}, {up[1], down[0]}};
  std::vector<LossLines> result;
  for (const Loss::Line& one : up) {
    for (const Loss::Line& other : down) result.push_back({one, other});
  }
  return result;
}

}  // namespace

// The problem has the nodes that sticking sliders join. It leaves out the leading node of each cluster, as it does known nodes:
// the balance there is the sum of the balances of the other nodes, unless trains with open forces act on the cluster. The rest falls into separate parts.
StickForces::StickForces(const Network& network, const Structure& structure, const Inputs& inputs) : network_(network), structure_(structure), inputs_(inputs) {
  const std::vector<char> locked = open_trains(network, structure);
  std::vector<char> of_open(structure.kind.size(), 0);
  for (std::size_t k = 0; k < locked.size(); ++k) {
    for (const NodeId node : network.trains[k].node) of_open[at(structure.rigid[at(node)])] |= locked[k];
  }
  const auto inner = [&](NodeId node) {
    const NodeId head = structure.rigid[at(node)];
    return structure.kind[at(node)] == Kind::joined || (of_open[at(head)] && structure.kind[at(head)] != Kind::known);
  };
  DisjointSets parts(structure.kind.size());
  std::vector<int> branches_at(structure.kind.size(), 0);
  const auto join = [&](NodeId a, NodeId b) {
    if (inner(a) && inner(b)) parts.join(a, b);
  };
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const auto& [element, a, b] = network.sliders[k].branch;
    if (!structure.stuck[k]) continue;
    join(a, b);
    ++branches_at[at(a)];
    ++branches_at[at(b)];
  }
  for (std::size_t k = 0; k < network.trains.size(); ++k) {
    if (!locked[k]) continue;
    for (const NodeId a : network.trains[k].node) {
      ++branches_at[at(a)];
      for (const NodeId b : network.trains[k].node) join(a, b);
    }
  }
  std::vector<int> part(structure.kind.size(), -1), row(part);  // of each node: its part, and its place there
  std::vector<std::vector<BoxedBranch>> branches;
  const auto part_of = [&](NodeId node) -> std::size_t {
    int& of = part[at(parts.find(node))];
    if (of < 0) {
      of = static_cast<int>(branches.size());
      branches.emplace_back();
      shared_.emplace_back();
    }
    return at(of);
  };
  const auto place = [&](NodeId end) {
    if (!inner(end)) return -1;
    if (row[at(end)] < 0) {
      std::vector<NodeId>& nodes = shared_[part_of(end)].nodes;
      row[at(end)] = static_cast<int>(nodes.size());
      nodes.push_back(end);
    }
    return row[at(end)];
  };
  // The norm is taken of forces in the units of the scene, so that it does not depend on which gears are changes of units.
  const auto unit = [&](int element) { return std::abs(own_unit(Quantity::force, network.scene->elements[at(element)].scale)); };
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Network::Slider& s = network.sliders[k];
    if (!structure.stuck[k]) continue;
    const NodeId a = s.branch.a, b = s.branch.b, node = inner(a) ? a : b;
    if (!(inner(a) && inner(b)) && (!inner(node) || branches_at[at(node)] == 1)) {
      lone_.push_back({k, node, !inner(node) ? 0.0 : node == a ? 1.0 : -1.0});
      continue;
    }
    const std::size_t of = part_of(node);
    const int first = place(a);
    shared_[of].sliders.push_back(k);
    branches[of].push_back({first, place(b), -s.box.backward.breakaway.value, s.box.forward.breakaway.value, unit(s.branch.element)});
  }
  for (std::size_t k = 0; k < network.trains.size(); ++k) {
    const std::array<NodeId, 3>& nodes = network.trains[k].node;
    const auto node = std::find_if(nodes.begin(), nodes.end(), inner);
    if (!locked[k] || node == nodes.end()) continue;
    shared_[part_of(*node)].trains.push_back(k);
    for (const NodeId n : nodes) place(n);
  }
  for (std::size_t k = 0; k < shared_.size(); ++k) {
    Shared& shared = shared_[k];
    shared.load.resize(shared.nodes.size());
    shared.force.resize(shared.sliders.size());
    if (shared.trains.empty()) {
      shared.problem = BoxedForces(static_cast<int>(shared.nodes.size()), std::move(branches[k]));
      continue;
    }
    Eigen::MatrixXd& balance = shared.with_trains.balance;
    balance.setZero(static_cast<Eigen::Index>(shared.nodes.size()), static_cast<Eigen::Index>(shared.sliders.size() + shared.trains.size()));
    Eigen::Index column = 0;
    for (const BoxedBranch& b : branches[k]) {
      if (b.a >= 0) balance(b.a, column) += 1;
      if (b.b >= 0) balance(b.b, column) -= 1;
      shared.with_trains.low.push_back(b.low);
      shared.with_trains.high.push_back(b.high);
      shared.with_trains.unit.push_back(b.unit);
      ++column;
    }
    for (const std::size_t train : shared.trains) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (const int n = row[at(network.trains[train].node[i])]; n >= 0) balance(n, column) += structure.train_forces[train][i];
      }
      shared.with_trains.low.push_back(-std::numeric_limits<double>::infinity());
      shared.with_trains.high.push_back(std::numeric_limits<double>::infinity());
      shared.with_trains.unit.push_back(unit(network.trains[train].element));
      ++column;
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(balance.rows(), balance.cols());
    factors.setThreshold(numerics::equal_values);
    factors.compute(balance * Eigen::Map<const Eigen::VectorXd>(shared.with_trains.unit.data(), balance.cols()).cwiseInverse().asDiagonal());
    const Eigen::MatrixXd all = factors.householderQ() * Eigen::MatrixXd::Identity(balance.rows(), balance.rows());
    shared.accelerated = all.rightCols(balance.rows() - factors.rank());
  }
}

void StickForces::solve(double t, const std::vector<double>& others, std::vector<double>& force, std::vector<double>& train_force) {
  std::vector<double> left = others;
  for (const Shared& shared : shared_) {
    for (const std::size_t train : shared.trains) {
      for (std::size_t i = 0; i < 3; ++i) left[at(network_.trains[train].node[i])] -= structure_.train_forces[train][i] * train_force[train];
    }
  }
  for (const auto& [slider, node, side] : lone_) force[slider] = side == 0 ? 0 : -side * left[at(node)];
  for (Shared& shared : shared_) {
    double sum = 0;
    for (std::size_t n = 0; n < shared.nodes.size(); ++n) sum += shared.load[n] = -left[at(shared.nodes[n])];
    if (!std::isfinite(sum)) {  // the integrator tries too long a step: it rejects states that are not finite
      for (const std::size_t k : shared.sliders) force[k] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    // The load that accelerates all these nodes together is 0 but for the error of their accelerations, which no sticking force can hold.
    if (shared.accelerated.cols() > 0) {
      Eigen::Map<Eigen::VectorXd> load(shared.load.data(), shared.accelerated.rows());
      load -= shared.accelerated * (shared.accelerated.transpose() * load);
    }
    for (std::size_t i = 0; i < shared.sliders.size(); ++i) {
      const std::size_t k = shared.sliders[i];
      const Box& box = inputs_.box(k);
      if (network_.sliders[k].varying.empty() && !network_.sliders[k].contact && network_.sliders[k].train < 0) continue;
      shared.bound(i, -box.backward.breakaway.value, box.forward.breakaway.value);
    }
    if (!(lossy(shared) ? solve_with_losses(t, shared, train_force) : shared.solve())) report_unbalanced(t, shared);
    for (std::size_t k = 0; k < shared.sliders.size(); ++k) force[shared.sliders[k]] = shared.force[k];
    for (std::size_t k = 0; k < shared.trains.size(); ++k) train_force[shared.trains[k]] = shared.force[shared.sliders.size() + k];
  }
}

bool StickForces::lossy(const Shared& shared) const {
  return std::any_of(shared.sliders.begin(), shared.sliders.end(), [&](std::size_t k) { return network_.sliders[k].train >= 0; });
}

/// Forces of least norm among all that the losses hold, or that the least widening of all bounds lets them hold. To each side the loss is the larger of two lines over the force of the train, one
/// for each node that may drive. With one line chosen for each loss and side the problem is convex, and the least norm of all choices
/// is that of the whole. False if there are too many choices. `found`: the forces of the trains that sliders do not lock.
bool StickForces::share_within_losses(Shared& shared, const std::vector<double>& found) const {
  std::vector<LossySlider> lossy;
  std::size_t choices = 1;
  for (std::size_t i = 0; i < shared.sliders.size(); ++i) {
    if (network_.sliders[shared.sliders[i]].train < 0) continue;
    const std::size_t train = at(network_.sliders[shared.sliders[i]].train);
    const Loss& loss = inputs_.loss(train);
    const auto of = std::find(shared.trains.begin(), shared.trains.end(), train);
    if (of == shared.trains.end()) {
      shared.bound(i, -loss.lost(-1, found[train]), loss.lost(1, found[train]));
      continue;
    }
    lossy.push_back({i, shared.sliders.size() + static_cast<std::size_t>(of - shared.trains.begin()), &loss, lines_of(loss)});
    choices *= lossy.back().lines.size();
    if (choices > static_cast<std::size_t>(numerics::loss_choices)) return false;
  }
  if (lossy.empty()) return shared.solve();
  LeastNorm& problem = shared.with_trains;
  std::vector<double> force;
  double least = std::numeric_limits<double>::infinity(), narrowest = least;
  for (std::size_t choice = 0; choice < choices; ++choice) {
    problem.following.clear();
    std::size_t left = choice;
    for (const LossySlider& l : lossy) {
      const LossLines& lines = l.lines[left % l.lines.size()];
      left /= l.lines.size();
      shared.bound(l.slider, lines.down.offset, lines.up.offset);
      problem.following.push_back({l.slider, l.train_force, 1 - lines.down.factor, lines.up.factor - 1});
    }
    double wider = 0, norm = 0;
    if (!problem.solve_widened(shared.load, force, wider)) continue;
    for (std::size_t k = 0; k < force.size(); ++k) norm += std::pow(problem.unit[k] * force[k], 2);
    // Beyond the bounds, choices that differ by round-off alone count as equal.
    const double roundoff = numerics::balance_roundoff * largest(force);
    if (wider > narrowest + roundoff || (wider >= narrowest - roundoff && norm >= least)) continue;
    narrowest = std::min(narrowest, wider);
    least = norm;
    shared.force = force;
  }
  problem.following.clear();
  if (std::isinf(least)) return false;
  // Their bounds may be small beside the load, and met within its round-off.
  for (const LossySlider& l : lossy) shared.bound(l.slider, -l.loss->lost(-1, shared.force[l.train_force]), l.loss->lost(1, shared.force[l.train_force]));
  shared.meet_bounds(numerics::balance_roundoff * largest(shared.load));
  return true;
}

/// Forces within bounds that follow from the forces of the trains. Where the losses have too many choices of lines, the forces of
/// trains are tried until their bounds fit. `found`: the forces of the trains that sliders do not lock.
bool StickForces::solve_with_losses(double t, Shared& shared, std::vector<double> found) const {
  if (share_within_losses(shared, found)) return true;
  const auto bounds = [&](const std::vector<double>* forces) {
    for (std::size_t i = 0; i < shared.sliders.size(); ++i) {
      const int train = network_.sliders[shared.sliders[i]].train;
      if (train < 0) continue;
      const auto most = [&](int side) { return forces ? inputs_.loss(at(train)).lost(side, (*forces)[at(train)]) : std::numeric_limits<double>::infinity(); };
      shared.bound(i, -most(-1), most(1));
    }
  };
  const auto solve = [&] {
    if (!shared.solve()) return false;
    for (std::size_t k = 0; k < shared.trains.size(); ++k) found[shared.trains[k]] = shared.force[shared.sliders.size() + k];
    return true;
  };
  bounds(nullptr);
  if (!solve()) return false;
  const double size = largest(shared.load);
  // Absent if no trials agree.
  const auto follow = [&](TrainForceTrials trials) -> std::optional<bool> {
    while (!trials.endless()) {
      const std::vector<double> trial = trials.trial();
      bounds(&trial);
      if (!solve()) return false;
      if (!trials.agree(found)) continue;
      // The losses that follow from these forces differ from those of the trial by round-off, which small ones may not hold.
      bounds(&found);
      shared.meet_bounds(numerics::balance_roundoff * size);
      return true;
    }
    return {};
  };
  if (const auto done = follow({network_, inputs_, found, size})) return *done;
  for (TrainForceTrials& trials : TrainForceTrials::around(network_, inputs_, size)) {
    if (const auto done = follow(std::move(trials))) return *done;
  }
  report_losses(network_, at_time(*network_.scene, t));
}

void StickForces::Shared::bound(std::size_t slider, double low, double high) {
  if (trains.empty()) return problem.bound(slider, low, high);
  with_trains.low[slider] = low;
  with_trains.high[slider] = high;
}

/// Where forces of trains decide on bounds, a force beyond its bound is moved towards it by `roundoff`, at most onto it. It stays continuous in time, so that
/// its guard does not flicker.
void StickForces::Shared::meet_bounds(double roundoff) {
  for (std::size_t k = 0; !trains.empty() && k < sliders.size(); ++k) {
    const double within = std::clamp(force[k], with_trains.low[k], with_trains.high[k]);
    const double beyond = force[k] - within;
    force[k] = within + std::copysign(std::max(0.0, std::abs(beyond) - roundoff), beyond);
  }
}

bool StickForces::Shared::solve() {
  return trains.empty() ? problem.solve(load, force) != BoxedForces::Outcome::failed : with_trains.solve(load, force);
}

void StickForces::report_unbalanced(double t, const Shared& shared) const {
  std::string what;
  Spot where;
  std::vector<NodeId> nodes = shared.nodes;
  if (shared.trains.empty() && shared.problem.failed_node() >= 0) nodes = {shared.nodes[at(shared.problem.failed_node())]};
  if (!shared.trains.empty() || shared.problem.failed_node() >= 0) {
    std::vector<std::string> names;
    for (const NodeId node : nodes) names.push_back(network_.node_name(node));
    where = network_.spot_of_node(nodes[0]);
    what = fmt::format("the forces at {} cannot be balanced: the bounds of {}", format_list(names), format_list(elements_at(network_, nodes)));
  } else {
    const Branch& b = network_.sliders[shared.sliders[at(shared.problem.failed_branch())]].branch;
    where = network_.spot_of(b.element);
    what = fmt::format("the force of `{}`, which sticks beside other sliders, is not the one of least norm: the bounds of {}",
                       network_.name_of(b), format_list(elements_at(network_, {b.a, b.b})));
  }
  throw SimulationError(where, fmt::format("{} {} may lie too far apart for double precision; check them", at_time(*network_.scene, t), what));
}

}  // namespace rheonet
