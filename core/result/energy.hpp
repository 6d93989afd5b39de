#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/solve/integrator.hpp"

namespace rheonet {

/// The energy account of a run: power integrated over each step. Where the powers at the last seven steps' ends lie on a
/// polynomial it is that which is integrated, which takes no evaluation; else the powers that follow from the integrator's
/// polynomial, by the 4-point Lobatto rule; where an element is driven on all sides (steps are then longer than what happens in it) by its adaptive 7-point
/// Kronrod extension (Gander and Gautschi, BIT 40 (2000) 84). Laws that know their heat in closed form are asked for it.
class EnergyAccount {
 public:
  /// `tolerance` is relative to the largest energy so far; `length`: of the run [s].
  EnergyAccount(double tolerance, double length);
  /// Goes over to these equations.
  void attach(Dae& dae, Consistency& consistency);

  /// Just after the start or an event. What is stored more than before was supplied in that instant, with the heat.
  void begin(double t, const std::vector<double>& y, const std::vector<double>& yp, double heat);
  /// With the view of the equations that of the end of the step.
  void step(const Integrator& integrator);

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
  /// The same as `lobatto` from the powers at steps' ends; absent if these are too few, or on no polynomial.
  std::optional<Power> from_past(double a, double b) const;
  Power lobatto(const Integrator& integrator, double a, double b, const Power& pa, const Power& pb, int depth);

  Dae* dae_ = nullptr;
  Consistency* consistency_ = nullptr;
  double tolerance_, length_;
  bool adaptive_ = false;
  bool needs_rates_ = true;
  bool begun_ = false;
  Power sum_, last_;  ///< last_: power at the end of the last step, or at the last `begin`
  static constexpr std::size_t remembered = 7;
  std::array<double, remembered> times_{};       ///< ends of the last steps since the last `begin`, the last one first
  std::size_t known_ = 0;                        ///< of these
  std::array<Power, remembered> differences_{};  ///< of the powers at the first one, two, ... of these, divided
  double heat_ = 0;    ///< of the laws that know it, when `last_` was
  double stored_ = 0, stored_at_start_ = 0, largest_ = 0;
  std::vector<double> y_, yp_;
};

}  // namespace rheonet
