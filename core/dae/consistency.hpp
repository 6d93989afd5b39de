#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// What is to be known of a state before an integrator may start from it: values that satisfy every algebraic equation,
/// their derivatives, and memories of the laws that fit the motion that begins.
class Consistency {
 public:
  explicit Consistency(Dae& dae);
  ~Consistency();

  /// What a jump did beside moving the state.
  struct Jump {
    double heat = 0;                 ///< turned into heat at this instant by laws with a memory [J]
    std::vector<std::string> notes;  ///< dashpots that took an impulse
  };

  /// Takes y over the instant t: node positions that the drive has stepped (Drive::steps), forces and velocities that
  /// have jumped. Integrals keep their values, everything algebraic follows. Throws SimulationError.
  Jump jump(double t, std::vector<double>& y);

  /// Solves the algebraic equations anew, for a state between two steps.
  void project(double t, std::vector<double>& y);

  /// y' of every unknown, algebraic ones too, from the equations and their derivatives in time. Throws SimulationError.
  void derivative(double t, const std::vector<double>& y, std::vector<double>& yp);

  /// Second derivatives by a difference over `dt`.
  void second_derivative(double t, double dt, const std::vector<double>& y, const std::vector<double>& yp,
                         std::vector<double>& ypp);

  /// Estimate of the fastest rate at which the network itself changes near a state, like omega of an oscillator or 1/T of
  /// a lag [1/s]; 0 if nothing changes.
  double fastest_rate(double t, const std::vector<double>& y, const std::vector<double>& yp);

  /// Makes the memories of all laws fit the direction in which their branches are about to move, and y' fit the memories.
  /// `dt` is a time short against everything that happens. Returns the branches whose memory changed.
  std::vector<int> settle(double t, double dt, const std::vector<double>& y, std::vector<double>& yp);

 private:
  struct Factor;
  void factorise(double t, const std::vector<double>& y);
  void solve(std::vector<double>& b);
  void newton(double t, const std::vector<double>& before, const std::vector<double>& terms, std::vector<double>& y);
  void position_steps(double t, std::vector<double>& dx, std::vector<double>& impulse, std::vector<std::string>& notes);
  bool can_stand(int branch) const;
  [[noreturn]] void report_singular(double t) const;

  Dae& dae_;
  std::unique_ptr<Factor> factor_;
  std::vector<double> values_, r0_, r1_, zero_, work_;
};

}  // namespace rheonet
