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

namespace rheonet {

/// The energy account up to a time of a run [J]; what it misses is supplied - stored - dissipated.
struct EnergySoFar {
  double supplied = 0, stored = 0, dissipated = 0;
};

struct RunSettings {
  std::FILE* csv = nullptr;     ///< receives the rows as they come; nullptr: nowhere
  std::FILE* events = nullptr;  ///< receives what switches, as it does: time, element, event, direction
  std::function<void(double time, const std::vector<double>& values)> row = {};  ///< is called with each row
  /// Is called with the records at the start, at the end of each step, and after each instant at which they may jump:
  /// two calls at one time are the two sides of it.
  std::function<void(double time, const std::vector<double>& values)> state = {};
  /// Is called with each event, as it is written to `events`.
  std::function<void(double time, const std::string& element, const char* what, int direction)> event = {};
  /// Is called with the energy account at the start, at the end of each step, and after each event.
  std::function<void(double time, const EnergySoFar& energy)> energy = {};
  const std::atomic<bool>* interrupt = nullptr;  ///< becomes true when the user wants to stop: the run throws SimulationError
  std::function<void(double fraction)> progress =
      {};  ///< called now and then with the fraction of the run that is done
  std::optional<double> tolerance = {};  ///< the integrator works to this accuracy in place of the scene's; > 0
  int order = 5;                         ///< of the integration method, at most; 1 to 5
  int threads = 1;                       ///< on so many independent parts of a scene may be integrated side by side; >= 1
  bool account = true;                   ///< keeps the energy account; without it the energies of the Summary are 0
  bool profile = false;                  ///< finds out what the steps are spent on: Summary::profile
};

/// What a run took, and its energy account [J].
struct Summary {
  struct Switched { std::string element; long times; };
  int unknowns = 0;
  int parts = 1;  ///< independent parts of the scene that were integrated each with its own steps
  bool sparse = false;  ///< KLU rather than dense linear algebra
  long steps = 0;
  long rejected_steps = 0;
  long residual_evaluations = 0;
  long jacobian_evaluations = 0;
  long events = 0;    ///< how often an element switched: see core/solve/switches.hpp
  long restarts = 0;  ///< of the integrator
  std::vector<Switched> switched;  ///< the elements that did, the busiest first
  /// What a node or element has to do with the number of steps: see core/solve/profile.hpp.
  struct Profiled {
    std::string name;  ///< "" for what has no one to blame: steps without an error, the first start
    bool node = false;
    long steps = 0, rejected = 0, diverged = 0, switched = 0, starts = 0;
  };
  std::vector<Profiled> profile;     ///< if asked for: those with the most attempted steps first, the nameless one last
  std::vector<long> steps_of_order;  ///< if asked for: [k] of order k
  double supplied = 0;    ///< by motions and forces
  double stored = 0;      ///< gain of kinetic and elastic energy since the start
  double dissipated = 0;
  double missing = 0;     ///< supplied - stored - dissipated: 0 but for the error of the solution
  double largest = 0;     ///< largest magnitude in the run of any of these and of the energy stored: what `missing` is to
                          ///< be compared with
  std::vector<Finding> findings;  ///< what has become of each of the scene's claims
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< of the thread that called `run`
  std::vector<std::string> notes;  ///< what was assumed, and what a user should know of the result
};

/// Simulates a scene and writes its records. Throws SimulationError; the rows up to there have then been written.
Summary run(const Scene& scene, const RunSettings& settings = {});

/// What there is to say of a scene that can start.
struct StartReport {
  std::vector<std::string> notes;   ///< as in Summary
  std::vector<std::string> chosen;  ///< start values that were not given and follow from nothing, and what they are
};

/// Everything that can be said without integrating: structure, consistent start. Throws SimulationError.
StartReport check(const Scene& scene);

}  // namespace rheonet
