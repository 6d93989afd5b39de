#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "core/network/component.hpp"
#include "core/network/dual.hpp"

namespace rheonet {

/// Defaults of a deflection law without memory. Derive a law from it and hide the members that differ:
///
///     struct Law : MemorylessLaw {
///       explicit Law(std::span<const double> values);                // in the order of the declaration
///       template <class T> T force(const T& p) const;                // f = force(p)
///       template <class T> T creep(const T& f) const;                // p' = w - creep(f)
///       double start(double d);                                      // p at the start
///       double start_with(double f);                                 // the same for a law with an initial force
///       double stored_energy(double p) const;
/// not for a lossless law, which has instead
///       static constexpr bool lossless = true;
///     };
///
/// Optional members: `force_reached(p)`, the force within its bounds, if `force` continues beyond a bound until the event
/// there; `follow(p, step)` for a memory that also changes between reversals, as the deflection goes from p to p + step;
/// `linear()`, unless the force bends between events; `steady` and `settle` for a law that creeps; `delay()` [s] for a response to past velocities; `recentre(p)` for a
/// deflection that may count from a reversal; `contact()` for a law with contacts. See DeflectionBatch.
struct MemorylessLaw {
  static constexpr bool creeping = false;
  int event_count() const { return 0; }
  template <class T>
  T creep(const T&) const {
    return T(0.0);
  }
  void event_functions(double, double, double, double, double*) const {}
  void switch_memory(int, double, double) {}
  double jump(double, double) { return 0; }
  bool set_direction(double, double, int) { return false; }
  bool can_hold() const { return false; }
  bool fits(double) const { return true; }
  bool hold(double, int) { return false; }
  bool holds() const { return false; }
  int direction() const { return 0; }
  void hold_rates(const Dual&, Dual&, Dual&) const {}
  bool constant() const { return false; }
  DeflectionBatch::Steady steady() const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {infinite, 0, infinite};
  }
  double settle(double p, double, int) { return p; }
};

/// A batch of one deflection law.
template <class Law>
class DeflectionBatchOf final : public DeflectionBatch {
 public:
  explicit DeflectionBatchOf(const Values& values) {
    laws_.reserve(values.size());
    for (const LawValues& v : values) laws_.emplace_back(v);
  }

  std::size_t size() const override { return laws_.size(); }

  void evaluate(const double* p, double* f, double* c) const override {
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      f[i] = laws_[i].force(p[i]);
      c[i] = laws_[i].creep(f[i]);
    }
  }

  void linearise(const double* p, double* f, double* df, double* c, double* dc) const override {
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      const Dual force = laws_[i].force(Dual(p[i], 1));
      const Dual creep = laws_[i].creep(force);
      f[i] = force.value;
      df[i] = force.derivative;
      c[i] = creep.value;
      dc[i] = creep.derivative;
    }
  }

  bool creeps(std::size_t) const override { return Law::creeping; }
  double delay(std::size_t i) const override {
    if constexpr (requires { laws_[i].delay(); }) return laws_[i].delay();
    return 0;
  }
  double start(std::size_t i, double d) override { return laws_[i].start(d); }
  bool starts_by_place(std::size_t i) const override {
    Law trial = laws_[i];  // a start sets its memory
    const double one = trial.start(1);
    return trial.start(0) != one;
  }
  double start_with(std::size_t i, double force) override {
    if constexpr (requires(Law law) { law.start_with(force); }) {
      return laws_[i].start_with(force);
    } else {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  int events(std::size_t i) const override { return laws_[i].event_count(); }
  void event_functions(std::size_t i, double p, double dp, double w, double dead_band, double* g) const override {
    laws_[i].event_functions(p, dp, w, dead_band, g);
  }
  void switch_memory(std::size_t i, int which, double p, double w) override {
    laws_[i].switch_memory(which, p, w);
  }
  double recentre(std::size_t i, double p) override {
    if constexpr (requires { laws_[i].recentre(p); }) return laws_[i].recentre(p);
    return 0;
  }
  double jump(std::size_t i, double p, double jump) override { return laws_[i].jump(p, jump); }
  bool set_direction(std::size_t i, double p, double w, int direction) override {
    return laws_[i].set_direction(p, w, direction);
  }
  bool fits(std::size_t i, double w) const override { return laws_[i].fits(w); }
  bool hold(std::size_t i, double p, int lean) override { return laws_[i].hold(p, lean); }
  bool holds(std::size_t i) const override { return laws_[i].holds(); }
  int direction(std::size_t i) const override { return laws_[i].direction(); }
  bool can_hold(std::size_t i) const override { return laws_[i].can_hold(); }
  void hold_rates(std::size_t i, const Dual& p, Dual& forward, Dual& backward) const override {
    laws_[i].hold_rates(p, forward, backward);
  }
  std::optional<int> contact(std::size_t i) const override {
    if constexpr (requires { laws_[i].contact(); }) return laws_[i].contact();
    return {};
  }
  double slope(std::size_t i, double p, int direction) const override {
    if constexpr (requires { laws_[i].slope_along(p, direction); }) return laws_[i].slope_along(p, direction);
    return laws_[i].force(Dual(p, 1)).derivative;
  }
  double release_slope(std::size_t i, double p) const override {
    if constexpr (requires { laws_[i].release_slope(p); }) return laws_[i].release_slope(p);
    return 0;
  }
  double force(std::size_t i, double p) const override { return laws_[i].force(p); }
  double force_along(std::size_t i, double p, double step, double& slope) const override {
    Law law = laws_[i];
    if constexpr (requires { law.follow(p, step); }) {
      law.follow(p, step);
    } else if (step != 0) {
      law.set_direction(p, step, step < 0 ? -1 : 1);
    }
    const Dual end(p + step, 1);
    const Dual f = [&] {
      if constexpr (requires { law.force_reached(end); }) return law.force_reached(end);
      return law.force(end);
    }();
    slope = f.derivative;
    return f.value;
  }
  bool linear(std::size_t i) const override {
    if constexpr (requires { laws_[i].linear(); }) return laws_[i].linear();
    return false;
  }
  bool constant(std::size_t i) const override { return laws_[i].constant(); }
  Steady steady(std::size_t i) const override { return laws_[i].steady(); }
  double settle(std::size_t i, double p, double f, int direction) override { return laws_[i].settle(p, f, direction); }
  double stored_energy(std::size_t i, double p) const override { return laws_[i].stored_energy(p); }
  double dissipated_power(std::size_t i, double p, double dp, double w) const override {
    if constexpr (lossless) return 0;
    else return laws_[i].dissipated_power(p, dp, w);
  }

  bool knows_heat() const override { return lossless; }

 private:
  static constexpr bool lossless = requires { Law::lossless; };

  std::vector<Law> laws_;
};

/// A batch of one rate law:
///
///     struct Law {
///       explicit Law(std::span<const double> values);
///       bool by_force() const;
///       bool linear() const;                                // optional: unless its growth says so
///       Growth growth() const;
///       void regularise(double w);                          // see RateBatch::regularise
///       template <class T> T force(const T& w) const;   // f = force(w)
///       template <class T> T rate(const T& f) const;    // its inverse
///     };
template <class Law>
class RateBatchOf final : public RateBatch {
 public:
  explicit RateBatchOf(const Values& values) {
    laws_.reserve(values.size());
    for (const LawValues& v : values) {
      laws_.emplace_back(v);
      by_force_.push_back(laws_.back().by_force());
    }
  }

  std::size_t size() const override { return laws_.size(); }
  bool by_force(std::size_t i) const override { return by_force_[i] != 0; }
  void set_by_force(std::size_t i, bool by_force) override { by_force_[i] = by_force; }
  void regularise(std::size_t i, double w) override { laws_[i].regularise(w); }
  bool falls(std::size_t i) const override {
    if constexpr (requires { laws_[i].falls(); }) return laws_[i].falls();
    return false;
  }
  bool linear(std::size_t i) const override {
    if constexpr (requires { laws_[i].linear(); }) return laws_[i].linear();
    return laws_[i].growth().exponent == 1;
  }
  Growth growth(std::size_t i) const override { return laws_[i].growth(); }

  void evaluate(const double* in, double* out) const override {
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      out[i] = by_force_[i] ? laws_[i].rate(in[i]) : laws_[i].force(in[i]);
    }
  }

  void linearise(const double* in, double* out, double* derivative) const override {
    for (std::size_t i = 0; i < laws_.size(); ++i) {
      const Dual x(in[i], 1);
      const Dual y = by_force_[i] ? laws_[i].rate(x) : laws_[i].force(x);
      out[i] = y.value;
      derivative[i] = y.derivative;
    }
  }

  double force_at(std::size_t i, double w) const override { return laws_[i].force(w); }
  double velocity_at(std::size_t i, double f) const override { return laws_[i].rate(f); }

 private:
  std::vector<Law> laws_;
  std::vector<char> by_force_;
};

template <class Law>
std::unique_ptr<DeflectionBatch> deflection_batch(const Values& values) {
  return std::make_unique<DeflectionBatchOf<Law>>(values);
}

template <class Law>
std::unique_ptr<RateBatch> rate_batch(const Values& values) {
  return std::make_unique<RateBatchOf<Law>>(values);
}

}  // namespace rheonet
