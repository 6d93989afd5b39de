#include <cmath>

#include "core/netlist/characteristic.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// A dashpot whose force is a characteristic of its velocity, 0 at rest.
struct NonlinearDashpot {
  const Characteristic& curve;

  explicit NonlinearDashpot(const LawValues& v) : curve(*v.characteristic) {}

  static bool by_force() { return false; }
  static bool linear() { return false; }
  bool falls() const { return curve.falls_at().has_value(); }
  /// Far out it is linear, with the larger of its two slopes there.
  Growth growth() const { return {std::max(curve.last_slope(-1), curve.last_slope(1)), 1}; }
  void regularise(double) {}

  template <class T>
  T force(const T& w) const {
    double slope;
    const double f = curve.force(value_of(w), slope);
    return f + slope * (w - value_of(w));
  }
  /// A force that it never has gets the velocity on the straight line from the origin through the last one that it has.
  template <class T>
  T rate(const T& f) const {
    const double w = velocity(value_of(f));
    double slope;
    curve.force(w, slope);
    return slope > 0 ? w + (f - value_of(f)) / slope : T(w);
  }

 private:
  double velocity(double f) const {
    double w = curve.where(f);
    for (double less = f / 2; std::isinf(w) && less != 0; less /= 2) w = curve.where(less) * (f / less);
    return std::isinf(w) ? 0 : w;
  }
};

const RegisterComponent register_nonlinear_dashpot({
    .declaration = {.type = "nonlinear dashpot"},
    .role = Role::rate,
    .hidden = true,
    .rate = rate_batch<NonlinearDashpot>,
});

}  // namespace
}  // namespace rheonet
