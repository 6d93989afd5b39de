#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/solve/events.hpp"
#include "core/solve/integrator.hpp"

namespace rheonet {

/// Events within a step that the guards at its ends do not show. A force may exceed its bound and return; a slipping mass may reverse and
/// return; a contact may close and open again.
class MissedEvents {
 public:
  /// Both must outlive this.
  MissedEvents(Dae& dae, NetworkEvents& events);
  /// Call at the beginning of an interval between discontinuities, after NetworkEvents::begin.
  void begin(double t, const double* y, const double* yp);
  /// The first such event in the last step. `end` is the view of the end of the step, which is the current view afterwards too. Guards are looked
  /// at in the middle of the step, and at the `hidden` times of inputs.
  struct Missed { double t; int which; };
  std::optional<Missed> find(const Integrator& integrator, const Dae::View& end, const std::vector<double>& hidden);

 private:
  /// A slider that slips between known or massive nodes, and the number of its guard. `slope`: rate of its slip speed at the end of
  /// the last step [m/s^2]. `dips`: that speed had a minimum within the step.
  struct Slipping { int slider; std::size_t event; double slope; bool dips; };
  bool any_dips(const Dae::View& end);
  /// Finds left_, middle_ and right_ over the step from a to b.
  void look_at_step(const Integrator& integrator, double a, double b);
  double at_time(const Integrator& integrator, double t, std::size_t event);
  /// The time between these at which the guard crosses 0 [s].
  double crossing(const Integrator& integrator, double positive, double negative, std::size_t event);
  void all_at(const Dae::View& view, std::vector<double>& g) const;

  Dae& dae_;
  NetworkEvents& events_;
  std::vector<std::size_t> watched_;  ///< numbers of the guards that are looked at: of sliders, limits and losses, then of laws
  std::vector<Slipping> slipping_;
  std::vector<double> step_y_, step_yp_;
  std::vector<double> left_, middle_, right_;  ///< these guards over a step
  static constexpr double not_looked = std::numeric_limits<double>::quiet_NaN();
  double right_time_ = not_looked;    ///< time of right_, since the last `begin`
};

}  // namespace rheonet
