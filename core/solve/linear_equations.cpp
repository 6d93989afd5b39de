#include "core/solve/linear_equations.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

StepNodes::StepNodes() {
  for (int i = 0; i <= last; ++i) {
    const bool end = i == 0 || i == last;
    const double sign = i % 2 == 0 ? 1 : -1, angle = std::numbers::pi * i / last;
    place(i) = i == last ? 1 : (1 - std::cos(angle)) / 2;
    barycentric_(i) = end ? sign / 2 : sign;
    highest(i) = barycentric_(i) / last;
    second_highest(i) = barycentric_(i) * std::cos(angle) * 2 / last;
  }
}

StepNodes::Shares StepNodes::at(double share) const {
  Shares shares;
  for (int k = 0; k <= last; ++k) {
    const double apart = share - place(k);
    if (apart == 0) return Shares::Unit(k);
    shares(k) = barycentric_(k) / apart;
  }
  return shares / shares.sum();
}

const StepNodes& step_nodes() {
  static const StepNodes nodes;
  return nodes;
}

namespace {

using Propagator = LinearEquations::Propagator;

/// 1, A tau, (A tau)^2, ...
std::vector<MatrixXd> powers_of(const MatrixXd& A, double tau) {
  std::vector<MatrixXd> powers{MatrixXd::Identity(A.rows(), A.cols())};
  for (int n = 1; n <= numerics::arc_terms; ++n) powers.push_back(powers.back() * A * tau);
  return powers;
}

/// By Taylor's series, after a share of the short time tau of the powers. The response to tau^m/m! is the sum of A^n tau^(n + m + 1)/(n + m + 1)!.
Propagator short_propagator(const std::vector<MatrixXd>& powers, const TimeFunctions& functions, const std::vector<Index>& pushed, double tau, double share) {
  constexpr int terms = numerics::arc_terms;
  std::array<double, 2 * terms + 2> shares;  // share^n/n!
  shares[0] = 1;
  for (std::size_t n = 1; n < shares.size(); ++n) shares[n] = shares[n - 1] * share / static_cast<double>(n);
  Propagator p{.change = MatrixXd::Zero(powers[0].rows(), powers[0].cols()), .response = {}};
  for (int n = 1; n <= terms; ++n) p.change += shares[at(n)] * powers[at(n)];
  // `coefficient(m)`: that of the time to the power m, over m!, times tau^m.
  const auto response_to = [&](auto coefficient) {
    MatrixXd sum = MatrixXd::Zero(powers[0].rows(), static_cast<Index>(pushed.size()));
    for (int n = 0; n < terms; ++n) {
      double factor = 0;
      for (int m = 0; m < terms; ++m) factor += coefficient(m) * shares[at(n + m + 1)];
      sum += tau * factor * powers[at(n)](Eigen::all, pushed);
    }
    p.response.push_back(std::move(sum));
  };
  for (int k = 0; k <= functions.degree; ++k) response_to([&](int m) { return m == k ? std::pow(tau, k) : 0.0; });
  for (const double omega : functions.omegas) {
    for (const bool cosine : {false, true}) {
      response_to([&](int m) { return (m % 2 == 0) != cosine ? 0.0 : (m % 4 < 2 ? 1 : -1) * std::pow(omega * tau, m); });
    }
  }
  return p;
}

/// At twice the time tau.
Propagator doubled(const Propagator& p, const TimeFunctions& functions, double tau) {
  Propagator twice{.change = p.change * p.change + 2 * p.change, .response = {}};
  for (const MatrixXd& response : p.response) twice.response.push_back(p.change * response + 2 * response);
  // The functions in the second half, by those in the first.
  double power = 1;  // tau^n/n!
  for (int n = 1; n <= functions.degree; ++n) {
    power *= tau / n;
    for (int k = n; k <= functions.degree; ++k) twice.response[at(k)] += power * p.response[at(k - n)];
  }
  std::size_t k = at(functions.degree) + 1;
  for (const double omega : functions.omegas) {
    const double sine = std::sin(omega * tau), half = std::sin(omega * tau / 2), less = -2 * half * half;  // the cosine less 1
    twice.response[k] += less * p.response[k] + sine * p.response[k + 1];
    twice.response[k + 1] += less * p.response[k + 1] - sine * p.response[k];
    k += 2;
  }
  return twice;
}

/// Makes the norms of each row and its column alike by powers of 2 (E. E. Osborne 1960). A state that acts on no other, or on which no other
/// acts, has no such norm: the position of a mass without a spring, for instance. It is scaled until its rate is that of the others, or
/// `slowest` [1/s]. Returns the scales of the states.
VectorXd balance(MatrixXd& A, double slowest) {
  VectorXd scale = VectorXd::Ones(A.rows());
  if (A.size() == 0) return scale;
  const double rate = std::max(slowest, A.cwiseAbs().cwiseSqrt().cwiseProduct(A.cwiseAbs().cwiseSqrt().transpose()).maxCoeff());
  for (bool more = true; std::exchange(more, false);) {
    for (Index i = 0; i < A.rows(); ++i) {
      const double own = std::abs(A(i, i)), column = A.col(i).cwiseAbs().sum() - own, row = A.row(i).cwiseAbs().sum() - own;
      if (!(column > 0) && !(row > 0)) continue;
      double by = 1;
      if (column > 0 && row > 0) by = std::exp2(std::round(std::log2(row / column) / 2));
      else if (row > rate) by = std::exp2(std::ceil(std::log2(row / rate)));
      else if (column > rate) by = std::exp2(-std::ceil(std::log2(column / rate)));
      if (column * by + row / by >= numerics::arc_balance * (column + row)) continue;
      A.col(i) *= by;
      A.row(i) /= by;
      scale(i) *= by;
      more = true;
    }
  }
  return scale;
}

/// The inverse, with rows and columns scaled by powers of 2, as their units differ by decades. Empty if there is none. One round of iterative
/// refinement makes each equation right to the round-off of its own terms (R. D. Skeel 1980): the force of a stiff spring in series with soft
/// ones, for instance, whose deflection alone would be a small difference of theirs. It is left out where it would not converge.
MatrixXd scaled_inverse(const MatrixXd& matrix) {
  const Index n = matrix.rows();
  VectorXd rows = VectorXd::Ones(n), columns = VectorXd::Ones(n);
  const auto level = [](double most) { return most > 0 && std::isfinite(most) ? std::exp2(-std::round(std::log2(most))) : 1; };
  for (int round = 0; round < numerics::arc_scalings; ++round) {
    for (Index i = 0; i < n; ++i) rows(i) *= level((rows(i) * matrix.row(i) * columns.asDiagonal()).cwiseAbs().maxCoeff());
    for (Index i = 0; i < n; ++i) columns(i) *= level((rows.asDiagonal() * matrix.col(i) * columns(i)).cwiseAbs().maxCoeff());
  }
  const MatrixXd scaled = rows.asDiagonal() * matrix * columns.asDiagonal();
  const Eigen::FullPivLU<MatrixXd> factors(scaled);
  if (!factors.isInvertible()) return {};
  MatrixXd inverse = factors.inverse();
  const MatrixXd residual = MatrixXd::Identity(n, n) - scaled * inverse;
  if (residual.cwiseAbs().colwise().sum().maxCoeff() < 1) inverse += inverse * residual;
  return columns.asDiagonal() * inverse * rows.asDiagonal();
}

}  // namespace

LinearEquations::LinearEquations(const Dae& dae, MatrixXd K, MatrixXd both, TimeFunctions functions, double interval)
    : K_(std::move(K)), both_(std::move(both)), functions_(std::move(functions)), interval_(interval) { eliminate(dae, 1 / interval); }

void LinearEquations::eliminate(const Dae& dae, double slowest) {
  const Index n = K_.rows();
  const MatrixXd S = scaled_inverse(both_);
  if (S.size() == 0) return;
  std::vector<Index> rows;
  for (Index i = 0; i < n; ++i) {
    if (dae.differential(static_cast<int>(i))) rows.push_back(i);
  }
  of_states_ = S(Eigen::all, rows);
  of_given_ = S;
  of_given_(Eigen::all, rows).setZero();
  MatrixXd by(of_states_.cols(), 2 * n);  // z' = by [d; h]
  by << -K_(rows, Eigen::all), MatrixXd::Identity(n, n)(rows, Eigen::all);
  A_ = by.leftCols(n) * of_states_;
  const VectorXd scale = balance(A_, slowest);
  of_states_ = of_states_ * scale.asDiagonal();
  by = scale.cwiseInverse().asDiagonal() * by;
  groups_ = separate_time_scales(A_, by, of_states_, slowest);
  L_ = by.leftCols(n) * of_given_ + by.rightCols(n);
  regular_ = A_.allFinite() && L_.allFinite() && of_states_.allFinite() && of_given_.allFinite();
}

double LinearEquations::norm() const { return A_.size() == 0 ? 0 : A_.cwiseAbs().colwise().sum().maxCoeff(); }

bool LinearEquations::too_stiff(double interval) {
  if (functions_.fastest() * interval > numerics::arc_steps) return true;
  if (norm() * interval <= numerics::arc_decays) return false;
  if (!extremes_) {
    extremes_.emplace();
    for (const StateGroup& group : groups_) {
      // Eigenvalues are the diagonal of the real Schur form, but for its blocks of two, which have a complex pair.
      const MatrixXd T = Eigen::RealSchur<MatrixXd>(A_(group, group), false).matrixT();
      double fastest = 0, slowest = std::numeric_limits<double>::infinity(), decay = 0;
      for (Index i = 0, rows = 1; i < T.rows(); i += rows) {
        rows = i + 1 < T.rows() && T(i + 1, i) != 0 ? 2 : 1;
        const auto block = T.block(i, i, rows, rows);
        const double rate = rows == 1 ? std::abs(block(0, 0)) : std::sqrt(std::abs(block(0, 0) * block(1, 1) - block(0, 1) * block(1, 0)));
        fastest = std::max(fastest, rate);
        slowest = std::min(slowest, rate);
        decay = std::max(decay, -block.trace() / static_cast<double>(rows));
      }
      extremes_->fastest = std::max(extremes_->fastest, fastest);
      if (fastest > numerics::arc_gap * numerics::arc_gap * slowest) extremes_->mixed_decay = std::max(extremes_->mixed_decay, decay);
    }
  }
  return extremes_->fastest * interval > numerics::arc_steps || extremes_->mixed_decay * interval > numerics::arc_decays;
}

VectorXd LinearEquations::drive(const VectorXd& z, const MatrixXd& pushes) const {
  VectorXd both(z.size() + static_cast<Index>(pushed_.size()) * pushes.cols());
  both << z, pushes(pushed_, Eigen::all).reshaped();
  return both;
}

double LinearEquations::length(int level) const { return std::ldexp(shortest_, level); }

void LinearEquations::respond_to(const MatrixXd& h, double interval) {
  const VectorXd most = L_.cwiseAbs() * h.cwiseAbs().rowwise().sum();
  std::vector<Index> pushed;
  for (Index i = 0; i < most.size(); ++i) {
    if (most(i) > 0) pushed.push_back(i);
  }
  const double fastest = std::max(norm(), functions_.fastest());
  const double slow_enough = fastest > 0 ? numerics::arc_shortest / fastest : std::numeric_limits<double>::infinity();
  const bool fits = shortest_ <= interval && (shortest_ == slow_enough || interval <= length(numerics::arc_levels));
  if (!levels_.empty() && fits && std::includes(pushed_.begin(), pushed_.end(), pushed.begin(), pushed.end())) return;
  StateGroup either;
  std::set_union(pushed_.begin(), pushed_.end(), pushed.begin(), pushed.end(), std::back_inserter(either));
  pushed_ = std::move(either);
  levels_.clear();
  // A power of 2, so that another interval seldom asks for another length.
  shortest_ = std::min(slow_enough, std::exp2(std::floor(std::log2(interval))));
}

const LinearEquations::Level& LinearEquations::level(int k) {
  if (levels_.empty()) levels_.push_back(make_level(shortest_, nullptr));
  while (static_cast<int>(levels_.size()) <= k) levels_.push_back(make_level(length(static_cast<int>(levels_.size())), &levels_.back()));
  return levels_[at(k)];
}

/// By Taylor's series, or by doubling steps of half the length.
LinearEquations::Level LinearEquations::make_level(double of_step, const Level* half) const {
  Level level;
  const Index r = A_.rows(), b = static_cast<Index>(pushed_.size()), count = functions_.count();
  level.states = MatrixXd::Zero(StepNodes::count * r, r + count * b);
  level.functions.resize(count, StepNodes::count);
  std::vector<MatrixXd> powers;
  if (!half) powers = powers_of(A_, of_step);
  for (int i = 0; i <= StepNodes::last; ++i) {
    const double share = step_nodes().place(i), tau = share * of_step;
    level.functions.col(i) = functions_.at(tau);
    Eigen::Map<MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>> rows(level.states.data() + i, r, level.states.cols(), {level.states.rows(), StepNodes::count});
    rows.leftCols(r) = MatrixXd::Identity(r, r);
    if (i == 0) continue;
    Propagator& p = level.at_node[at(i) - 1];
    p = half ? doubled(half->at_node[at(i) - 1], functions_, tau / 2) : short_propagator(powers, functions_, pushed_, of_step, share);
    rows.leftCols(r) += p.change;
    for (Index j = 0; j < count; ++j) rows.middleCols(r + j * b, b) = p.response[at(static_cast<int>(j))];
  }
  level.largest_states.resize(r, level.states.cols());
  for (Index k = 0; k < r; ++k) level.largest_states.row(k) = level.states.middleRows(k * StepNodes::count, StepNodes::count).cwiseAbs().colwise().maxCoeff();
  level.largest_functions = level.functions.cwiseAbs().rowwise().maxCoeff();
  return level;
}

}  // namespace rheonet
