#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/solve/integrator.hpp"
#include "core/solve/mode_change_log.hpp"
#include "core/solve/profile.hpp"

namespace rheonet {

/// Receives a trajectory while it is computed.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A consistent state just after the start or an event, with its y'. `heat` was released at that event [J]. The references
  /// to the equations and their solver are valid until the next `begin`.
  virtual void begin(Dae& dae, Consistency& consistency, double t, const std::vector<double>& y, const std::vector<double>& yp, double heat) = 0;
  /// A step from integrator.previous_time() to integrator.time(). It may be interpolated. Memories of the laws are still
  /// those of the step, even if it ends in an event, and the view of the equations is that of its end.
  virtual void step(const Integrator& integrator) = 0;
  /// An element has switched at the end of the last step; `begin` follows the last of several events at one time.
  virtual void event(const Event& event) = 0;
  /// The end of the run, which `simulate.stop_when` may have brought at the last event.
  virtual void end(double t) = 0;
};

struct SimulationSettings {
  double stop = 1;  ///< s; the start is at 0
  double accuracy = 1e-6;
  int order = Integrator::highest_order;  ///< highest order of the method: see Integrator::Options
  int arc_unknowns = 0;       ///< see Integrator::Options
  bool locate_events = true;  ///< see Integrator::Options
  bool switch_times = true;  ///< locate the time within a step at which a pair yields, not only the step
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double fraction)> progress;
  Profile* profile = nullptr;  ///< collects the causes of steps, if not null
};

struct SimulationStatistics {
  Integrator::Statistics integrator;
  long finest_steps = 0;  ///< at the least tolerance
  std::vector<std::string> notes;
  std::vector<std::string> chosen;  ///< see StartWords
  std::optional<double> ended;      ///< time at which `simulate.stop_when` ended the run [s]
};

/// Integrates from start to stop. `needed` marks the nodes whose positions are requested. Throws SimulationError, with the
/// time and the elements concerned.
SimulationStatistics simulate(const Network& network, const std::vector<char>& needed, const SimulationSettings& settings,
                              Observer& observer);

/// Only finds the consistent initial state and its modes.
SimulationStatistics check_start(const Network& network, const std::vector<char>& needed,
                                 const SimulationSettings& settings, Observer& observer);

}  // namespace rheonet
