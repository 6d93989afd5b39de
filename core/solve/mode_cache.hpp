#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/solve/events.hpp"
#include "core/solve/integrator.hpp"
#include "core/solve/missed_events.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// The equations of one set of modes, their solvers and their events.
struct System {
  Structure structure;
  Dae dae;
  Consistency consistency;
  NetworkEvents events;
  MissedEvents missed_events;
  Integrator integrator;

  System(const Network& network, Structure s, Inputs& inputs, const std::vector<char>& needed, const Modes& modes,
         Tolerances& tolerances, const Integrator::Options& options);
};

/// Cache of the systems of the modes that a run has been in.
class ModeCache {
 public:
  /// `classified` is the network's structure with every slider slipping. All must outlive this.
  ModeCache(const Network& network, const Structure& classified, Inputs& inputs, const std::vector<char>& needed,
          const Modes& modes, Tolerances& tolerances, const Integrator::Options& options);

  /// The system of the present modes of the sliders, and of the laws that are constant forces at present. Throws
  /// SimulationError as `analyse` does.
  const std::shared_ptr<System>& of_modes();
  /// The sum over all systems so far.
  Integrator::Statistics statistics() const;

 private:
  const Network& network_;
  Inputs& inputs_;
  const std::vector<char>& needed_;
  const Modes& modes_;
  Tolerances& tolerances_;
  const Integrator::Options options_;
  /// Deflection branches at floating nodes that may become constant forces: the structure depends on whether they are.
  std::vector<std::pair<const DeflectionBatch*, std::size_t>> may_tie_;
  std::map<std::vector<char>, std::shared_ptr<System>> mode_cache_;
  Integrator::Statistics history_;  ///< of systems dropped from the cache
};

}  // namespace rheonet
