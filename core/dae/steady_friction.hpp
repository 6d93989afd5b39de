#pragma once

#include <algorithm>
#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"

namespace rheonet {

/// Forces of the sliders in steady motion. Some depend on the speed, through blocks.
class SteadyFriction {
 public:
  /// `sensed`: the present trial of the state that blocks sense. All must outlive this.
  SteadyFriction(const Network& network, Inputs& inputs, const State& sensed);

  /// Force of a slider that slips to one side, as a function of its speed: a tangent where that rises, a constant where it would fall.
  struct Curve {
    double speed, force, slope;
    double at(double faster) const { return std::max(0.0, force + slope * (faster - speed)); }
    double slope_at(double faster) const { return at(faster) > 0 ? slope : 0; }
  };
  /// Friction around the velocity w, or around that of the present trial.
  Curve around(std::size_t slider, int side, double w) const;
  /// A displacement that has a bound cannot change for ever in its direction.
  double bound(std::size_t slider, int side) const {
    return network_.sliders[slider].train >= 0 && !losses_known_ ? 0 : around(slider, side, 0).at(0);
  }
  /// Its bounds depend on its own velocity; that any do.
  bool follows_speed(std::size_t slider) const { return follows_[slider] >= 0; }
  bool any_follows_speed() const { return std::any_of(follows_.begin(), follows_.end(), [](NodeId node) { return node >= 0; }); }
  /// Takes friction at each velocity, not the tangent at the last trial.
  void go_along_curves(bool along) { along_curves_ = along; }
  bool along_curves() const { return along_curves_; }
  /// The first balance is without losses of trains.
  bool losses_known() const { return losses_known_; }
  void know_losses() { losses_known_ = true; }
  /// Sliders that move in these directions break away. True if any of them had held more than its sliding force until now.
  bool break_away(const std::vector<int>& direction);

 private:
  Bounds bounds_at(std::size_t slider, int side, double w) const;

  const Network& network_;
  Inputs& inputs_;
  const State& sensed_;
  std::vector<NodeId> follows_;  ///< For each slider whose bounds depend on its own velocity: the end whose velocity they are evaluated with; else -1.
  std::vector<char> broken_;     ///< For each slider: it has broken away.
  bool losses_known_, along_curves_ = false;
};

}  // namespace rheonet
