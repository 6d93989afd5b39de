#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Event functions along a trajectory: an event is one of them going from positive to negative.
class EventFunctions {
 public:
  virtual ~EventFunctions() = default;
  virtual int count() const = 0;
  virtual void evaluate(double t, const double* y, const double* yp, double* g) = 0;
  /// Part of function `k` that keeps noise from being an event. If the function was larger at the beginning of a step, its event
  /// is where it has fallen to this: an event that is always late shifts those after it, and a long run adds that up.
  virtual double band(int /*k*/) const { return 0; }
};

/// SUNDIALS IDA: variable-order, variable-step BDF in the form of Hindmarsh et al., ACM TOMS 31 (2005) 363. One step at a
/// time; output never changes the steps.
class Integrator {
 public:
  enum class Outcome {
    step,      ///< one step further
    event,     ///< at an event; see events()
    stop,      ///< at the stop time
    stuck,     ///< no step however small meets the tolerance, or its equations cannot be solved
    singular,  ///< the equations have no unique solution here
  };

  /// Up to this many unknowns a dense matrix is factorised faster than KLU does it: see tools/bench/linear_algebra.md.
  static constexpr int dense_limit = 4;
  /// The order of the method goes up to this at most.
  static constexpr int highest_order = 5;

  struct Options {
    int order = highest_order;  ///< from 1: the order goes no higher
    int dense = dense_limit;    ///< linear algebra is dense up to so many unknowns
    /// An event is looked for within each step; else it is taken to be at the end of the step that goes over it, as many
    /// programs do.
    bool locate_events = true;
  };

  /// `tolerance[i]` is the allowed local error of unknown i (absolute, > 0), and a change of it below `grain[i]` is noise; they
  /// are read before every step.
  Integrator(Dae& dae, EventFunctions& events, const std::vector<double>& tolerance, const std::vector<double>& grain,
             const Options& options);
  ~Integrator();

  /// Starts afresh at t from a consistent state. The first step is h.
  void restart(TimePoint t, const std::vector<double>& y, const std::vector<double>& yp, double h, TimePoint stop);
  /// Goes on from the stop time to another one: hardly anything has changed there.
  void go_on(TimePoint stop);
  /// No step is longer than this [s]; infinite for no limit.
  void limit_step(double longest);
  Outcome step();
  /// Takes back the last step's part after t: an event of function `which` there has been missed.
  void cut(double t, int which);

  double time() const;
  double previous_time() const;  ///< where the last step began
  const std::vector<double>& y() const;
  const std::vector<double>& yp() const;
  /// After an event: for each event function whether it fired.
  const std::vector<int>& events() const;
  /// The solution (derivative 0) or its time derivative (1) within the last step.
  void interpolate(double t, int derivative, std::vector<double>& out) const;
  /// The unknown with the largest error estimate relative to its tolerance in the last attempted step.
  int worst_unknown() const;
  /// The same of those alone that the error test looks at; -1 if none has an error.
  int limiting_unknown() const;
  /// Attempts at a step that were rejected since the last restart.
  struct Failures {
    long error_tests = 0;  ///< its error was too large
    long convergence = 0;  ///< its equations could not be solved
  };
  Failures failures() const;
  int last_order() const;  ///< of the last step

  struct Statistics {
    long steps = 0, rejected = 0, residuals = 0, jacobians = 0, restarts = 0;
    bool sparse = false;
    Statistics& operator+=(const Statistics& other);
  };
  Statistics statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace rheonet
