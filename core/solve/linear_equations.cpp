#include "core/solve/linear_equations.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
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

/// By Taylor's series, for a short time.
Propagator short_propagator(const MatrixXd& A, const TimeFunctions& functions, double tau) {
  const MatrixXd one = MatrixXd::Identity(A.rows(), A.cols()), none = MatrixXd::Zero(A.rows(), A.cols());
  // `coefficient(n)`: that of tau^n of a function, times tau^n.
  const auto series = [&](const MatrixXd& begin, auto coefficient) {
    MatrixXd term = begin, sum = none;
    for (int n = 0; n < numerics::arc_terms; ++n) {
      term = (A * term + coefficient(n) * one) * (tau / (n + 1));
      sum += term;
    }
    return sum;
  };
  Propagator p{.change = series(one, [](int) { return 0.0; }), .response = {}};
  const std::array<double, 3> powers{1, tau, tau * tau / 2};
  for (int k = 0; k <= functions.degree; ++k) p.response.push_back(series(none, [&](int n) { return n == k ? powers[at(k)] : 0.0; }));
  for (const double omega : functions.omegas) {
    for (const bool cosine : {false, true}) {
      double power = 1;  // (omega tau)^n/n!
      p.response.push_back(series(none, [&](int n) {
        if (n > 0) power *= omega * tau / n;
        if ((n % 2 == 0) != cosine) return 0.0;
        return n % 4 < 2 ? power : -power;
      }));
    }
  }
  return p;
}

/// At twice the time tau.
Propagator doubled(const Propagator& p, const TimeFunctions& functions, double tau) {
  Propagator twice{.change = p.change * p.change + 2 * p.change, .response = {}};
  for (const MatrixXd& response : p.response) twice.response.push_back(p.change * response + 2 * response);
  // The functions in the second half, by those in the first.
  if (functions.degree >= 1) twice.response[1] += tau * p.response[0];
  if (functions.degree == 2) twice.response[2] += tau * p.response[1] + tau * tau / 2 * p.response[0];
  std::size_t k = at(functions.degree) + 1;
  for (const double omega : functions.omegas) {
    const double sine = std::sin(omega * tau), half = std::sin(omega * tau / 2), less = -2 * half * half;  // the cosine less 1
    twice.response[k] += less * p.response[k] + sine * p.response[k + 1];
    twice.response[k + 1] += less * p.response[k + 1] - sine * p.response[k];
    k += 2;
  }
  return twice;
}

/// Makes the norms of each row and its column alike by powers of 2 (E. E. Osborne 1960). What takes no part in any loop, as the position of a
/// mass without a spring, is scaled until it changes at a rate of the loops, or at `slowest` [1/s]. Returns the scales of the states.
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

/// The inverse, with rows and columns scaled by powers of 2, as their units differ by decades. Empty if there is none.
MatrixXd scaled_inverse(const MatrixXd& matrix) {
  const Index n = matrix.rows();
  VectorXd rows = VectorXd::Ones(n), columns = VectorXd::Ones(n);
  const auto level = [](double most) { return most > 0 && std::isfinite(most) ? std::exp2(-std::round(std::log2(most))) : 1; };
  for (int round = 0; round < numerics::arc_scalings; ++round) {
    for (Index i = 0; i < n; ++i) rows(i) *= level((rows(i) * matrix.row(i) * columns.asDiagonal()).cwiseAbs().maxCoeff());
    for (Index i = 0; i < n; ++i) columns(i) *= level((rows.asDiagonal() * matrix.col(i) * columns(i)).cwiseAbs().maxCoeff());
  }
  const Eigen::FullPivLU<MatrixXd> factors(MatrixXd(rows.asDiagonal() * matrix * columns.asDiagonal()));
  if (!factors.isInvertible()) return {};
  return columns.asDiagonal() * factors.inverse() * rows.asDiagonal();
}

}  // namespace

LinearEquations::LinearEquations(const Dae& dae, MatrixXd K, MatrixXd both, double interval) : K_(std::move(K)), both_(std::move(both)) { eliminate(dae, 1 / interval); }

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
  const MatrixXd K = K_(rows, Eigen::all);
  A_ = -K * of_states_;
  L_ = -K * of_given_;
  for (std::size_t k = 0; k < rows.size(); ++k) L_(static_cast<Index>(k), rows[k]) += 1;
  const VectorXd scale = balance(A_, slowest);
  of_states_ = of_states_ * scale.asDiagonal();
  L_ = scale.cwiseInverse().asDiagonal() * L_;
  regular_ = A_.allFinite() && L_.allFinite() && of_states_.allFinite() && of_given_.allFinite();
  if (regular_ && A_.rows() > 0) fastest_decay_ = std::max(0.0, -A_.eigenvalues().real().minCoeff());
}

double LinearEquations::length(int level) const { return std::ldexp(shortest_, level); }

void LinearEquations::respond_to(const TimeFunctions& functions, double interval) {
  const double fastest = std::max(A_.size() == 0 ? 0 : A_.cwiseAbs().colwise().sum().maxCoeff(), functions.fastest());
  const double slow_enough = fastest > 0 ? numerics::arc_shortest / fastest : std::numeric_limits<double>::infinity();
  const bool fits = shortest_ <= interval && (shortest_ == slow_enough || interval <= length(numerics::arc_levels));
  if (!levels_.empty() && functions_ == functions && fits) return;
  functions_ = functions;
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
  const Index r = A_.rows(), count = functions_.count();
  level.states.resize(StepNodes::last * r, (count + 1) * r);
  level.functions.resize(count, StepNodes::last + 1);
  for (int i = 0; i <= StepNodes::last; ++i) {
    const double tau = step_nodes().place(i) * of_step;
    level.functions.col(i) = functions_.at(tau);
    if (i == 0) continue;
    Propagator& p = level.at_node[at(i) - 1];
    p = half ? doubled(half->at_node[at(i) - 1], functions_, tau / 2) : short_propagator(A_, functions_, tau);
    auto rows = level.states.middleRows((i - 1) * r, r);
    rows.leftCols(r) = p.change + MatrixXd::Identity(r, r);
    for (Index j = 0; j < count; ++j) rows.middleCols((j + 1) * r, r) = p.response[at(static_cast<int>(j))];
  }
  return level;
}

}  // namespace rheonet
