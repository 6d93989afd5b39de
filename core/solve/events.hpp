#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/solve/integrator.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Event functions of all laws and sliders that have any, along the equations of one mode.
class NetworkEvents final : public EventFunctions {
 public:
  struct Which {
    int branch;  ///< deflection branch, or slider, or limit of a block (BlockSignals::limits)
    int which;   ///< event of a deflection law; or one of the next
  };
  static constexpr int of_slider = -1, of_limit = -2;

  /// `modes` are the present ones; all must outlive this.
  NetworkEvents(Dae& dae, Consistency& consistency, const Tolerances& tolerances, const Modes& modes);

  /// At the beginning of a stretch: what is beyond a bound there is so by rounding, and the bound gives way as far. Throws
  /// SimulationError where it is not.
  void begin(double t, const double* y, const double* yp);

  /// A law, or a slider, that moves against its direction, at this speed [m/s].
  struct Turned { int branch; double speed; bool slides = false; };
  std::vector<Turned> turned(double t, const std::vector<double>& y, const std::vector<double>& yp);
  /// Sliders that slip as slowly as others stop: as these (`stopped`) come to rest they would move against their direction.
  std::vector<int> stopped_along(double t, const std::vector<double>& y, const std::vector<double>& yp, const std::vector<int>& stopped);

  /// Sliders stick here that may break away, friction rests, or blocks limit what they take in.
  bool sticks() const;
  /// A slider slips here at a node that only springs and friction hold: its velocity may follow a drive at once, without an
  /// unknown that would keep steps short.
  bool slips_along() const { return slips_along_; }
  /// A force may go beyond a bound, or a mass back against what it slips on, and come back within one step: the first such
  /// instant in the last step, and the event that it is. `end`: the view of the end of the step, which it is afterwards too.
  struct Missed { double t; int which; };
  std::optional<Missed> missed(const Integrator& integrator, const Dae::View& end);

  int count() const override { return static_cast<int>(events_.size()); }
  void evaluate(double t, const double* y, const double* yp, double* g) override;
  double band(int k) const override;
  /// The element of the scene that it is of.
  int element(std::size_t k) const;
  const Which& operator[](std::size_t k) const { return events_[k]; }

 private:
  struct Watched {
    DeflectionBatch* batch;
    std::size_t i;
    int branch;
    int beside = -1;  ///< rate branch between the same ends, of infinite slope at rest
    double sign = 1;  ///< -1: that goes the other way
  };
  /// A velocity as an event function takes it, and what of it is noise [m/s].
  struct Flow { double velocity, noise; };
  Flow flow(const Watched& law, const Dae::View& view) const;
  void find_pseudoplastic();
  const Dae::View& resolved(double t, const double* y, const double* yp);
  const Dae::View& resolved(double t, const double* y, bool projected);
  void all_at(const Dae::View& view, std::vector<double>& g) const;
  /// Fills left_, middle_ and right_.
  void look_at_step(const Integrator& integrator, double a, double b);
  double at_time(const Integrator& integrator, double t, std::size_t k);
  /// Between the ends of steps, where forces may go beyond bounds and come back.
  const Dae::View& seen_between(double t, const double* y, const double* yp);
  /// An event of friction at rest: of a watched law, and its number among all events.
  struct Held { std::size_t law; int which; std::size_t event; };
  void find_held();
  double held_function(const Held& held, const Dae::View& view) const;
  /// A slider that slips between what has a momentum or moves as it is told to: its number among all and among the watched, how
  /// its velocity changes at the end of the last step [m/s^2], and whether it had a least value within that.
  struct Slipping { int slider; std::size_t watched; double slope; bool dips; };
  double slope(const Slipping& one, const Dae::View& view) const;
  bool any_dips(const Dae::View& end);
  /// Of the sliders and limits, then of friction at rest.
  double looked_at(std::size_t i, const Dae::View& view) const;
  double slider_function(int slider, const Dae::View& view) const;
  bool moved_apart(int slider) const;
  double force_band(int slider) const;
  [[noreturn]] void report_against_force(double t, int slider) const;
  double limit_function(std::size_t limit) const;
  /// Of sliders, then of limits, in the state of the view.
  std::size_t suddens() const { return sliders_.size() + limit_margin_.size(); }
  double sudden_function(std::size_t k, const Dae::View& view) const;

  Dae& dae_;
  Consistency& consistency_;
  const Tolerances& tolerances_;
  const Modes& modes_;
  bool rates_needed_ = false, slips_along_ = false;
  std::vector<double> y_, yp_;
  std::vector<Watched> watched_;
  std::vector<int> sliders_;
  std::vector<Held> held_;
  std::vector<Slipping> slipping_;
  std::vector<double> step_y_, step_yp_;
  std::vector<double> left_, middle_, right_;  ///< event functions of the sliders, limits and friction at rest over a step
  static constexpr double not_looked = std::numeric_limits<double>::quiet_NaN();
  double right_time_ = not_looked;  ///< of right_, since the last `begin`
  std::vector<double> margin_;  ///< of each slider
  std::vector<double> limit_margin_;  ///< of each limit
  std::vector<double> law_margin_, at_begin_;  ///< of each event of the laws; event functions
  std::vector<Which> events_;
};

}  // namespace rheonet
