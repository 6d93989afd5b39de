#include "core/solve/profile.hpp"

#include <algorithm>

#include "core/base/index.hpp"
#include "core/dae/unknown_names.hpp"

namespace rheonet {

Profile::Counts& Profile::Counts::operator+=(const Counts& other) {
  steps += other.steps;
  rejected += other.rejected;
  diverged += other.diverged;
  starts += other.starts;
  return *this;
}

void Profile::restart(const Dae& dae) {
  dae_ = &dae;
  of_unknown_.clear();
  failures_ = {};
  std::sort(blamed_.begin(), blamed_.end());
  blamed_.erase(std::unique(blamed_.begin(), blamed_.end()), blamed_.end());
  for (const UnknownNames::Subject& subject : blamed_) ++counts_[subject].starts;
  if (blamed_.empty()) ++others_.starts;
  blamed_.clear();
}

void Profile::blame(const std::vector<int>& elements) {
  for (const int element : elements) blamed_.push_back({UnknownNames::Subject::Kind::element, element});
}

void Profile::blame_failure(const Integrator& integrator) {
  if (const int unknown = integrator.limiting_unknown(); unknown >= 0) blamed_.push_back(UnknownNames(*dae_).subject(unknown));
}

void Profile::step(const Integrator& integrator) {
  const Integrator::Failures failures = integrator.failures();
  of(integrator.limiting_unknown()) += {1, failures.error_tests - failures_.error_tests,
                                        failures.convergence - failures_.convergence, 0};
  failures_ = failures;
  ++orders_[at(integrator.last_order())];
}

Profile::Counts& Profile::of(int unknown) {
  if (unknown < 0) return others_;
  Counts*& counts = of_unknown_[unknown];
  if (!counts) counts = &counts_[UnknownNames(*dae_).subject(unknown)];  // std::map keeps the address valid
  return *counts;
}

}  // namespace rheonet
