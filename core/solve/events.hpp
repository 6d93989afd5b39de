#pragma once

#include <array>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/solve/integrator.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// The event functions (guards) of all laws, sliders and limiters, in one set of modes.
class NetworkEvents final : public EventFunctions {
 public:
  struct Which {
    int branch;  ///< deflection branch, slider, or limit of a block (BlockSignals::limits)
    int which;   ///< event of a deflection law, `of_slider`, `of_limit` or `of_loss`
  };
  static constexpr int of_slider = -1, of_limit = -2, of_loss = -3;

  /// `modes` are the present ones; all must outlive this.
  NetworkEvents(Dae& dae, Consistency& consistency, const Tolerances& tolerances, const Modes& modes);

  /// Call at the beginning of an interval between discontinuities. A guard violated there by round-off gets a margin, so that
  /// it does not fire at once.
  void begin(double t, const double* y, const double* yp);

  /// A law or slider that moves against the direction of its mode, at this speed [m/s].
  struct Turned { int branch; double speed; bool slides = false; };
  std::vector<Turned> turned(double t, const std::vector<double>& y, const std::vector<double>& yp);
  /// A law whose memory says that it rests, while the equations of these modes give it a velocity far above its dead band [m/s]; or that
  /// is held at rest, while its event `which` is over by as much.
  struct Contradicted { int branch; double velocity; int which = -1; };
  std::vector<Contradicted> contradicted(double t, const std::vector<double>& y, const std::vector<double>& yp);
  /// Throws SimulationError where a slider began, at t, to stick with a force far above its bound, or to slip against its force.
  void refuse_contradictions(double t, const double* y, const double* yp) const;
  /// Slipping sliders that reverse as the sliders `stopped` stop, because a node of both loses the residual slip velocity.
  std::vector<int> stopped_along(double t, const std::vector<double>& y, const std::vector<double>& yp, const std::vector<int>& stopped);

  /// True if a slider sticks that may break away, a law is held at rest, or a block has a limiter.
  bool sticks() const;
  /// True if a slider slips at a floating node. Its velocity may follow the inputs directly, without an unknown whose error
  /// test would keep steps short.
  bool slips_along() const { return slips_along_; }
  /// True if a self-locking gear stands beside other friction that sticks. The loads under which it can stand are then those of two separate
  /// ranges: on its way from one to the other a load that changes evenly may pass times at which something must slip.
  bool locked_beside_friction() const;
  /// Guards that may cross 0 and return within one step: all but those of laws, and then those of the laws that are held at rest or not in
  /// contact (DeflectionBatch::contact).
  std::vector<std::size_t> may_return() const;
  /// One of these in the state of the view.
  double guard(std::size_t k, const Dae::View& view) const;
  /// Numbers of the events of sliders, limits and losses begin here.
  std::size_t first_of_bounds_and_limits() const { return law_margin_.size(); }
  /// The view in which guards are evaluated within a step.
  const Dae::View& seen_between(double t, const double* y, const double* yp) { return any_at_rest_ ? resolved(t, y, yp) : dae_.view(t, y, yp); }
  /// The same at its end.
  const Dae::View& seen_at_end(double t, const double* y, const double* yp) { return any_at_rest_ ? resolved(t, y, yp) : dae_.view_again(t, y, yp); }
  /// Whether event k is that of a slider that slips.
  bool slips(std::size_t k) const;
  /// A slider that slips between known or massive nodes, and rate of its slip speed [m/s^2].
  bool slips_between_firm(int slider) const;
  double slip_acceleration(int slider, const Dae::View& view) const;
  /// Whether such a slider stops within this time [s].
  bool stops_within(int slider, double time, const Dae::View& view) const;

  /// True for the event of a rigid stop whose ends do not approach each other there, but for their errors.
  bool parts(std::size_t k, const Dae::View& view) const;

  int count() const override { return static_cast<int>(events_.size()); }
  void evaluate(double t, const double* y, const double* yp, double* g) override;
  double band(int k) const override;
  /// Index into Scene::elements of the element that event k belongs to.
  int element(std::size_t k) const;
  const Which& operator[](std::size_t k) const { return events_[k]; }

 private:
  struct Watched {
    DeflectionBatch* batch;
    std::size_t i;
    int branch;
    int beside = -1;  ///< pseudoplastic rate branch in parallel (infinite slope at rest), -1
    double sign = 1;  ///< -1 if that branch has the opposite direction
    bool gauge = false;              ///< It measures the displacement of a rigid stop,
    std::array<bool, 2> opens = {};  ///< whose contact has just opened, on the side of each of its events.
  };
  /// A velocity for an event function, and its dead band [m/s].
  struct Flow { double velocity, dead_band; };
  Flow flow(const Watched& law, const Dae::View& view) const;
  void find_pseudoplastic();
  const Dae::View& resolved(double t, const double* y, const double* yp);
  const Dae::View& resolved(double t, const double* y, bool projected);
  void find_returning();
  void law_functions(const Watched& law, const Dae::View& view, double* g) const;
  /// Velocity at which a rigid stop closes on the side of its event `which` [m/s], and whether that is more than its error.
  static double closing(const Watched& gauge, int which, const Dae::View& view);
  bool approaches(const Watched& gauge, int which, const Dae::View& view) const;
  void find_opening(const Dae::View& view);
  /// The event functions of a law; infinite beyond the last.
  std::array<double, numerics::held_law_events> held_functions(const Watched& law, const Dae::View& view) const;
  double slider_function(int slider, const Dae::View& view) const;
  bool moved_apart(int slider) const;
  double force_band(int slider) const;
  /// True for a sticking slider whose guard compares its force with its bounds.
  bool balances_force(int slider) const;
  double limit_function(std::size_t limit) const;
  double loss_function(std::size_t loss, const Dae::View& view) const;
  /// Guard k of the sliders, then of the limits, then of the losses, in the state of the view.
  double bound_or_limit_function(std::size_t k, const Dae::View& view) const;

  /// An event of a law that may return within one step: index of the watched law, its event, and the number among all events.
  struct Returning { std::size_t law; int which; std::size_t event; };

  Dae& dae_;
  Consistency& consistency_;
  const Tolerances& tolerances_;
  const Modes& modes_;
  bool rates_needed_ = false, slips_along_ = false;
  std::vector<double> y_, yp_;
  std::vector<Watched> watched_;
  bool gauges_ = false;      ///< any of them measures the displacement of a rigid stop
  std::vector<int> law_of_;  ///< of each event of the laws: index into `watched_`
  std::vector<int> sliders_;
  std::vector<Returning> returning_;
  bool any_at_rest_ = false;  ///< any law is held at rest
  std::vector<double> margin_;  ///< of each slider
  std::vector<double> limit_margin_;  ///< of each limit
  std::vector<int> losses_;           ///< trains whose losses slip: the side that drives them may change
  std::vector<double> loss_margin_;   ///< of each of them
  std::vector<double> law_margin_, at_begin_;  ///< of each event of the laws; event functions at `begin`
  std::vector<Which> events_;
};

}  // namespace rheonet
