#include "core/solve/time_scales.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/numerics.hpp"

namespace rheonet {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Repeats X = next(X) from 0 until it stays the same to round-off. Nothing if it does not come to that.
template <class Next>
std::optional<MatrixXd> fixed_point(std::size_t rows, std::size_t columns, Next next) {
  constexpr double round_off = numerics::arc_ulps * std::numeric_limits<double>::epsilon();
  MatrixXd X = MatrixXd::Zero(static_cast<Index>(rows), static_cast<Index>(columns));
  bool near = false;
  for (int round = 0; round < numerics::arc_gap_rounds; ++round) {
    MatrixXd better = next(X);
    if (!better.allFinite()) return {};
    const auto change = (better - X).cwiseAbs();
    near = change.maxCoeff() <= round_off * better.cwiseAbs().maxCoeff();
    const bool same = (change.array() <= round_off * better.array().abs()).all();  // also small ones beside large ones
    X.swap(better);
    if (same) return X;
  }
  if (near) return X;
  return {};
}

MatrixXd inverse_of(const MatrixXd& X) { return Eigen::FullPivLU<MatrixXd>(X).inverse(); }

class Separation {
 public:
  Separation(MatrixXd& A, MatrixXd& rows, MatrixXd& S, double slowest) : A_(A), rows_(rows), S_(S), slowest_(slowest) {}

  std::vector<StateGroup> of_all() {
    StateGroup all(static_cast<std::size_t>(A_.rows()));
    std::iota(all.begin(), all.end(), 0);
    if (!all.empty()) separate(std::move(all));
    return std::move(groups_);
  }

 private:
  void separate(StateGroup group) {
    StateGroup fast = fastest(group);
    if (!fast.empty() && separate(group, fast)) {
      separate(std::move(group));
      separate(std::move(fast));
    } else {
      groups_.push_back(std::move(group));
    }
  }

  /// Takes from `group` the states that decay fastest: eliminates one after the other until all rates that are left (Schur complement) are smaller by
  /// `numerics::arc_gap`. Returns none, and leaves the group as it is, if there is no such gap.
  StateGroup fastest(StateGroup& group) const {
    MatrixXd rates = A_(group, group);
    StateGroup slow = group, fast;
    for (double least = 0; slow.size() > 1; ) {
      Index i = 0;
      rates.diagonal().cwiseAbs().maxCoeff(&i);
      least = fast.empty() ? std::abs(rates(i, i)) : std::min(least, std::abs(rates(i, i)));
      if (!(least > numerics::arc_gap * slowest_)) return {};
      const VectorXd row = rates.row(i), column = rates.col(i);
      StateGroup others(slow.size());
      std::iota(others.begin(), others.end(), 0);
      others.erase(others.begin() + i);
      const double pivot = rates(i, i);
      rates = (rates - column / pivot * row.transpose())(others, others).eval();
      fast.push_back(slow[static_cast<std::size_t>(i)]);
      slow.erase(slow.begin() + i);
      if (!(rates.cwiseAbs().maxCoeff() * numerics::arc_gap <= least)) continue;
      group = std::move(slow);
      return fast;
    }
    return {};
  }

  MatrixXd block(const StateGroup& of, const StateGroup& by) const { return rows_(of, Eigen::all).leftCols(S_.rows()) * S_(Eigen::all, by); }

  /// False if their motions cannot be told apart.
  bool separate(const StateGroup& slow, const StateGroup& fast) {
    const MatrixXd rows = rows_, S = S_;
    const bool apart = leave_fast_parts(slow, fast) && follow(slow, fast);
    if (!apart) rows_ = rows, S_ = S;
    A_(slow, slow) = block(slow, slow);
    A_(fast, fast) = block(fast, fast);
    A_(slow, fast) = apart ? MatrixXd::Zero(static_cast<Index>(slow.size()), static_cast<Index>(fast.size())) : block(slow, fast);
    A_(fast, slow) = apart ? MatrixXd::Zero(static_cast<Index>(fast.size()), static_cast<Index>(slow.size())) : block(fast, slow);
    return apart;
  }

  /// Takes from the slow states Q f, their part of the fast motions. Rows of [R E] are subtracted, where a force or velocity that acts on several states
  /// cancels exactly; in A its round-off would be left. Each round takes the rest of the previous one.
  bool leave_fast_parts(const StateGroup& slow, const StateGroup& fast) {
    constexpr double round_off = numerics::arc_ulps * std::numeric_limits<double>::epsilon();
    MatrixXd taken = MatrixXd::Zero(static_cast<Index>(slow.size()), static_cast<Index>(fast.size()));
    for (int round = 0; round < numerics::arc_gap_rounds; ++round) {
      const MatrixXd Q = block(slow, fast) * inverse_of(block(fast, fast));
      if (!Q.allFinite()) return false;
      rows_(slow, Eigen::all) -= Q * rows_(fast, Eigen::all);
      S_(Eigen::all, fast) += S_(Eigen::all, slow) * Q;
      taken += Q;
      const VectorXd rest = Q.cwiseAbs().rowwise().maxCoeff(), all = taken.cwiseAbs().rowwise().maxCoeff();
      const double changed = (Q * block(fast, slow)).cwiseAbs().maxCoeff();
      if (changed <= round_off * block(slow, slow).cwiseAbs().maxCoeff() && (rest.array() <= round_off * all.array()).all()) return true;
    }
    return false;
  }

  /// Takes from the fast states P s, with which they follow the slow ones.
  bool follow(const StateGroup& slow, const StateGroup& fast) {
    const MatrixXd ss = block(slow, slow), fs = block(fast, slow);
    const MatrixXd ff = inverse_of(block(fast, fast));
    const auto P = fixed_point(fast.size(), slow.size(), [&](const MatrixXd& X) -> MatrixXd { return ff * (X * ss - fs); });
    if (!P) return false;
    S_(Eigen::all, slow) += S_(Eigen::all, fast) * *P;
    // Unknowns that are small differences, such as the velocity of a dashpot on a light mass, follow from the rates that they cause.
    S_(Eigen::all, slow) += S_(Eigen::all, fast) * (ff * (*P * ss - block(fast, slow)));
    rows_(fast, Eigen::all) -= *P * rows_(slow, Eigen::all);
    return true;
  }

  MatrixXd &A_, &rows_, &S_;
  double slowest_;
  std::vector<StateGroup> groups_;
};

}  // namespace

std::vector<StateGroup> separate_time_scales(MatrixXd& A, MatrixXd& rows, MatrixXd& S, double slowest) { return Separation(A, rows, S, slowest).of_all(); }

}  // namespace rheonet
