#pragma once

#include <vector>

namespace rheonet::test {

/// A mass m driven by the force F sin(2 pi f t) and held by spring-slider pairs in parallel, from rest at x = 0. Between kinks the equation
/// is linear, x'' = (F sin(2 pi f t) - force - k (x - x_k))/m, and is solved by its Taylor series in long double. Yields and reversals are
/// roots of the series; every pair has its own force. No code is shared with the solver.
class IwanOscillator {
 public:
  struct Pair {
    double stiffness, coulomb, force = 0;
  };
  /// One of the pairs begins to slip, or sticks again (direction 0), at this velocity of the mass.
  struct Yield {
    double t;
    std::size_t pair;
    int direction;
    double velocity;
  };

  IwanOscillator(double mass, double force, double frequency, std::vector<Pair> pairs);

  /// Goes on to time t.
  void advance(double t);
  double position() const { return static_cast<double>(x_); }
  double velocity() const { return static_cast<double>(v_); }
  /// Of pair i.
  double force(std::size_t i) const;
  bool slips(std::size_t i) const { return rank_[i] < yielded_; }
  double dissipated() const;
  long yields() const { return yields_; }
  /// In the order of time.
  const std::vector<Yield>& history() const { return history_; }

 private:
  using Real = long double;
  void series(Real* a) const;
  void turn();

  Real m_, F_, omega_;
  std::vector<Pair> pairs_;
  Real t_ = 0, x_ = 0, v_ = 0, heat_ = 0;
  // Since the last reversal, at x_ref_ in direction s_: y are the distances to the yields, sorted.
  int s_ = 1;
  Real x_ref_ = 0;
  std::vector<Real> at_ref_;
  std::vector<std::size_t> order_, rank_;
  std::vector<Real> y_;
  std::size_t yielded_ = 0;
  Real stiffness_ = 0, total_ = 0, lost_ = 0;  ///< of the present piece: slope, force at x_, sum of yielded bounds
  long yields_ = 0;
  std::vector<Yield> history_;
};

}  // namespace rheonet::test
