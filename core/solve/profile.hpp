#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/dae/dae.hpp"
#include "core/solve/integrator.hpp"

namespace rheonet {

/// What the steps of a run are spent on. A step is put down to the unknown whose error estimate is the largest, relative to
/// its tolerance, of those that the error test looks at; so are the attempts that were rejected before that step came to
/// pass: the estimates of those are gone.
class Profile {
 public:
  struct Counts {
    long steps = 0;
    long rejected = 0;  ///< attempts whose error was too large
    long diverged = 0;  ///< attempts whose equations Newton's iteration did not solve
    long starts = 0;    ///< restarts of the integrator that it had a part in
    Counts& operator+=(const Counts& other);
  };

  /// From here on steps are those of these equations, after a restart of their integrator.
  void restart(const Dae& dae);
  /// These elements are the reason for the next restart.
  void blame(const std::vector<int>& elements);
  /// That is the failure of the last attempts.
  void blame_failure(const Integrator& integrator);
  void step(const Integrator& integrator);

  const std::map<Dae::Subject, Counts>& counts() const { return counts_; }
  /// Steps of which no unknown has an error, and restarts for which no element is to blame: the first, say.
  const Counts& others() const { return others_; }
  /// Steps at each order of the method.
  const std::array<long, Integrator::highest_order + 1>& orders() const { return orders_; }

 private:
  Counts& of(int unknown);

  const Dae* dae_ = nullptr;
  std::unordered_map<int, Counts*> of_unknown_;  ///< since the last restart
  std::map<Dae::Subject, Counts> counts_;
  Counts others_;
  std::array<long, Integrator::highest_order + 1> orders_{};
  Integrator::Failures failures_;  ///< up to the last step
  std::vector<Dae::Subject> blamed_;
};

}  // namespace rheonet
