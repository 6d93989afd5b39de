#include "core/nonsmooth/least_norm.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// The method for bounds that are `1 + share` times as far.
class DualActiveSet {
 public:
  DualActiveSet(const LeastNorm& problem, const Eigen::VectorXd& load, double share) : problem_(problem), load_(load), share_(share) {}

  /// Meets all bounds; false if that is impossible: `excess` is the share by which those that contradict each other are too narrow.
  bool solve(Eigen::VectorXd& x, double& excess) {
    const Eigen::MatrixXd& balance = problem_.balance;
    x = balance.transpose() * (balance * balance.transpose()).ldlt().solve(load_);
    const std::size_t most = numerics::least_rounds + numerics::rounds_a_branch * problem_.low.size();
    for (std::size_t round = 0; round < most; ++round) {
      Bound worst;
      if (!most_violated(x, worst)) return true;
      double multiplier = 0;
      while (true) {
        if (++round > most) return false;
        // The normal of the bound, less its projection on those of the equations and of the active bounds.
        const Eigen::MatrixXd normals = active_normals();
        const Eigen::VectorXd normal = normal_of(worst), share = normals.colPivHouseholderQr().solve(normal), step = normal - normals * share;
        const bool moves = step.squaredNorm() > numerics::equal_values;
        const double full = moves ? -slack(worst, x) / step.dot(normal) : none;
        double partial = none;
        std::size_t blocking = 0;
        for (std::size_t k = 0; k < active_.size(); ++k) {
          const double by = share[balance.rows() + static_cast<Eigen::Index>(k)];
          if (by > 0 && multipliers_[k] / by < partial) {
            partial = multipliers_[k] / by;
            blocking = k;
          }
        }
        const double length = std::min(full, partial);
        if (std::isinf(length)) {
          excess = contradiction(worst, share);
          return false;
        }
        if (moves) x += length * step;
        for (std::size_t k = 0; k < active_.size(); ++k) multipliers_[k] -= length * share[balance.rows() + static_cast<Eigen::Index>(k)];
        multiplier += length;
        if (full <= partial) {
          active_.push_back(worst);
          multipliers_.push_back(multiplier);
          x[worst.force] = limit(worst);
          break;
        }
        active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(blocking));
        multipliers_.erase(multipliers_.begin() + static_cast<std::ptrdiff_t>(blocking));
      }
    }
    return false;
  }

 private:
  /// side x >= -bound, with the bound at least 0.
  struct Bound { Eigen::Index force = 0; double side = 0; };

  double width(const Bound& b) const {
    const std::size_t k = static_cast<std::size_t>(b.force);
    return (1 + share_) * (b.side > 0 ? -problem_.low[k] : problem_.high[k]);
  }
  double limit(const Bound& b) const { return -b.side * width(b); }
  double slack(const Bound& b, const Eigen::VectorXd& x) const { return b.side * x[b.force] + width(b); }
  Eigen::VectorXd normal_of(const Bound& b) const { return b.side * Eigen::VectorXd::Unit(problem_.balance.cols(), b.force); }

  bool most_violated(const Eigen::VectorXd& x, Bound& worst) const {
    double least = 0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      for (const double side : {1.0, -1.0}) {
        const Bound b{k, side};
        const double over = slack(b, x) + numerics::equation_roundoff * width(b);
        if (over >= least) continue;
        least = over;
        worst = b;
      }
    }
    return least < 0;
  }

  Eigen::MatrixXd active_normals() const {
    const Eigen::MatrixXd& balance = problem_.balance;
    Eigen::MatrixXd normals(balance.cols(), balance.rows() + static_cast<Eigen::Index>(active_.size()));
    normals.leftCols(balance.rows()) = balance.transpose();
    for (std::size_t k = 0; k < active_.size(); ++k) normals.col(balance.rows() + static_cast<Eigen::Index>(k)) = normal_of(active_[k]);
    return normals;
  }

  /// The load and the bounds that hold against it: the normal of `bound` is that share of those of the equations and of active bounds.
  double contradiction(const Bound& bound, const Eigen::VectorXd& share) const {
    double against = width(bound), power = share.head(load_.size()).dot(load_);
    for (std::size_t k = 0; k < active_.size(); ++k) against -= share[load_.size() + static_cast<Eigen::Index>(k)] * width(active_[k]);
    return against > 0 ? (1 + share_) * (-power / against) - 1 : none;
  }

  const LeastNorm& problem_;
  const Eigen::VectorXd& load_;
  double share_;
  std::vector<Bound> active_;
  std::vector<double> multipliers_;
};

}  // namespace

bool LeastNorm::solve(const std::vector<double>& load, std::vector<double>& force) const {
  const Eigen::VectorXd loads = Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
  Eigen::VectorXd x;
  double share = 0;
  for (std::size_t cut = 0; cut <= low.size() + 1; ++cut) {
    double excess = none;
    if (DualActiveSet(*this, loads, share).solve(x, excess)) {
      force.assign(x.begin(), x.end());
      const Eigen::VectorXd size = balance.cwiseAbs() * x.cwiseAbs() + loads.cwiseAbs();
      return ((balance * x - loads).cwiseAbs().array() <= numerics::balance_roundoff * size.array()).all();
    }
    // A little more, so that round-off does not find the same contradiction again.
    const double wider = excess + numerics::balance_roundoff * (1 + excess);
    if (!(wider > share) || std::isinf(wider)) return false;
    share = wider;
  }
  return false;
}

}  // namespace rheonet
