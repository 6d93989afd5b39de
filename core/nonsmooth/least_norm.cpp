#include "core/nonsmooth/least_norm.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// A bound side x[force] + slope x[other] >= -width.
struct WideBound {
  Eigen::Index force = 0;
  double side = 0, width = 0;
  Eigen::Index other = 0;
  double slope = 0;
  double share = 1;  ///< in a contradiction
};

/// By how much the bounds of a contradiction are too narrow: a share of those of the problem, or a force [N].
struct Excess { double share = 0, force = 0; };

/// The method, for bounds that are `1 + share` times as far as those of the problem, and farther by `wider`. All forces in here are in the
/// units of the norm.
class DualActiveSet {
 public:
  DualActiveSet(const LeastNorm& problem, const Eigen::VectorXd& load, double share, double wider = 0)
      : problem_(problem), share_(share), wider_(wider), unit_(Eigen::VectorXd::Ones(problem.balance.cols())) {
    if (!problem.unit.empty()) unit_ = Eigen::Map<const Eigen::VectorXd>(problem.unit.data(), unit_.size());
    const std::size_t forces = problem.low.size();
    for (std::size_t k = 0; k < forces; ++k) {
      const auto force = static_cast<Eigen::Index>(k);
      bounds_.push_back({force, 1, wider - (1 + share) * unit_[force] * problem.low[k]});
      bounds_.push_back({force, -1, wider + (1 + share) * unit_[force] * problem.high[k]});
    }
    for (const auto& [force, other, low_slope, high_slope] : problem.following) {
      const auto of = static_cast<Eigen::Index>(other);
      for (const std::size_t side : {0, 1}) {
        bounds_[2 * force + side].other = of;
        bounds_[2 * force + side].slope = (side == 0 ? low_slope : high_slope) * (unit_[static_cast<Eigen::Index>(force)] / unit_[of]);
      }
    }
    rows_.resize(problem.balance.cols(), 0);
    without_bounds_.setZero(problem.balance.cols());
    if (problem.balance.size() == 0) return;
    const Eigen::MatrixXd balance = problem.balance * unit_.cwiseInverse().asDiagonal();
    // Where forces were taken out, balances may depend on each other.
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(balance.cols(), balance.rows());
    factors.setThreshold(numerics::equal_values);
    factors.compute(balance.transpose());
    rows_ = factors.householderQ() * Eigen::MatrixXd::Identity(balance.cols(), factors.rank());
    if (factors.rank() == 0) return;
    without_bounds_ = rows_ * (balance * rows_).colPivHouseholderQr().solve(load);
    roundoff_ = numerics::equation_roundoff * without_bounds_.lpNorm<Eigen::Infinity>();
  }

  /// Meets all bounds. False if that is impossible: `cut` are the bounds that contradict the load, too narrow by `excess` beside those of the problem.
  bool solve(Eigen::VectorXd& x, std::vector<WideBound>& cut, Excess& excess) {
    const bool solved = solve_in_units(x, cut, excess);
    x = x.cwiseQuotient(unit_).eval();
    return solved;
  }

 private:
  bool solve_in_units(Eigen::VectorXd& x, std::vector<WideBound>& cut, Excess& excess) {
    x = without_bounds_;
    const std::size_t most = numerics::least_rounds + numerics::rounds_a_branch * problem_.low.size();
    for (std::size_t round = 0; round < most; ++round) {
      WideBound worst;
      if (!most_violated(x, worst)) return true;
      double multiplier = 0;
      while (true) {
        if (++round > most) return false;
        // The normal of the bound, less its projection on those of the equations and of the active bounds.
        const Eigen::MatrixXd normals = active_normals();
        const Eigen::VectorXd normal = normal_of(worst), share = normals.colPivHouseholderQr().solve(normal), step = normal - normals * share;
        const bool moves = step.squaredNorm() > numerics::equal_values * normal.squaredNorm();
        const double full = moves ? -slack(worst, x) / step.dot(normal) : none;
        double partial = none;
        std::size_t blocking = 0;
        for (std::size_t k = 0; k < active_.size(); ++k) {
          const double by = share[rows_.cols() + static_cast<Eigen::Index>(k)];
          if (by > 0 && multipliers_[k] / by < partial) {
            partial = multipliers_[k] / by;
            blocking = k;
          }
        }
        const double length = std::min(full, partial);
        // Where opposite bounds coincide, as those of a force between 0 and a share of itself, they are met but for the round-off of the steps so far. The
        // search begins again with a bound that is wider by that.
        const double over = -slack(worst, x);
        if (std::isinf(length) && over <= numerics::balance_roundoff * (1 + std::abs(worst.slope)) * x.lpNorm<Eigen::Infinity>()) {
          bounds_[2 * static_cast<std::size_t>(worst.force) + (worst.side > 0 ? 0 : 1)].width += over;
          x = without_bounds_;
          active_.clear();
          multipliers_.clear();
          break;
        }
        if (std::isinf(length)) {
          cut = contradiction(worst, share, excess);
          return false;
        }
        if (moves) x += length * step;
        for (std::size_t k = 0; k < active_.size(); ++k) multipliers_[k] -= length * share[rows_.cols() + static_cast<Eigen::Index>(k)];
        multiplier += length;
        if (full <= partial) {
          active_.push_back(worst);
          multipliers_.push_back(multiplier);
          x[worst.force] = -worst.side * (worst.width + worst.slope * x[worst.other]);
          break;
        }
        active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(blocking));
        multipliers_.erase(multipliers_.begin() + static_cast<std::ptrdiff_t>(blocking));
      }
    }
    return false;
  }

  static double slack(const WideBound& b, const Eigen::VectorXd& x) { return b.side * x[b.force] + b.slope * x[b.other] + b.width; }
  Eigen::VectorXd normal_of(const WideBound& b) const {
    Eigen::VectorXd normal = b.side * Eigen::VectorXd::Unit(rows_.rows(), b.force);
    normal[b.other] += b.slope;
    return normal;
  }

  bool most_violated(const Eigen::VectorXd& x, WideBound& worst) const {
    double least = 0;
    for (const WideBound& b : bounds_) {
      const double over = slack(b, x) + numerics::equation_roundoff * std::abs(b.width) + (1 + std::abs(b.slope)) * roundoff_;
      if (over >= least) continue;
      least = over;
      worst = b;
    }
    return least < 0;
  }

  Eigen::MatrixXd active_normals() const {
    Eigen::MatrixXd normals(rows_.rows(), rows_.cols() + static_cast<Eigen::Index>(active_.size()));
    normals.leftCols(rows_.cols()) = rows_;
    for (std::size_t k = 0; k < active_.size(); ++k) normals.col(rows_.cols() + static_cast<Eigen::Index>(k)) = normal_of(active_[k]);
    return normals;
  }

  /// The bounds that hold against the load: the normal of `bound` is that share of those of the equations and of active bounds.
  std::vector<WideBound> contradiction(const WideBound& bound, const Eigen::VectorXd& share, Excess& excess) const {
    std::vector<WideBound> cut{bound};
    double against = bound.width, shares = 1;
    for (std::size_t k = 0; k < active_.size(); ++k) {
      const double by = -share[rows_.cols() + static_cast<Eigen::Index>(k)];
      if (by <= numerics::equal_values) continue;
      cut.push_back(active_[k]);
      cut.back().share = by;
      against += by * active_[k].width;
      shares += by;
    }
    const double load = -share.head(rows_.cols()).dot(rows_.transpose() * without_bounds_);
    excess = {(1 + share_) * (load / against) - 1, wider_ + (load - against) / shares};
    return cut;
  }

  const LeastNorm& problem_;
  double share_, wider_;
  Eigen::VectorXd unit_;            ///< of each force
  Eigen::MatrixXd rows_;            ///< orthonormal combinations of the balances, one a column
  Eigen::VectorXd without_bounds_;  ///< forces of least norm
  double roundoff_ = 0;             ///< of forces: a bound of 0 cannot be met better
  std::vector<WideBound> bounds_;   ///< the lower and the upper one of each force
  std::vector<WideBound> active_;
  std::vector<double> multipliers_;
};

bool balances(const LeastNorm& problem, const Eigen::VectorXd& loads, const Eigen::VectorXd& x) {
  const Eigen::VectorXd size = problem.balance.cwiseAbs() * x.cwiseAbs() + loads.cwiseAbs();
  if (size.size() == 0) return true;
  return ((problem.balance * x - loads).cwiseAbs().array() <= numerics::balance_roundoff * size.array() + numerics::equation_roundoff * size.maxCoeff()).all();
}

}  // namespace

bool LeastNorm::solve_within(const std::vector<double>& load, std::vector<double>& force, std::vector<Bound>& contradiction) const {
  const Eigen::VectorXd loads = Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
  Eigen::VectorXd x;
  std::vector<WideBound> cut;
  Excess excess;
  const bool within = DualActiveSet(*this, loads, 0).solve(x, cut, excess);
  contradiction.clear();
  for (const WideBound& b : cut) contradiction.push_back({static_cast<std::size_t>(b.force), b.side > 0 ? -1 : 1, b.share});
  force.assign(x.begin(), x.end());
  return within ? balances(*this, loads, x) : !cut.empty();
}

bool LeastNorm::solve_widened(const std::vector<double>& load, std::vector<double>& force, double& wider) const {
  const Eigen::VectorXd loads = Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
  Eigen::VectorXd x;
  wider = 0;
  for (std::size_t round = 0; round < numerics::least_rounds; ++round) {
    std::vector<WideBound> cut;
    Excess excess;
    if (DualActiveSet(*this, loads, 0, wider).solve(x, cut, excess)) {
      force.assign(x.begin(), x.end());
      return balances(*this, loads, x);
    }
    if (cut.empty() || !std::isfinite(excess.force)) return false;
    // Each contradiction shows by how much all bounds must at least be wider: the last one decides (Dinkelbach 1967). One that comes again does so by round-off.
    wider = std::max(excess.force, wider + numerics::equation_roundoff * loads.lpNorm<Eigen::Infinity>());
  }
  return false;
}

bool LeastNorm::solve(const std::vector<double>& load, std::vector<double>& force) const {
  const Eigen::VectorXd loads = Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(balance.cols());
  std::vector<Eigen::Index> open(low.size());
  std::iota(open.begin(), open.end(), 0);
  while (!open.empty()) {
    LeastNorm rest;
    rest.balance = balance(Eigen::all, open);
    for (const Eigen::Index k : open) {
      rest.low.push_back(low[static_cast<std::size_t>(k)]);
      rest.high.push_back(high[static_cast<std::size_t>(k)]);
      if (!unit.empty()) rest.unit.push_back(unit[static_cast<std::size_t>(k)]);
    }
    const Eigen::VectorXd left = loads - balance * x;
    Eigen::VectorXd found;
    // Each contradiction shows by how much all bounds must at least be wider: the last one decides (Dinkelbach 1967).
    std::vector<WideBound> worst;
    double share = 0;
    while (true) {
      std::vector<WideBound> cut;
      Excess excess;
      if (DualActiveSet(rest, left, share).solve(found, cut, excess)) break;
      if (cut.empty()) return false;
      if (!std::isfinite(excess.share)) {
        // No share of bounds that are all 0 holds anything: they take the load as bounds of equal width would.
        const double width = numerics::equation_roundoff * loads.lpNorm<Eigen::Infinity>();
        if (width == 0 || std::none_of(cut.begin(), cut.end(), [](const WideBound& b) { return b.width == 0; })) return false;
        for (const WideBound& b : cut) (b.side > 0 ? rest.low : rest.high)[static_cast<std::size_t>(b.force)] = -b.side * width;
        continue;
      }
      if (excess.share <= share + numerics::balance_roundoff * (1 + share)) break;  // the same contradiction, but for its round-off
      share = excess.share;
      worst = std::move(cut);
    }
    if (worst.empty()) {
      // A force within round-off of a bound is set to it. With the bound 0, the round-off would exceed the dead band of the guard.
      const double roundoff = numerics::equation_roundoff * found.lpNorm<Eigen::Infinity>();
      for (std::size_t k = 0; k < open.size(); ++k) {
        const double is = found[static_cast<Eigen::Index>(k)], nearest = std::clamp(is, rest.low[k], rest.high[k]);
        x[open[k]] = std::abs(is - nearest) <= roundoff ? nearest : is;
      }
      break;
    }
    for (const WideBound& b : worst) {
      const auto place = static_cast<std::size_t>(b.force);
      Eigen::Index& k = open[place];
      x[k] = (1 + share) * (b.side > 0 ? rest.low : rest.high)[place];
      k = -1;
    }
    std::erase(open, -1);
  }
  force.assign(x.begin(), x.end());
  return balances(*this, loads, x);
}

}  // namespace rheonet
