#include "core/solve/integrator.hpp"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/solve/event_finder.hpp"
#include "core/solve/exact_arc.hpp"
#include "core/solve/newton.hpp"
#include "core/solve/vectors.hpp"

namespace rheonet {

namespace {

void require(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string("SUNDIALS: ") + call + " failed with " + std::to_string(flag));
}

}  // namespace

struct Integrator::Implementation {
  Dae& dae;
  EventFunctions& event_functions;
  EventFinder finder;
  const std::vector<double>& tolerance;
  SUNContext context = nullptr;
  std::vector<double> y, yp, work;
  N_Vector ny = nullptr, np = nullptr, nw = nullptr;
  Newton newton;
  SUNNonlinearSolver solver = nullptr;  // IDA's interface to `newton`
  void* ida = nullptr;
  /// IDA counts time from the last restart, so that the round-off of steps and events is relative to the time since then.
  TimePoint begin, stop;
  double time = 0, previous = 0;  ///< from `begin` on [s]
  double rounded_time = 0, rounded_previous = 0;  ///< times of the scene, rounded once a step because they are read often [s]
  /// IDA sums its step sizes with round-off. Many equal steps that are short against the time reached drift by up to half an
  /// ulp of time each. `lost` is the sum of these errors, and true time is IDA's time plus `lost` [s].
  double lost = 0;
  double lost_by_step = 0;  ///< `lost` including the attempted step [s]
  double reached = 0;       ///< IDA's time at the end of the last step [s]
  Statistics history;  // before the last restart
  bool started = false;
  long rejected = 0;    // error tests failed since the restart
  int grown_back = 0;   // steps in a row whose increase was rejected at order 1
  std::unique_ptr<ExactArc> arc;
  bool on_arc = false, arc_begins = false;  // since the restart; with the next one
  long arc_steps = 0;   // since then
  double longest_step = std::numeric_limits<double>::infinity(), first_step = longest_step;  // s; of all steps, and of the first along an arc

  Implementation(Dae& d, EventFunctions& e, const std::vector<double>& tol, const std::vector<double>& least,
                 const Options& options)
      : dae(d), event_functions(e),
        finder(e, options.locate_events, [this](double t, std::vector<double>& functions) {
          if (t != time) go_to(t);
          evaluate(functions);
        }),
        tolerance(tol), y(at(d.size()), 0), yp(y), work(y), newton(d, d.size() > options.dense, tol, least) {
    const sunindextype n = dae.size();
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    ny = N_VMake_Serial(n, y.data(), context);
    np = N_VMake_Serial(n, yp.data(), context);
    nw = N_VMake_Serial(n, work.data(), context);
    for (N_Vector vector : {ny, np, nw}) quicken(vector);
    ida = IDACreate(context);
    require(IDAInit(ida, residual, 0, ny, np), "IDAInit");
    require(IDASetUserData(ida, this), "IDASetUserData");
    require(IDASetErrHandlerFn(ida, [](int, const char*, const char*, char*, void*) {}, nullptr), "IDASetErrHandlerFn");
    require(IDAWFtolerances(ida, weights), "IDAWFtolerances");
    history.sparse = n > options.dense;
    require(IDASetMaxNumSteps(ida, -1), "IDASetMaxNumSteps");
    require(IDASetMaxOrd(ida, options.order), "IDASetMaxOrd");
    require(IDASetEtaFixedStepBounds(ida, 1, numerics::step_growth), "IDASetEtaFixedStepBounds");
    if (!dae.rough()) require(IDASetNonlinConvCoef(ida, numerics::newton_error_share), "IDASetNonlinConvCoef");
    // The error test leaves out algebraic unknowns, which follow from the others at any time. There they could keep the order
    // at 1 for good: they magnify the error of stiff components, which is proportional to the step size however small.
    for (int i = 0; i < dae.size(); ++i) work[at(i)] = dae.differentiated(i) ? 1 : 0;
    if (std::find(work.begin(), work.end(), 0.0) != work.end()) {
      require(IDASetId(ida, nw), "IDASetId");
      require(IDASetSuppressAlg(ida, SUNTRUE), "IDASetSuppressAlg");
    }
    solver = SUNNonlinSolNewEmpty(context);
    solver->content = this;
    solver->ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
    solver->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) { return SUN_NLS_SUCCESS; };
    solver->ops->solve = solve;
    require(IDASetNonlinearSolver(ida, solver), "IDASetNonlinearSolver");
    if (options.arc_unknowns > 0 && dae.unknowns() <= options.arc_unknowns) arc = std::make_unique<ExactArc>(dae, tol);
  }

  ~Implementation() {
    IDAFree(&ida);
    SUNNonlinSolFreeEmpty(solver);
    N_VDestroy(nw);
    N_VDestroy(np);
    N_VDestroy(ny);
    SUNContext_Free(&context);
  }

  static double* data(N_Vector v) { return NV_DATA_S(v); }

  /// IDA requires a residual, but only `newton` evaluates one.
  static int residual(double, N_Vector, N_Vector, N_Vector, void*) { return -1; }

  double length() const { return stop.since(begin); }
  TimePoint point(double since) const { return since == length() ? stop : begin + since; }
  void round_times() {
    rounded_time = point(time).t;
    rounded_previous = point(previous).t;
  }
  /// Time from `begin` to t, clamped to the last step because t is rounded [s].
  double since_begin(double t) const { return std::clamp(TimePoint(t).since(begin), previous, time); }
  /// Gives the equations the exact time that the returned double stands for, before they are evaluated there.
  double refine(double since) {
    const TimePoint t = point(since);
    dae.refine(t);
    return t.t;
  }

  static int solve(SUNNonlinearSolver solver, N_Vector, N_Vector correction, N_Vector weight, double enough, booleantype, void*) {
    auto& self = *static_cast<Implementation*>(solver->content);
    double t = 0, cj = 0;
    N_Vector predicted_y, predicted_yp, y, yp, r;
    void* user;
    require(IDAGetNonlinearSystemData(self.ida, &t, &predicted_y, &predicted_yp, &y, &yp, &r, &cj, &user), "IDAGetNonlinearSystemData");
    self.see_loss(t);
    const Newton::Step step{self.refine(t + self.lost_by_step), cj, data(predicted_y), data(predicted_yp), data(y), data(yp)};
    // If the iteration fails or leaves a law's range, IDA tries a smaller step.
    return self.newton.solve(step, data(correction), data(weight), enough) ? SUN_NLS_SUCCESS : SUN_NLS_CONV_RECVR;
  }

  static int weights(N_Vector, N_Vector w, void* user) {
    const auto& self = *static_cast<Implementation*>(user);
    double* out = data(w);
    for (std::size_t i = 0; i < self.tolerance.size(); ++i) out[i] = 1 / self.tolerance[i];
    return 0;
  }

  /// Finds the round-off of IDA's time in a step to `sum` (exactly: T. J. Dekker, Numerische Mathematik 18 (1971) 224).
  void see_loss(double sum) {
    double length = 0;
    IDAGetCurrentStep(ida, &length);
    lost_by_step = lost + (length - (sum - reached));
  }

  /// Takes over the round-off of IDA's time after a step, and corrects the stop time by it.
  void keep_time() {
    lost = lost_by_step;
    IDAGetCurrentTime(ida, &reached);
    require(IDASetStopTime(ida, length() - lost), "IDASetStopTime");
  }

  /// Call after a step. IDA raises the order after a few steps of equal size, and enlarges steps with a small error. Where a
  /// change of step size excites an error of stiff components, each enlarged step is rejected, and the order would stay 1 for
  /// good. Then the step size is held until the order has risen.
  void rise() {
    int order = 0;
    long failures = 0;
    IDAGetLastOrder(ida, &order);
    IDAGetNumErrTestFails(ida, &failures);
    const bool back = order == 1 && failures > rejected;
    rejected = failures;
    const bool was_held = grown_back >= numerics::rejected_growths;
    grown_back = back || (was_held && order == 1 && grown_back < numerics::held_steps * numerics::rejected_growths) ? grown_back + 1 : 0;
    const bool held = grown_back >= numerics::rejected_growths;
    if (held != was_held) require(IDASetEtaFixedStepBounds(ida, 1, held ? numerics::held_step_growth : numerics::step_growth), "IDASetEtaFixedStepBounds");
  }

  void evaluate(std::vector<double>& functions) { event_functions.evaluate(refine(time), y.data(), yp.data(), functions.data()); }

  /// Interpolates y and y' at a time within the last step.
  void go_to(double t) {
    time = t;
    refine(t);
    if (on_arc) {
      arc->evaluate(t, 0, y.data());
      arc->evaluate(t, 1, yp.data());
      return;
    }
    require(IDAGetDky(ida, t - lost_by_step, 0, ny), "IDAGetDky");
    require(IDAGetDky(ida, t - lost_by_step, 1, np), "IDAGetDky");
  }

  /// True if the last step has passed an event; it then ends there.
  bool meets_event() {
    if (finder.none()) {
      refine(time);
      return false;
    }
    const std::optional<double> event = finder.in_step(previous, time);
    if (event && *event != time) go_to(*event);
    return event.has_value();
  }

  Outcome step_along_arc() {
    ++arc_steps;
    const double end = arc->step(time, std::min(longest_step, std::exchange(first_step, std::numeric_limits<double>::infinity())));
    const std::optional<double> event = finder.none() ? std::nullopt : finder.in_long_step(previous, end);
    go_to(event.value_or(end));
    return event ? Outcome::event : end == length() ? Outcome::stop : Outcome::step;
  }

  Outcome step() {
    previous = time;
    if (on_arc) return step_along_arc();
    double ida_time = time;
    const int flag = IDASolve(ida, length(), &ida_time, ny, np, IDA_ONE_STEP);
    if (flag == IDA_SUCCESS) keep_time();
    if (flag < 0) refine(time);
    if (flag >= 0) {
      rise();
      time = flag == IDA_TSTOP_RETURN ? length() : ida_time + lost;
      if (meets_event()) return Outcome::event;
    }
    switch (flag) {
      case IDA_SUCCESS:
        return Outcome::step;
      case IDA_TSTOP_RETURN:
        return Outcome::stop;
      default:
        return newton.singular() ? Outcome::singular : Outcome::stuck;
    }
  }

  Failures failures() const {
    Failures f;
    if (on_arc) return f;
    IDAGetNumErrTestFails(ida, &f.error_tests);
    f.convergence = newton.counts().failures;
    return f;
  }

  Statistics present() const {
    Statistics s;
    if (on_arc) {
      s.steps = s.arc_steps = arc_steps;
      return s;
    }
    IDAGetNumSteps(ida, &s.steps);
    if (arc && dae.unknowns() == 0) s.arc_steps = s.steps;  // everything is given
    s.residuals = newton.counts().residuals;
    s.jacobians = newton.counts().jacobians;
    const Failures f = failures();
    s.rejected = f.error_tests + f.convergence;
    return s;
  }

  /// The unknown with the largest error estimate relative to its tolerance, of those for which `counts` is true; -1 if none.
  template <class Counts>
  int worst(Counts counts) const {
    if (on_arc) return arc->limiting_unknown();
    if (dae.unknowns() == 0 || IDAGetEstLocalErrors(ida, nw) < 0) return -1;
    int worst = -1;
    double largest = 0;
    for (std::size_t i = 0; i < work.size(); ++i) {
      const double error = std::abs(work[i]) / tolerance[i];
      if (!counts(static_cast<int>(i))) continue;
      if (std::isnan(error)) return static_cast<int>(i);
      if (error <= largest) continue;
      largest = error;
      worst = static_cast<int>(i);
    }
    return worst;
  }
};

Integrator::Integrator(Dae& dae, EventFunctions& events, const std::vector<double>& tolerance,
                       const std::vector<double>& grain, const Options& options)
    : impl_(std::make_unique<Implementation>(dae, events, tolerance, grain, options)) {}

Integrator::~Integrator() = default;

bool Integrator::begins_arc(TimePoint t, const std::vector<double>& y, TimePoint stop) {
  return impl_->arc_begins = impl_->arc && impl_->arc->begin(t, y, stop.since(t));
}

void Integrator::restart(TimePoint t, const std::vector<double>& y, const std::vector<double>& yp, double h, TimePoint stop) {
  Implementation& s = *impl_;
  s.history = statistics();
  ++s.history.restarts;
  s.y = y;
  s.yp = yp;
  s.begin = t;
  s.stop = stop;
  s.time = s.previous = 0;
  s.round_times();
  s.lost = s.lost_by_step = s.reached = 0;
  s.arc_steps = 0;
  s.on_arc = std::exchange(s.arc_begins, false);
  s.first_step = h;
  if (!s.on_arc) {
    require(IDAReInit(s.ida, 0, s.ny, s.np), "IDAReInit");
    require(IDASetInitStep(s.ida, h), "IDASetInitStep");
    require(IDASetStopTime(s.ida, s.length()), "IDASetStopTime");
    s.newton.restart();
  }
  if (!s.finder.none()) s.evaluate(s.finder.at_begin());
  s.started = true;
  s.rejected = 0;
}

void Integrator::go_on(TimePoint stop) {
  Implementation& s = *impl_;
  s.stop = stop;
  s.round_times();
  s.keep_time();
  if (!s.finder.none()) s.evaluate(s.finder.at_begin());
}

Integrator::Outcome Integrator::step() {
  const Outcome outcome = impl_->step();
  impl_->round_times();
  return outcome;
}

Integrator::Statistics& Integrator::Statistics::operator+=(const Statistics& other) {
  steps += other.steps;
  arc_steps += other.arc_steps;
  rejected += other.rejected;
  residuals += other.residuals;
  jacobians += other.jacobians;
  restarts += other.restarts;
  sparse = sparse || other.sparse;
  return *this;
}

void Integrator::limit_step(double longest) {
  impl_->longest_step = longest;
  require(IDASetMaxStep(impl_->ida, std::isfinite(longest) ? longest : 0), "IDASetMaxStep");
}

void Integrator::cut(double t, int which) {
  Implementation& s = *impl_;
  s.go_to(s.since_begin(t));
  s.round_times();
  s.finder.take(which);
}

bool Integrator::exact() const { return impl_->on_arc; }
double Integrator::time() const { return impl_->rounded_time; }
double Integrator::previous_time() const { return impl_->rounded_previous; }
const std::vector<double>& Integrator::y() const { return impl_->y; }
const std::vector<double>& Integrator::yp() const { return impl_->yp; }
const std::vector<int>& Integrator::events() const { return impl_->finder.fired(); }

void Integrator::interpolate(double t, int derivative, std::vector<double>& out) const {
  if (impl_->on_arc) {
    out.resize(impl_->y.size());
    return impl_->arc->evaluate(impl_->since_begin(t), derivative, out.data());
  }
  require(IDAGetDky(impl_->ida, impl_->since_begin(t) - impl_->lost_by_step, derivative, impl_->nw), "IDAGetDky");
  out = impl_->work;
}

int Integrator::worst_unknown() const {
  return impl_->worst([](int) { return true; });
}

int Integrator::limiting_unknown() const {
  return impl_->worst([this](int unknown) { return impl_->dae.differentiated(unknown); });
}

Integrator::Failures Integrator::failures() const { return impl_->failures(); }

int Integrator::last_order() const {
  int order = 0;
  if (!impl_->on_arc) require(IDAGetLastOrder(impl_->ida, &order), "IDAGetLastOrder");
  return order;
}

Integrator::Statistics Integrator::statistics() const {
  Statistics total = impl_->history;
  if (!impl_->started) return total;
  const Statistics now = impl_->present();
  total += now;
  return total;
}

}  // namespace rheonet
