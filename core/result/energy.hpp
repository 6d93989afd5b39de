#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/dae/state_powers.hpp"
#include "core/result/energy_so_far.hpp"
#include "core/solve/integrator.hpp"

namespace rheonet {

/// The energy account of a run: power, integrated over each step. If the powers at the last seven step ends lie on a
/// polynomial, its integral is used, without further evaluations. Otherwise the 4-point Lobatto rule integrates the powers
/// along the integrator's polynomial. An element driven at all its ends needs the adaptive 7-point Kronrod extension of that
/// rule (Gander and Gautschi, BIT 40 (2000) 84), because its motion does not limit the steps: at every step while an input
/// oscillates or will change its course, otherwise until it lies on a polynomial. Laws that know their heat in closed form provide it.
class EnergyAccount {
 public:
  /// `tolerance` is relative to the largest energy so far; `length` of the run [s]; `parts`: `so_far` will be asked for.
  EnergyAccount(double tolerance, double length, bool parts);
  /// Switches to the equations of another set of modes.
  void attach(Dae& dae, Consistency& consistency);

  /// State just after the start or an event. A gain of stored energy at the event, and `heat` [J], count as supplied.
  void begin(double t, const std::vector<double>& y, const std::vector<double>& yp, double heat);
  /// The view of the equations must be that of the end of the step.
  void step(const Integrator& integrator);

  /// Looks at the energies at a time within the last step; times ascend. The view of the equations must be that of then.
  void sample(double t);
  /// The account at the times of the samples since the last call.
  std::vector<std::pair<double, EnergySoFar>> take_samples();
  EnergySoFar so_far() const { return {supplied(), stored(), dissipated(), kinetic_, stored_ - kinetic_}; }

  double supplied() const { return sum_.supplied; }
  double dissipated() const { return sum_.dissipated; }
  double stored() const { return stored_ - stored_at_start_; }
  double largest() const { return largest_; }
  double missing() const { return supplied() - stored() - dissipated(); }

 private:
  struct Power { double supplied = 0, dissipated = 0; };
  bool solved_between_steps() const;
  Power power_at_end(const Integrator& integrator);
  Power power(const Integrator& integrator, double t);
  void remember(double t, const Power& power);
  /// The integral over a step from the powers at step ends; absent if they are too few or not smooth enough.
  std::optional<Power> from_past(double a, double b) const;
  Power along_arc(const Integrator& integrator, double a, double b);
  Power lobatto(const Integrator& integrator, double a, double b, const Power& pa, const Power& pb, int depth);

  Dae* dae_ = nullptr;
  Consistency* consistency_ = nullptr;
  double tolerance_, length_;
  bool parts_;
  bool adaptive_ = false;  ///< an element is driven at all its ends
  bool hidden_ = false;    ///< its motion may vary between steps in a way that their ends do not show
  bool needs_rates_ = true;
  bool begun_ = false;
  Power sum_, last_;  ///< last_: power at the end of the last step, or at the last `begin`
  static constexpr std::size_t remembered = 7;
  std::array<double, remembered> times_{};       ///< step ends since the last `begin`, latest first
  std::size_t known_ = 0;                        ///< number of valid entries
  std::array<Power, remembered> differences_{};  ///< divided differences of the powers at the first 1, 2, ... of `times_`
  struct Sample { double t, stored, kinetic, power, heat; };  ///< `power` is the dissipated power
  std::vector<Sample> samples_;
  /// The account at the beginning of the last step, which ended at `end`, and the dissipated power and the heat of laws there.
  struct Before { double t = 0, end = 0; Power sum; double stored = 0, power = 0, heat = 0; } before_;
  double heat_ = 0;    ///< heat of laws that know it, at the time of `last_`
  double stored_ = 0, stored_at_start_ = 0, largest_ = 0;
  double kinetic_ = 0;  ///< part of `stored_`, if `parts_`
  std::vector<double> y_, yp_;
};

}  // namespace rheonet
