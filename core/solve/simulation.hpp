#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/solve/integrator.hpp"
#include "core/solve/profile.hpp"
#include "core/solve/switches.hpp"

namespace rheonet {

/// Receives a trajectory as it comes.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A consistent state just after the start or an event; y' belongs to it. `heat` was released at that instant [J].
  /// The equations and their solver hold until the next `begin`.
  virtual void begin(Dae& dae, Consistency& consistency, double t, const std::vector<double>& y, const std::vector<double>& yp, double heat) = 0;
  /// A step from integrator.previous_time() to integrator.time(). It may be interpolated. Memories of the laws are still
  /// those of the step, also where it ends in an event, and the view of the equations is that of its end.
  virtual void step(const Integrator& integrator) = 0;
  /// An element has switched at the end of the last step; `begin` follows the last such event of an instant.
  virtual void event(const Event& event) = 0;
  /// The end of the run.
  virtual void end(double t) = 0;
};

struct SimulationSettings {
  double stop = 1;  ///< s; the start is at 0
  double accuracy = 1e-6;
  int order = Integrator::highest_order;  ///< of the method, at most: see Integrator::Options
  bool locate_events = true;  ///< see Integrator::Options
  bool switch_times = true;  ///< when within a step a pair has yielded is wanted, not only that it has
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double fraction)> progress;
  Profile* profile = nullptr;  ///< finds out what steps are spent on
};

struct SimulationStatistics {
  Integrator::Statistics integrator;
  std::vector<std::string> notes;
  std::vector<std::string> chosen;  ///< see StartReport
};

/// Integrates from start to stop. `needed` marks the nodes whose positions are asked for. Throws SimulationError, with the
/// time and the elements concerned.
SimulationStatistics simulate(const Network& network, const std::vector<char>& needed, const SimulationSettings& settings,
                              Observer& observer);

/// The same up to the start itself: a state that the equations allow, and which modes begin.
SimulationStatistics check_start(const Network& network, const std::vector<char>& needed,
                                 const SimulationSettings& settings, Observer& observer);

}  // namespace rheonet
