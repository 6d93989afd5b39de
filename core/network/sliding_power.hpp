#pragma once

#include "core/netlist/switched_function.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Power that a slider turns into heat [W], a function of its velocity and of its parameters that vary, in their order: its sliding force times its speed, and
/// 0 while it sticks. Its kink at rest needs no switch: the slider has an event there.
class SlidingPower final : public SwitchedFunction {
 public:
  explicit SlidingPower(const Network::Slider& slider) : component_(slider.component), box_(slider.box), values_(slider.values), varying_(slider.varying) {}

  std::size_t variables() const override { return varying_.size() + 2; }  // and the time
  std::size_t switches() const override { return 0; }
  bool uses(std::size_t variable) const override { return variable <= varying_.size(); }
  std::string text() const override { return "power of a slider"; }

  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides = {}) const override;
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const override;
  bool complete_sides(std::span<const double>, std::span<double>) const override { return true; }
  bool cross(std::size_t, std::span<const double>, std::span<double>) const override { return true; }
  bool switching_functions(std::span<const double>, std::span<const double>, std::span<double>) const override { return true; }

 private:
  /// The sliding force, and its slope by one of the parameters that vary (-1: none).
  Dual force(std::span<const double> arguments, int by) const;

  const Component* component_;
  Box box_;
  std::vector<double> values_;
  std::vector<Network::VaryingParameter> varying_;
};

}  // namespace rheonet
