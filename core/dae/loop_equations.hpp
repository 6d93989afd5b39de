#pragma once

#include <span>
#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/jacobian_entries.hpp"
#include "core/dae/unknown_indices.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// The equations of loops, sum +-(p' + creep) + sum +-v = 0, in the rows of their closing branches; and those of integrated positions,
/// x' - velocity = 0. A loop of a delayed branch has the velocity that it feels, too.
class LoopEquations {
 public:
  /// `moving`: 1 for each deflection branch, 0 while it is held at rest. All must outlive this.
  LoopEquations(const Network& network, const Structure& structure, const Positions& positions, const Inputs& inputs, const UnknownIndices& index,
                const std::vector<double>& moving);

  /// Reserves the entries of the Jacobian, then takes their places in its pattern.
  void reserve(JacobianEntries& jacobian);
  void take(const std::vector<int>& entry_of_ticket);

  /// `v`: velocity of each node; `creep`: of each deflection branch.
  void residual(const std::vector<double>& v, const std::vector<double>& creep, const double* yp, double* r) const;
  /// Adds the magnitudes of the velocities in each row.
  void add_magnitudes(const std::vector<double>& v, double* r) const;
  /// Adds the parts of dF/dy that change; `creep_slope`: derivative of each creep by its deflection.
  void add_jacobian(const std::vector<double>& creep_slope, double* values) const;
  /// visit(entry, coefficient in dF/dy') for those that change.
  template <class Visit>
  void for_each_mass(Visit visit) const {
    for (const FlowEntry& f : flow_entries_) visit(f.entry, f.sign * moving_[at(f.branch)]);
  }
  /// Adds dF/dt at constant y to the algebraic rows: loops in which all branches are held at rest. `a`: acceleration of each known node.
  void add_time_derivative(const std::vector<double>& a, const std::vector<char>& differential, double* r) const;

  /// visit(row, node, sign) for each velocity in a row.
  template <class Visit>
  void for_each_velocity(Visit visit) const {
    for (const Row& row : rows_) {
      for (const auto& [node, sign] : velocities(row.terms)) visit(row.row, node, sign);
    }
  }

 private:
  /// Terms [flow_begin, flow_end) of flows_ and [velocity_begin, velocity_end) of velocities_.
  struct Terms { int flow_begin, flow_end, velocity_begin, velocity_end; };
  /// Equation of a loop or position, less the velocity that a delayed branch feels (index into Inputs::felt, -1: none).
  struct Row { int row; bool position; Terms terms; int delayed; };
  /// p' + creep of a branch, whose deflection is this unknown.
  struct Flow { int branch, unknown; double sign; };
  struct FlowEntry { int entry, branch; double sign; };
  /// An entry due to the present velocity that a delayed branch feels.
  struct FeltEntry { int entry, delayed; double sign; };
  void add_row(int row, bool position, const Structure::Loop& loop);
  Terms add_terms(const Structure::Loop& loop);
  std::span<const Structure::Term> velocities(const Terms& terms) const {
    return std::span(velocities_).subspan(at(terms.velocity_begin), at(terms.velocity_end - terms.velocity_begin));
  }
  double sum_of(const Terms& terms, const double* v, const double* creep, const double* yp) const;

  const Network& network_;
  const Structure& structure_;
  const Inputs& inputs_;
  const UnknownIndices& index_;
  const std::vector<double>& moving_;
  std::vector<Row> rows_;
  /// For each delayed branch, the negated present velocity of its free ends. These ends are masses (otherwise no step is longer
  /// than the delay).
  std::vector<Terms> felt_terms_;
  // The terms of Terms.
  std::vector<Flow> flows_;
  std::vector<Structure::Term> velocities_;  ///< Of nodes.
  // Coefficients that vanish while their branch is held at rest.
  std::vector<FlowEntry> flow_entries_;    ///< Entries of p'.
  std::vector<FlowEntry> creep_entries_;   ///< Entries of the slope of its creep.
  std::vector<FeltEntry> felt_entries_;
};

}  // namespace rheonet
