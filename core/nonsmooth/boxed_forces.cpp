#include "core/nonsmooth/boxed_forces.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/nonsmooth/conductances.hpp"

namespace rheonet {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace

struct BoxedForces::Factors : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> {};

namespace {

double conductance_of(const BoxedBranch& b) { return 1 / (b.unit * b.unit); }

/// The Laplacian matrix of the conductances along the branches.
Eigen::SparseMatrix<double> laplacian(const std::vector<BoxedBranch>& branches, int nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const BoxedBranch& b : branches) {
    const double c = conductance_of(b);
    if (b.a >= 0) entries.emplace_back(b.a, b.a, c);
    if (b.b >= 0) entries.emplace_back(b.b, b.b, c);
    if (b.a < 0 || b.b < 0) continue;
    entries.emplace_back(b.a, b.b, -c);
    entries.emplace_back(b.b, b.a, -c);
  }
  Eigen::SparseMatrix<double> matrix(nodes, nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

BoxedForces::BoxedForces(int nodes, std::vector<BoxedBranch> branches) : branches_(std::move(branches)) {
  difference_.assign(branches_.size(), 0);
  along_ = difference_;
  for (const BoxedBranch& b : branches_) ends_.push_back({at(b.a < 0 ? nodes : b.a), at(b.b < 0 ? nodes : b.b)});
  phi_.assign(at(nodes) + 1, 0);
  direction_ = left_ = magnitude_ = phi_;
  terms_.assign(at(nodes), 1);  // its load
  for (const BoxedBranch& b : branches_) {
    if (b.a >= 0) ++terms_[at(b.a)];
    if (b.b >= 0) ++terms_[at(b.b)];
  }
  held_.assign(at(nodes), 0);
  open_.assign(branches_.size(), 1);
  if (nodes == 0) return;
  factors_ = std::make_unique<Factors>();
  factors_->compute(laplacian(branches_, nodes));
}

BoxedForces::BoxedForces(BoxedForces&&) noexcept = default;
BoxedForces& BoxedForces::operator=(BoxedForces&&) noexcept = default;
BoxedForces::~BoxedForces() = default;

double BoxedForces::conductance(std::size_t k) const { return conductance_of(branches_[k]); }

double BoxedForces::force_at(std::size_t k, double step) const {
  return std::clamp(difference_[k] + step * along_[k], branches_[k].low, branches_[k].high);
}

BoxedForces::Outcome BoxedForces::solve(const std::vector<double>& load, std::vector<double>& force) {
  cuts_.clear();
  failed_branch_ = -1;
  if (without_bounds(load, force)) return Outcome::within;
  std::fill(open_.begin(), open_.end(), 1);
  difference_ = force;
  std::vector<double> open_load = load;  // minus the forces of the branches of overloaded cuts
  const std::size_t most = numerics::least_norm_steps + numerics::least_norm_steps_a_branch * branches_.size();
  for (std::size_t step = 0; step < most; ++step) {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      if (open_[k]) force[k] = force_at(k, 0);
    }
    if (balanced(load, force)) return !of_least_norm(force) ? Outcome::failed : cuts_.empty() ? Outcome::within : Outcome::beyond;
    find_direction();
    const double least = minimum_along();
    // Without a minimum along the direction, some cut's load reaches the capacity of the cut, except for round-off.
    const bool bounded = std::isfinite(least);
    if (const auto cut = CutSearch(branches_, open_, held_, open_load).along(direction_, bounded ? numerics::overloaded_cut_gap : 0)) {
      give_way(*cut, open_load, force);
    } else if (bounded) {
      move(least);
    } else {
      break;
    }
  }
  if (!balanced_to_largest(load, force) || !of_least_norm(force)) return Outcome::failed;
  return cuts_.empty() ? Outcome::within : Outcome::beyond;
}

/// Computes the forces of least norm without bounds. Returns true if they lie in their boxes: they are then the answer.
/// Iterative refinement with the same factors recovers the digits that differences of large potentials lose.
bool BoxedForces::without_bounds(const std::vector<double>& load, std::vector<double>& force) {
  std::fill(held_.begin(), held_.end(), 0);
  std::fill(force.begin(), force.end(), 0.0);
  std::fill(phi_.begin(), phi_.end(), 0.0);
  grain_ = 0;
  if (!factors_) return false;
  std::copy(load.begin(), load.end(), left_.begin());
  const auto nodes = static_cast<Eigen::Index>(load.size());
  for (int solved = 0; solved <= numerics::refinements; ++solved) {
    Eigen::Map<Eigen::VectorXd>(direction_.data(), nodes) = factors_->solve(Eigen::Map<const Eigen::VectorXd>(left_.data(), nodes));
    for (std::size_t n = 0; n < load.size(); ++n) {
      phi_[n] += direction_[n];
      grain_ = std::max(grain_, eps * std::abs(phi_[n]));
    }
    bool within = true;
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      force[k] += conductance(k) * difference(k, direction_);
      within = within && branches_[k].low <= force[k] && force[k] <= branches_[k].high;
    }
    if (!within) return false;
    if (balanced(load, force)) return true;
  }
  return false;
}

/// Round-off of the sum of the forces at a node [N].
double BoxedForces::round_off(std::size_t n) const {
  return std::max((terms_[n] + 1) * eps * magnitude_[n], std::numeric_limits<double>::min());
}

bool BoxedForces::balanced(const std::vector<double>& load, const std::vector<double>& force) {
  for (std::size_t n = 0; n < load.size(); ++n) {
    left_[n] = load[n];
    magnitude_[n] = std::abs(load[n]);
  }
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const auto [a, b] = ends_[k];
    const double f = force[k], size = std::abs(f);
    left_[a] -= f;
    left_[b] += f;
    magnitude_[a] += size;
    magnitude_[b] += size;
  }
  // Round-off at this node may exceed the imbalance of other nodes: set it to 0.
  failed_node_ = -1;
  for (std::size_t n = 0; n < load.size(); ++n) {
    if (held_[n] || std::abs(left_[n]) <= round_off(n)) {
      left_[n] = 0;
    } else {
      failed_node_ = static_cast<int>(n);
    }
  }
  return failed_node_ < 0;
}

/// The same, but to the round-off of the largest force of all: where potentials of that size leave almost no force at a node, their
/// difference has no better round-off. Call after `balanced`.
bool BoxedForces::balanced_to_largest(const std::vector<double>& load, const std::vector<double>& force) {
  double largest = 0;
  for (const std::vector<double>* list : {&load, &force}) {
    for (const double f : *list) largest = std::max(largest, std::abs(f));
  }
  for (std::size_t n = 0; n < load.size(); ++n) {
    if (!held_[n] && !(std::abs(left_[n]) <= (terms_[n] + 1) * eps * largest)) return false;
  }
  failed_node_ = -1;
  return true;
}

/// Newton's direction for the present active set. Branches within their boxes connect nodes into parts. Parts without a held
/// node move first, each as a whole, as if the branches between them were within their boxes. Once all parts balance, nodes
/// within parts move. Scaled to a length of about 1, because products of forces might overflow.
void BoxedForces::find_direction() {
  const int nodes = static_cast<int>(held_.size());
  DisjointSets parts(held_.size() + 1);  // the last member stands for held nodes
  const auto slot = [&](int node) { return node < 0 || held_[at(node)] ? nodes : node; };
  const auto within = [&](std::size_t k) { return branches_[k].low < difference_[k] && difference_[k] < branches_[k].high; };
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    if (open_[k] && within(k)) parts.join(slot(branches_[k].a), slot(branches_[k].b));
  }
  const int firm = parts.find(nodes);
  // The node with the largest terms takes the imbalance of its part.
  std::vector<int> taking(held_.size() + 1, -1);
  for (int n = 0; n < nodes; ++n) {
    int& most = taking[at(parts.find(n))];
    if (parts.find(n) != firm && (most < 0 || magnitude_[at(n)] > magnitude_[at(most)])) most = n;
  }
  const auto inner = [&](int node) { return slot(node) == nodes || taking[at(parts.find(node))] == node ? -1 : node; };
  const auto part = [&](int node) { return parts.find(slot(node)) == firm ? -1 : parts.find(node); };
  std::vector<double> sum(held_.size() + 1, 0), rounding(sum);
  bool inside = false;
  for (int n = 0; n < nodes; ++n) {
    sum[at(parts.find(n))] += left_[at(n)];
    rounding[at(parts.find(n))] += round_off(at(n));
    inside = inside || (inner(n) >= 0 && left_[at(n)] != 0);
  }
  for (int n = 0; n < nodes; ++n) inside = inside && (part(n) != n || std::abs(sum[at(n)]) <= rounding[at(n)]);
  std::vector<Conductance> open;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(nodes);
  const auto unknown = [&](int node) { return inside ? inner(node) : part(node); };
  for (int n = 0; n < nodes; ++n) {
    if (unknown(n) >= 0) d[unknown(n)] += left_[at(n)];
    if (unknown(n) != n) open.push_back({n, -1, 1});
  }
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const int a = unknown(branches_[k].a), b = unknown(branches_[k].b);
    if (open_[k] && within(k) == inside) open.push_back({a, b, conductance(k)});
  }
  solve_conductances(open, d);
  const double length = std::ldexp(1, std::ilogb(d.cwiseAbs().maxCoeff()));
  for (int n = 0; n < nodes; ++n) direction_[at(n)] = unknown(n) < 0 ? 0 : d[unknown(n)] / length;
  for (std::size_t k = 0; k < branches_.size(); ++k) along_[k] = open_[k] ? conductance(k) * difference(k, direction_) : 0;
}

/// Slope of the dual along the direction; it increases with the step.
double BoxedForces::slope_at(double step) const {
  double slope = 0;
  for (std::size_t n = 0; n < held_.size(); ++n) slope -= left_[n] * direction_[n];
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    if (along_[k] != 0) slope += (force_at(k, step) - force_at(k, 0)) * (along_[k] / conductance(k));
  }
  return slope;
}

/// The step to the minimum of the dual along the direction; infinite if the slope stays negative.
double BoxedForces::minimum_along() const {
  std::vector<double> breaks;
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    for (const double bound : {branches_[k].low, branches_[k].high}) {
      const double step = (bound - difference_[k]) / along_[k];
      if (along_[k] != 0 && step > 0 && std::isfinite(step)) breaks.push_back(step);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  const auto first = std::partition_point(breaks.begin(), breaks.end(), [&](double step) { return slope_at(step) < 0; });
  const double low = first == breaks.begin() ? 0 : *(first - 1);
  const double inside = first == breaks.end() ? 2 * low + 1 : (low + *first) / 2;
  double curvature = 0;
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const double u = difference_[k] + inside * along_[k];
    if (branches_[k].low < u && u < branches_[k].high) curvature += along_[k] * (along_[k] / conductance(k));
  }
  if (curvature == 0) return first == breaks.end() ? std::numeric_limits<double>::infinity() : *first;
  const double step = low - slope_at(low) / curvature;
  return first == breaks.end() ? step : std::min(step, *first);
}

void BoxedForces::move(double step) {
  double largest = 0;
  for (std::size_t n = 0; n < held_.size(); ++n) {
    phi_[n] += step * direction_[n];
    largest = std::max({largest, std::abs(phi_[n]), std::abs(step * direction_[n])});
  }
  for (std::size_t k = 0; k < branches_.size(); ++k) difference_[k] += step * along_[k];
  grain_ += eps * largest;
}

/// Lets the branches of the cut carry the load of its nodes, each beyond its bound by the same share (by the same force if
/// all bounds are 0, in the units of the norm). Subtracts their forces from `load`.
void BoxedForces::give_way(const OverloadedCut& cut, std::vector<double>& load, std::vector<double>& force) {
  const auto bound = [&](int k) {
    const BoxedBranch& b = branches_[at(k)];
    const bool from = b.a >= 0 && cut.inside[at(b.a)];
    return from == (cut.side > 0) ? b.high : b.low;
  };
  const auto outward = [&](int k) {
    const BoxedBranch& b = branches_[at(k)];
    return b.a >= 0 && cut.inside[at(b.a)] ? cut.side : -cut.side;
  };
  double capacity = 0, equal = 0;
  for (const int k : cut.branches) {
    capacity += std::abs(bound(k));
    equal += 1 / branches_[at(k)].unit;
  }
  for (const int k : cut.branches) {
    const double share = capacity > 0 ? std::abs(bound(k)) / capacity : 1 / (branches_[at(k)].unit * equal);
    force[at(k)] = bound(k) + outward(k) * share * cut.excess;
    open_[at(k)] = 0;
    if (branches_[at(k)].a >= 0) load[at(branches_[at(k)].a)] -= force[at(k)];
    if (branches_[at(k)].b >= 0) load[at(branches_[at(k)].b)] += force[at(k)];
  }
  // No branch holds the set now, and it balances as a whole: drop the balance of one node, the one with the largest terms.
  int heaviest = -1;
  for (std::size_t n = 0; n < load.size(); ++n) {
    if (cut.inside[n] && (heaviest < 0 || magnitude_[n] > magnitude_[at(heaviest)])) heaviest = static_cast<int>(n);
  }
  held_[at(heaviest)] = 1;
  if (cut.beyond) cuts_.push_back(cut);
}

/// Whether every force is the potential difference clamped to its box, but for round-off.
bool BoxedForces::of_least_norm(const std::vector<double>& force) {
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const BoxedBranch& b = branches_[k];
    const double c = conductance(k);
    if (!open_[k] || std::abs(force[k] - std::clamp(c * difference(k, phi_), b.low, b.high)) <= numerics::roundings_of_a_step * c * grain_) continue;
    failed_branch_ = static_cast<int>(k);
    return false;
  }
  return true;
}

}  // namespace rheonet
