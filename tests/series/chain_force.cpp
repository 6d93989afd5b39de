#include "tests/series/chain_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rheonet::test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Gauss' rule of five points.
constexpr std::array<std::pair<double, double>, 5> gauss = {{{-0.9061798459386640, 0.2369268850561891},
                                                             {-0.5384693101056831, 0.4786286704993665},
                                                             {0, 0.5688888888888889},
                                                             {0.5384693101056831, 0.4786286704993665},
                                                             {0.9061798459386640, 0.2369268850561891}}};

class Force {
 public:
  explicit Force(const Chain& chain) : chain_(chain), speed_(std::abs(chain.speed)) {
    for_each([&](const Chain::Member& m) {
      if (m.has("coulomb")) weakest_ = std::min(weakest_, m.value("coulomb"));
      compliant_ = compliant_ || m.has("stiffness");
    });
    balanced_ = balanced();
    end_ = std::min(weakest_, balanced_);
  }

  std::vector<double> at(const std::vector<double>& times) {
    const double direction = std::copysign(1, chain_.speed);
    std::vector<double> result;
    for (const double t : times) result.push_back(direction * (compliant_ ? rising(t) : end_));
    return result;
  }

 private:
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& stage : chain_.stages) visit(stage.front());
  }
  static double flow(const Chain::Member& m) { return m.has("flow_index") ? 1 / m.value("flow_index") : 1; }

  /// The force at which dashpots take up the whole velocity, by halves of its logarithm; infinite without any.
  double balanced() const {
    const auto rate = [&](double f) {
      double sum = 0;
      for_each([&](const Chain::Member& m) {
        if (m.has("damping")) sum += std::pow(f / m.value("damping"), flow(m));
      });
      return sum;
    };
    if (rate(1) == 0) return infinity;
    double low = -150, high = 150;
    for (int k = 0; k < 100; ++k) (rate(std::exp((low + high) / 2)) < speed_ ? low : high) = (low + high) / 2;
    return std::exp((low + high) / 2);
  }

  /// dt/ds with f = end (1 - exp(-s)).
  double slowness(double s) const {
    const double q = std::exp(-s), share = -std::expm1(-s);  // of the way to the end: left, done
    double compliance = 0, left = balanced_ <= weakest_ ? 0 : speed_;
    for_each([&](const Chain::Member& m) {
      if (m.has("damping")) {
        const double at_end = std::pow(end_ / m.value("damping"), flow(m));
        // Where the dashpots end it, V - r is counted from there, so that a small rest keeps its digits.
        const double log_share = q < 0.5 ? std::log1p(-q) : std::log(share);
        left -= balanced_ <= weakest_ ? at_end * std::expm1(flow(m) * log_share) : at_end * std::pow(share, flow(m));
      }
      if (!m.has("stiffness")) return;
      const bool solid = m.has("coulomb");
      const double u = !solid ? 1 : m.value("coulomb") == end_ ? q : 1 - end_ * share / m.value("coulomb");
      compliance += (solid ? std::pow(u, -m.value("exponent")) : 1) / m.value("stiffness");
    });
    return compliance * end_ * q / left;
  }
  double integral(double from, double to) const {
    const double half = (to - from) / 2, middle = from + half;
    double sum = 0;
    for (const auto& [x, weight] : gauss) sum += weight * slowness(middle + half * x);
    return half * sum;
  }

  double rising(double t) {
    constexpr double first = 1e-16, growth = 1.25, longest = 0.05, most = 38;  // exp(-38) is below rounding
    if (t <= 0) return 0;
    if (std::isinf(end_)) {
      double compliance = 0;
      for_each([&](const Chain::Member& m) { compliance += 1 / m.value("stiffness"); });
      return speed_ * t / compliance;
    }
    while (times_.back() < t && places_.back() < most) {
      const double s = places_.back(), next = s == 0 ? first : std::min(s * growth, s + longest);
      times_.push_back(times_.back() + integral(s, next));
      places_.push_back(next);
    }
    if (times_.back() < t) return end_;
    const auto k = static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), t) - times_.begin()) - 1;
    double low = places_[k], high = places_[k + 1];
    for (int n = 0; n < 60; ++n) (times_[k] + integral(places_[k], (low + high) / 2) < t ? low : high) = (low + high) / 2;
    return -end_ * std::expm1(-low);
  }

  const Chain& chain_;
  double speed_, weakest_ = infinity, balanced_ = infinity, end_ = infinity;
  bool compliant_ = false;
  std::vector<double> times_{0}, places_{0};  ///< t(s), as far as it has been needed
};

}  // namespace

std::vector<double> force_of_steady_chain(const Chain& chain, const std::vector<double>& times) { return Force(chain).at(times); }

}  // namespace rheonet::test
