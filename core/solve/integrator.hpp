#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/dae/dae.hpp"
#include "core/solve/event_finder.hpp"

namespace rheonet {

/// Crosses the time between events, one step at a time; output never changes the steps. By SUNDIALS IDA: variable-order, variable-step BDF
/// in the form of Hindmarsh et al., ACM TOMS 31 (2005) 363; or, where that is asked for and possible, by exact arcs.
class Integrator {
 public:
  enum class Outcome {
    step,      ///< one step further
    event,     ///< at an event; see events()
    stop,      ///< at the stop time
    stuck,     ///< no step, however small, meets the tolerance, or Newton's iteration fails
    singular,  ///< the equations have no unique solution here
  };

  /// Highest order of the method.
  static constexpr int highest_order = 5;

  struct Options {
    int order = highest_order;  ///< highest order, from 1
    int dense = numerics::dense_integration_limit;  ///< linear algebra is dense up to this many unknowns
    /// Locate each event within its step; if false, an event is taken to be at the end of its step, as many programs do.
    bool locate_events = true;
    int arc_unknowns = 0;  ///< exact arcs (exact_arc.hpp) cross every interval that they can, if there are no more unknowns than this; 0: IDA alone
  };

  /// `tolerance[i]` is the allowed local error of unknown i (absolute, > 0), and a change of it below `grain[i]` is
  /// round-off. Both are read before every step.
  Integrator(Dae& dae, EventFunctions& events, const std::vector<double>& tolerance, const std::vector<double>& grain,
             const Options& options);
  ~Integrator();

  /// Whether an exact arc leads from this state at t to `stop`. Call before `restart`.
  bool begins_arc(TimePoint t, const std::vector<double>& y, TimePoint stop);
  /// Restarts at t from a consistent state. The first step of IDA has the length h, that of an arc this at most [s]. No step passes `stop`.
  void restart(TimePoint t, const std::vector<double>& y, const std::vector<double>& yp, double h, TimePoint stop);
  /// Continues with the same history past the stop time, if the discontinuity there is negligible, to another stop time.
  void go_on(TimePoint stop);
  /// Limits the step size [s]; infinite for no limit.
  void limit_step(double longest);
  Outcome step();
  /// Shortens the last step to end at t, at a missed event of function `which`.
  void cut(double t, int which);

  /// Since the last restart the solution is an exact arc.
  bool exact() const;
  double time() const;
  double previous_time() const;  ///< where the last step began
  const std::vector<double>& y() const;
  const std::vector<double>& yp() const;
  /// After an event: for each event function, whether it fired (1) or not (0).
  const std::vector<int>& events() const;
  /// The solution (derivative 0) or its time derivative (1) within the last step.
  void interpolate(double t, int derivative, std::vector<double>& out) const;
  /// The unknown with the largest error estimate relative to its tolerance in the last attempted step.
  int worst_unknown() const;
  /// The same among the unknowns in the error test; -1 if none of them has an error.
  int limiting_unknown() const;
  /// Rejected attempts at a step since the last restart.
  struct Failures {
    long error_tests = 0;  ///< error too large
    long convergence = 0;  ///< Newton's iteration failed
  };
  Failures failures() const;
  int last_order() const;  ///< order of the last step

  struct Statistics {
    long steps = 0, arc_steps = 0, rejected = 0, residuals = 0, jacobians = 0, restarts = 0;
    bool sparse = false;
    Statistics& operator+=(const Statistics& other);
  };
  Statistics statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace rheonet
