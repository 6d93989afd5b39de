#include "core/nonsmooth/fixed_point.hpp"

#include <Eigen/QR>

namespace rheonet {

Eigen::VectorXd FixedPoint::next(const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
  values_.push_back(g);
  misses_.push_back(g - x);
  if (values_.size() > most_) {
    values_.pop_front();
    misses_.pop_front();
  }
  const auto differences = static_cast<Eigen::Index>(values_.size()) - 1;
  if (differences == 0) return g;
  Eigen::MatrixXd of_values(x.size(), differences), of_misses(x.size(), differences);
  for (Eigen::Index k = 0; k < differences; ++k) {
    of_values.col(k) = values_[static_cast<std::size_t>(k) + 1] - values_[static_cast<std::size_t>(k)];
    of_misses.col(k) = misses_[static_cast<std::size_t>(k) + 1] - misses_[static_cast<std::size_t>(k)];
  }
  return g - of_values * of_misses.completeOrthogonalDecomposition().solve(misses_.back());
}

}  // namespace rheonet
