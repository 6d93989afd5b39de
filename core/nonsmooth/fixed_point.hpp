#pragma once

#include <Eigen/Core>
#include <deque>

namespace rheonet {

/// The next trial x of an iteration for x = g(x), from the last trials and their values: the combination of them whose misses g - x sum to least (D. G. Anderson,
/// Journal of the ACM 12 (1965) 547). In a linear problem of n unknowns it meets x after n + 1 trials, if it combines as many.
class FixedPoint {
 public:
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& g);

 private:
  std::deque<Eigen::VectorXd> values_, misses_;
};

}  // namespace rheonet
