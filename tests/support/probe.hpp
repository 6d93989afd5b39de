#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/dae/event_transition.hpp"
#include "core/dae/start.hpp"

namespace rheonet::test {

using Visit = std::function<void(double t, const std::vector<double>& y, const std::vector<double>& yp)>;

/// The network and the equations of a scene, set up as in `run`.
class Probe {
 public:
  /// Just after the first instant.
  explicit Probe(const Scene& scene);

  /// The equations at the start; while `along` visits, those that hold then.
  Dae& dae() { return *current_; }
  const Network& network() const { return network_; }
  const Structure& structure() const { return current_->structure(); }
  /// The state at the start, its derivative, and what its instant did.
  const std::vector<double>& y() const { return y_; }
  const std::vector<double>& yp() const { return yp_; }
  const EventChange& change() const { return change_; }

  /// Integrates the scene and visits `samples` instants within every `every`th step. y' belongs to y by the equations
  /// themselves, not by the integrator's polynomial; the laws have the memories of that instant.
  void along(int every, int samples, const Visit& visit);

 private:
  Scene scene_;  // its own: a network keeps a pointer to it
  Network network_;
  Structure classified_;
  Start start_;
  Modes modes_;
  EventChange change_;
  Structure structure_;
  std::unique_ptr<Dae> dae_;
  Dae* current_;
  std::vector<double> y_, yp_;
};

/// A derivative by central differences at h and h/2 (Richardson extrapolation). `doubt` is how far they are apart, or
/// the angle of a kink at x, which both would miss.
struct Difference {
  double value = 0, doubt = 0;
};
template <class F>
Difference difference_at(F f, double x, double h) {
  const double middle = f(x), far_up = f(x + h), far_down = f(x - h), up = f(x + h / 2), down = f(x - h / 2);
  const double coarse = (far_up - far_down) / (2 * h), fine = (up - down) / h;
  // A second difference over h is f'' h on a smooth curve, and the angle itself on a kink.
  const double kink = 4 * (up - 2 * middle + down) / h - (far_up - 2 * middle + far_down) / h;
  // Each value is known to some units in its last place.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * (std::abs(up) + std::abs(down)) / h;
  return {fine + (fine - coarse) / 3, std::max({std::abs(fine - coarse), std::abs(kink), rounding})};
}

/// The same from h on downwards, until the doubt is no more than `enough`.
template <class F>
Difference difference(F f, double x, double h, double enough) {
  Difference result = difference_at(f, x, h);
  for (int k = 0; k < 5 && result.doubt > enough; ++k) result = difference_at(f, x, h /= 10);
  return result;
}

}  // namespace rheonet::test
