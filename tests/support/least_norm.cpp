#include "tests/support/least_norm.hpp"

namespace rheonet::test {

bool of_least_norm(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& force, double rounding) {
  std::vector<double> phi(static_cast<std::size_t>(nodes) + 1, 0);
  bool changed = false;
  const auto lower = [&](double& potential, double most) {
    if (potential <= most + rounding) return;
    potential = most;
    changed = true;
  };
  for (int round = 0; round <= nodes + 1; ++round) {
    changed = false;
    for (std::size_t k = 0; k < force.size(); ++k) {
      double& a = phi[static_cast<std::size_t>(branches[k].a + 1)];
      double& b = phi[static_cast<std::size_t>(branches[k].b + 1)];
      if (force[k] < branches[k].high) lower(a, b + force[k]);
      if (force[k] > branches[k].low) lower(b, a - force[k]);
    }
    if (!changed) return true;
  }
  return false;
}

}  // namespace rheonet::test
