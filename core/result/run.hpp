#pragma once

#include <atomic>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/error.hpp"
#include "core/result/claims.hpp"
#include "core/result/energy_so_far.hpp"

namespace rheonet {

struct RunSettings {
  std::FILE* csv = nullptr;     ///< Receives the rows during the run; nullptr: not written.
  std::FILE* events = nullptr;  ///< Receives each event as it happens: time, element, event, direction.
  std::function<void(double time, const std::vector<double>& values)> row = {};  ///< Called with each row.
  /// Called with the records at the start, at the end of each step, and after each event at which they may jump: two calls
  /// with the same time are the two sides of an event.
  std::function<void(double time, const std::vector<double>& values)> state = {};
  /// Called with each event, as written to `events`.
  std::function<void(double time, const std::string& element, const char* what, int direction)> event = {};
  /// Called with the energy account at the start, at the end of each step, after each event, and at each row. Two calls with the same time are the two sides of an event.
  std::function<void(double time, const EnergySoFar& energy)> energy = {};
  const std::atomic<bool>* interrupt = nullptr;  ///< Set to true by the caller to stop the run, which throws SimulationError.
  std::function<void(double fraction)> progress =
      {};  ///< Called from time to time with the fraction of the run completed.
  std::optional<double> tolerance = {};  ///< Accuracy of the integrator in place of the scene's; > 0.
  std::optional<Scene::Method> method = {};  ///< In place of the scene's.
  int order = 5;                         ///< Largest order of the integration method; 1 to 5.
  int threads = 1;                       ///< For the integration of independent parts in parallel; >= 1.
  bool account = true;                   ///< Keeps the energy account; without it the energies of the Summary are 0.
  bool profile = false;                  ///< Counts the steps due to each node and element: Summary::profile.
};

/// Statistics of a run, and its energy account [J].
struct Summary {
  struct Switched { std::string element; long times; };
  int unknowns = 0;
  int parts = 1;  ///< Independent parts integrated with their own steps.
  bool sparse = false;  ///< KLU rather than dense linear algebra.
  long steps = 0;
  long arc_steps = 0;  ///< For these, in closed form.
  long rejected_steps = 0;
  long finest_steps = 0;  ///< At the least tolerance that double precision allows.
  long residual_evaluations = 0;
  long jacobian_evaluations = 0;
  long events = 0;    ///< Number of switches of elements: see core/solve/mode_change_log.hpp.
  long restarts = 0;  ///< Restarts of the integrator.
  std::vector<Switched> switched;  ///< The elements that switched, most frequent first.
  /// Steps attributed to a node or element: see core/solve/profile.hpp.
  struct Profiled {
    std::string name;  ///< "" for steps without a cause: no error to attribute, the first start.
    bool node = false;
    long steps = 0, rejected = 0, diverged = 0, switched = 0, starts = 0;
  };
  std::vector<Profiled> profile;     ///< On request: sorted by attempted steps, descending; the nameless one last.
  std::vector<long> steps_of_order;  ///< On request: [k] of order k.
  double supplied = 0;    ///< By motions and forces.
  double stored = 0;      ///< Gain of kinetic and elastic energy since the start.
  double dissipated = 0;
  double missing = 0;     ///< Supplied - stored - dissipated: 0 except for errors of the solution.
  double largest = 0;     ///< Largest magnitude in the run of these and of the stored energy: the reference of `missing`.
  std::vector<Finding> findings;  ///< For each of the scene's claims.
  std::optional<double> ended;  ///< Time at which `simulate.stop_when` ended the run [s]; absent: it went on to the stop.
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< CPU time of the thread that called `run`.
  std::vector<std::string> notes;  ///< Assumptions, and remarks on the result for the user.
};

/// Simulates a scene and writes its records. Throws SimulationError; the rows up to that time have then been written.
Summary run(const Scene& scene, const RunSettings& settings = {});

/// Report on a scene that can start.
struct StartReport {
  std::vector<std::string> notes;   ///< As in Summary.
  std::vector<std::string> chosen;  ///< Undetermined start values that were not given, with the values chosen.
};

/// Checks structure and consistent start without integrating. Throws SimulationError.
StartReport check(const Scene& scene);

}  // namespace rheonet
