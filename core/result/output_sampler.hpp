#pragma once

#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// An element with a displacement of its own between the ends of a displacement record. The difference of two positions
/// would lose the digits of a small displacement. -1: there is no such element. `sign` is -1 if its ends are swapped.
struct Gauge { int element = -1; double sign = 1; };

/// For each node, whether a record, claim or block needs its position.
std::vector<char> needed_positions(const Network& network);

/// Evaluates records of a scene from states of its DAE.
class OutputSampler {
 public:
  OutputSampler(const Network& network, const std::vector<Record>& records);
  /// Switches to the equations of another set of modes. Throws SimulationError if they do not determine a record: the
  /// acceleration of a node without mass that only springs hold.
  void attach(Dae& dae, Consistency& consistency);

  /// The value of each record [SI] in a consistent state. A state inside an integrator step is consistent to the tolerance
  /// only: with `rate`, the inverse of the step, the unknowns are made consistent where that matters.
  const std::vector<double>& read(double t, const std::vector<double>& y, const std::vector<double>& yp,
                                  double rate = 0);
  /// Throws SimulationError if a function among the blocks has no value at t or later, which is why a record has none.
  void refuse_undefined(double t) const;

 private:
  const std::vector<double>& read_state(double t, const std::vector<double>& y, const std::vector<double>& yp, bool exact);
  double value(std::size_t operand, const Dae::View& view, const std::vector<double>& rates) const;
  // element_values.cpp
  double element_force(int element, const Dae::View& view) const;
  double force_beside(int element) const;
  double loss_force(int train, const Dae::View& view) const;
  double element_velocity(int element, const Dae::View& view) const;
  double dissipated_power(int element, const Dae::View& view) const;
  double stored_energy(int element, const Dae::View& view) const;
  bool follow_acceleration(NodeId node) const;
  double acceleration(NodeId node, const Dae::View& view, const std::vector<double>& rates) const;
  double position(NodeId node, const Dae::View& view) const;
  double velocity(NodeId node, const Dae::View& view) const;
  double displacement(std::size_t operand, const Dae::View& view) const;
  double velocity(const Record& record, const Dae::View& view) const;

  const Network& network_;
  const Scene& scene_;
  const std::vector<Record>& records_;
  const std::vector<const Record*> operands_;  ///< of all records, in their order; a record that is no expression is its own
  const std::vector<Gauge> gauges_;            ///< of each operand
  Dae* dae_ = nullptr;
  Consistency* consistency_ = nullptr;
  bool bent_ = false;          ///< some massless node is out of balance between steps
  bool rates_needed_ = false;  ///< a record needs y' from the equations, not from the integrator's polynomial
  std::vector<double> y_, slope_, yp_, values_, row_;
};

}  // namespace rheonet
