#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/dae/dae.hpp"
#include "core/dae/unknown_names.hpp"
#include "core/solve/integrator.hpp"

namespace rheonet {

/// Profile of a run: which elements its steps and restarts are due to. A step is attributed to the unknown in the error test
/// with the largest error estimate relative to its tolerance. So are the attempts rejected before that step, because their
/// own error estimates are gone.
class Profile {
 public:
  struct Counts {
    long steps = 0;
    long rejected = 0;  ///< attempts whose error was too large
    long diverged = 0;  ///< attempts for which Newton's iteration failed
    long starts = 0;    ///< restarts of the integrator attributed to it
    Counts& operator+=(const Counts& other);
  };

  /// Call at a restart of the integrator: from here on steps belong to these equations.
  void restart(const Dae& dae);
  /// Attributes the next restart to these elements.
  void blame(const std::vector<int>& elements);
  /// Attributes the next restart to the unknown that limited the failed attempts.
  void blame_failure(const Integrator& integrator);
  void step(const Integrator& integrator);

  const std::map<UnknownNames::Subject, Counts>& counts() const { return counts_; }
  /// Steps in which no unknown has an error, and restarts that no element caused, such as the first.
  const Counts& others() const { return others_; }
  /// Steps at each order of the method.
  const std::array<long, Integrator::highest_order + 1>& orders() const { return orders_; }

 private:
  Counts& of(int unknown);

  const Dae* dae_ = nullptr;
  std::unordered_map<int, Counts*> of_unknown_;  ///< since the last restart
  std::map<UnknownNames::Subject, Counts> counts_;
  Counts others_;
  std::array<long, Integrator::highest_order + 1> orders_{};
  Integrator::Failures failures_;  ///< counts up to the last step
  std::vector<UnknownNames::Subject> blamed_;
};

}  // namespace rheonet
