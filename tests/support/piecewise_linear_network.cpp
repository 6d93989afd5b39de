#include "tests/support/piecewise_linear_network.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace rheonet::test {

namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr int order = 30;          // of the Taylor series; a step is at most as long as the fastest time constant
constexpr int samples_of_step = 16;        // of a step, for the signs of guards
constexpr std::size_t most_events = 400;

/// The motion in one set of modes: y' = A y, with y of the positions, the velocities, 1, the time, and the sine and cosine of the inputs.
struct Linear {
  Matrix rates;     ///< A
  Matrix sticking;  ///< times y: the force of each slider that sticks; rows of others are 0
  Matrix slipping;  ///< times y: the relative velocity of each slider
};

class SliderArcs {
 public:
  explicit SliderArcs(const PiecewiseLinearNetwork& network) : net_(network), n_(static_cast<Eigen::Index>(network.masses.size())), y_(2 * n_ + 4), modes_(network.sliders.size(), 0) {
    y_.setZero();
    for (Eigen::Index i = 0; i < n_; ++i) y_[n_ + i] = mass(i).velocity;
    y_[one()] = 1;
    y_[cosine()] = 1;
    longest_ = 1 / fastest();
    choose({}, 0);
  }

  SliderMotion over(const std::vector<long double>& times) {
    SliderMotion result;
    for (std::size_t row = 0; row < times.size();) {
      const long double step = std::min(longest_, times.back() - time_);
      Matrix series(y_.size(), order + 1);
      series.col(0) = y_;
      for (int k = 0; k < order; ++k) series.col(k + 1) = linear_.rates * series.col(k) / (k + 1);
      const std::optional<Crossing> crossing = first(series, step);
      const long double end = time_ + (crossing ? crossing->after : step);
      for (; row < times.size() && (times[row] < end || (!crossing && times[row] <= end)); ++row) {
        const Vector y = at(series, times[row] - time_);
        result.rows.emplace_back(y.data(), y.data() + 2 * n_);
      }
      y_ = at(series, end - time_);
      time_ = end;
      if (!crossing) continue;
      choose(crossing->slider, crossing->direction);
      result.events.push_back({time_, static_cast<int>(*crossing->slider), modes_[*crossing->slider]});
      if (result.events.size() > most_events) throw std::runtime_error("events without end");
    }
    return result;
  }

 private:
  struct Crossing {
    long double after;
    std::optional<std::size_t> slider;
    int direction;  ///< in which it begins to slip; 0 where it came to rest
  };

  const PiecewiseLinearNetwork& net_;
  Eigen::Index n_;
  Vector y_;
  std::vector<int> modes_;  ///< of each slider: -1 or 1 where it slips, 0 where it sticks
  Linear linear_;
  long double time_ = 0, longest_ = 0;

  Eigen::Index one() const { return 2 * n_; }
  Eigen::Index time() const { return 2 * n_ + 1; }
  Eigen::Index sine() const { return 2 * n_ + 2; }
  Eigen::Index cosine() const { return 2 * n_ + 3; }
  const PiecewiseLinearNetwork::Mass& mass(Eigen::Index i) const { return net_.masses[static_cast<std::size_t>(i)]; }
  long double angular() const { return 2 * std::numbers::pi_v<long double> * net_.frequency; }

  long double fastest() const {
    long double stiffest = 0, most_damped = 0;
    for (Eigen::Index i = 0; i < n_; ++i) {
      long double stiffness = 0, damping = 0;
      for (const auto& s : net_.springs) stiffness += s.a == i || s.b == i ? 2 * s.value : 0;
      for (const auto& d : net_.dashpots) damping += d.a == i || d.b == i ? 2 * d.value : 0;
      stiffest = std::max(stiffest, stiffness / mass(i).mass);
      most_damped = std::max(most_damped, damping / mass(i).mass);
    }
    return std::sqrt(stiffest) + most_damped + angular();
  }

  /// Times y: the displacement or velocity of a relative to b.
  Vector relative(int a, int b, bool velocity) const {
    Vector row = Vector::Zero(y_.size());
    const Eigen::Index first = velocity ? n_ : 0;
    row[first + a] = 1;
    if (b >= 0) row[first + b] -= 1;
    if (b == PiecewiseLinearNetwork::drive) row[velocity ? one() : time()] = -net_.drive_velocity;
    return row;
  }

  Linear linear(const std::vector<int>& modes) const {
    const Eigen::Index size = y_.size(), count = static_cast<Eigen::Index>(modes.size());
    Matrix forces = Matrix::Zero(n_, size);
    const auto resist = [&](int a, int b, const Vector& force) {
      forces.row(a) -= force.transpose();
      if (b >= 0) forces.row(b) += force.transpose();
    };
    for (const auto& s : net_.springs) resist(s.a, s.b, s.value * relative(s.a, s.b, false));
    for (const auto& d : net_.dashpots) resist(d.a, d.b, d.value * relative(d.a, d.b, true));
    for (Eigen::Index i = 0; i < n_; ++i) {
      forces(i, one()) += mass(i).force;
      forces(i, sine()) += mass(i).amplitude;
    }
    Linear result{Matrix::Zero(size, size), Matrix::Zero(count, size), Matrix(count, size)};
    std::vector<Eigen::Index> stuck;
    for (Eigen::Index s = 0; s < count; ++s) {
      const auto& slider = net_.sliders[static_cast<std::size_t>(s)];
      result.slipping.row(s) = relative(slider.a, slider.b, true).transpose();
      const int mode = modes[static_cast<std::size_t>(s)];
      if (mode == 0) stuck.push_back(s);
      else resist(slider.a, slider.b, mode * slider.sliding * Vector::Unit(size, one()));
    }
    Matrix accelerations = forces;
    for (Eigen::Index i = 0; i < n_; ++i) accelerations.row(i) /= mass(i).mass;
    if (!stuck.empty()) {
      const Eigen::Index held = static_cast<Eigen::Index>(stuck.size());
      Matrix joined(held, n_), spread(n_, held);  // accelerations that are 0; accelerations by sticking forces of 1
      for (Eigen::Index k = 0; k < held; ++k) joined.row(k) = result.slipping.row(stuck[static_cast<std::size_t>(k)]).segment(n_, n_);
      for (Eigen::Index i = 0; i < n_; ++i) spread.row(i) = joined.col(i).transpose() / mass(i).mass;
      const Matrix sticking = (joined * spread).partialPivLu().solve(joined * accelerations);
      accelerations -= spread * sticking;
      for (Eigen::Index k = 0; k < held; ++k) result.sticking.row(stuck[static_cast<std::size_t>(k)]) = sticking.row(k);
    }
    result.rates.block(0, n_, n_, n_).setIdentity();
    result.rates.middleRows(n_, n_) = accelerations;
    result.rates(time(), one()) = 1;
    result.rates(sine(), cosine()) = angular();
    result.rates(cosine(), sine()) = -angular();
    return result;
  }

  static Vector at(const Matrix& series, long double t) {
    Vector sum = series.col(order);
    for (int k = order; k-- > 0;) sum = sum * t + series.col(k);
    return sum;
  }

  /// The first guard that falls below 0 within a step.
  std::optional<Crossing> first(const Matrix& series, long double step) const {
    std::optional<Crossing> found;
    const auto look = [&](const Vector& guard, std::size_t slider, int direction) {
      const Vector terms = series.transpose() * guard;
      const auto value = [&](long double t) {
        long double sum = terms[order];
        for (int k = order; k-- > 0;) sum = sum * t + terms[k];
        return sum;
      };
      for (int j = 1; j <= samples_of_step; ++j) {
        long double low = step * (j - 1) / samples_of_step, high = step * j / samples_of_step;
        if (found && low > found->after) return;
        if (value(high) >= 0) continue;
        for (int halving = 0; halving < 70; ++halving) (value((low + high) / 2) < 0 ? high : low) = (low + high) / 2;
        if (!found || high < found->after) found = {high, slider, direction};
        return;
      }
    };
    for (std::size_t s = 0; s < modes_.size(); ++s) {
      const Eigen::Index row = static_cast<Eigen::Index>(s);
      if (modes_[s] != 0) {
        look(modes_[s] * linear_.slipping.row(row).transpose(), s, 0);
        continue;
      }
      const Vector bound = net_.sliders[s].bound() * Vector::Unit(y_.size(), one());
      for (const int side : {-1, 1}) look(bound - side * linear_.sticking.row(row).transpose(), s, side);
    }
    return found;
  }

  /// The modes after an event of a slider, which begins to slip in a direction, or came to rest (0); at the start of no slider. It sticks
  /// where it could both stick and slip. Where that is so of another one, the law leaves the motion open.
  void choose(std::optional<std::size_t> of, int direction) {
    std::vector<std::size_t> free;
    for (std::size_t s = 0; s < modes_.size(); ++s) {
      const auto& slider = net_.sliders[s];
      const long double velocity = relative(slider.a, slider.b, true).dot(y_);
      if (s == of && direction != 0) modes_[s] = direction;
      else if (s == of || (of ? modes_[s] == 0 : velocity == 0)) free.push_back(s);
      else if (!of) modes_[s] = velocity > 0 ? 1 : -1;
    }
    int combinations = 1;
    for (std::size_t k = 0; k < free.size(); ++k) combinations *= 3;
    std::vector<std::vector<int>> fitting;
    for (int combination = 0; combination < combinations; ++combination) {
      std::vector<int> modes = modes_;
      int rest = combination;
      for (const std::size_t s : free) {
        modes[s] = rest % 3 - 1;
        rest /= 3;
      }
      if (fits(modes, free)) fitting.push_back(std::move(modes));
    }
    const auto sticking = [](const std::vector<int>& modes) { return std::count(modes.begin(), modes.end(), 0); };
    const auto best = std::max_element(fitting.begin(), fitting.end(), [&](const auto& one, const auto& other) { return sticking(one) < sticking(other); });
    if (best == fitting.end()) throw std::runtime_error("no modes fit");
    for (const std::vector<int>& modes : fitting) {
      for (std::size_t s = 0; s < modes.size(); ++s)
        if (s != of && modes[s] != (*best)[s]) throw std::runtime_error("several modes fit");
    }
    modes_ = *best;
    linear_ = linear(modes_);
  }

  bool fits(const std::vector<int>& modes, const std::vector<std::size_t>& free) const {
    const Linear system = linear(modes);
    const Vector rate = system.rates * y_;
    for (const std::size_t s : free) {
      const Eigen::Index row = static_cast<Eigen::Index>(s);
      if (modes[s] == 0 ? std::abs(system.sticking.row(row).dot(y_)) > net_.sliders[s].bound() : modes[s] * system.slipping.row(row).dot(rate) <= 0) return false;
    }
    return true;
  }
};

std::string node(int index) {
  return index == PiecewiseLinearNetwork::ground ? "ground" : index == PiecewiseLinearNetwork::drive ? "drive" : fmt::format("n{}", index);
}

std::string number(long double value) { return fmt::format("{:.17g}", static_cast<double>(value)); }

}  // namespace

SliderMotion move(const PiecewiseLinearNetwork& network, const std::vector<long double>& times) { return SliderArcs(network).over(times); }

std::string netlist_of(const PiecewiseLinearNetwork& network, double stop, int points, const std::string& method, double accuracy) {
  std::string elements = "[elements]\n", nodes = "[nodes]\n", records;
  const auto add = [&](const std::string& name, const std::string& type, int a, int b, const std::string& values) {
    elements += fmt::format("{} = {{ type = \"{}\", between = [\"{}\", \"{}\"], {} }}\n", name, type, node(a), node(b), values);
  };
  for (std::size_t i = 0; i < network.masses.size(); ++i) {
    const PiecewiseLinearNetwork::Mass& mass = network.masses[i];
    elements += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = {1} }}\n", i, number(mass.mass));
    elements += fmt::format("f{0} = {{ type = \"force\", at = \"n{0}\", force = {{ sine = {1}, frequency = {2}, offset = {3} }} }}\n", i, number(mass.amplitude),
                            number(network.frequency), number(mass.force));
    nodes += fmt::format("n{} = {{ velocity = {} }}\n", i, number(mass.velocity));
  }
  for (const char* const what : {"position", "velocity"}) {
    for (std::size_t i = 0; i < network.masses.size(); ++i) records += fmt::format("{}\"n{}.{}\"", records.empty() ? "" : ", ", i, what);
  }
  bool driven = false;
  const auto drives = [&](int end) { driven = driven || end == PiecewiseLinearNetwork::drive; };
  for (std::size_t s = 0; s < network.springs.size(); ++s) {
    const PiecewiseLinearNetwork::Branch& spring = network.springs[s];
    add(fmt::format("k{}", s), "spring", spring.a, spring.b, "stiffness = " + number(spring.value));
    drives(spring.b);
  }
  for (std::size_t s = 0; s < network.dashpots.size(); ++s) {
    const PiecewiseLinearNetwork::Branch& dashpot = network.dashpots[s];
    add(fmt::format("c{}", s), "dashpot", dashpot.a, dashpot.b, "damping = " + number(dashpot.value));
    drives(dashpot.b);
  }
  for (std::size_t s = 0; s < network.sliders.size(); ++s) {
    const PiecewiseLinearNetwork::Slider& slider = network.sliders[s];
    add(fmt::format("s{}", s), "slider", slider.a, slider.b, "coulomb = " + number(slider.sliding) + (slider.breakaway > 0 ? ", breakaway = " + number(slider.breakaway) : ""));
    drives(slider.b);
  }
  if (driven) elements += fmt::format("pull = {{ type = \"motion\", at = \"drive\", velocity = {} }}\n", number(network.drive_velocity));
  return fmt::format("{}{}[simulate]\nstop = {:.17g}\noutput = {{ points = {} }}\nmethod = \"{}\"\naccuracy = {}\nrecord = [{}]\n", elements, nodes, stop, points,
                     method, accuracy, records);
}

}  // namespace rheonet::test
