#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>

namespace rheonet {

/// An iteration for x = g(x). The next trial combines the last ones so that their misses g - x sum to least (D. G. Anderson, Journal of
/// the ACM 12 (1965) 547); with two of them it is a secant. In a linear problem of n unknowns it meets x after n + 1 trials, if it
/// combines as many.
class FixedPoint {
 public:
  /// `most`: trials that are combined.
  explicit FixedPoint(std::size_t most) : most_(most) {}
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& g);

 private:
  std::size_t most_;
  std::deque<Eigen::VectorXd> values_, misses_;
};

}  // namespace rheonet
