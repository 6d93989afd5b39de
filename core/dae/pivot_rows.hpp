#pragma once

#include <vector>

#include "core/dae/jacobian_entries.hpp"
#include "core/dae/slip_forces.hpp"
#include "core/dae/unknown_indices.hpp"

namespace rheonet {

/// The Jacobian's rows of the pivots of trains (Structure::TrainEquation). Entries of their balances are shared by the rows of the other nodes; then
/// they make way for the equations of the trains.
class PivotRows {
 public:
  /// Both must outlive this.
  PivotRows(const UnknownIndices& index, const SlipForces& slip) : index_(index), slip_(slip) {}

  /// Reserves the entries, after all others in the rows of pivots; then takes their places in the pattern.
  void reserve(JacobianEntries& jacobian);
  void take(const Pattern& pattern, const std::vector<int>& entry_of_ticket);
  /// Shares the balances of pivots, and writes the equations of the trains in their rows.
  void tie(double* values) const;
  /// visit(entry, coefficient in dF/dy') for the shared masses.
  template <class Visit>
  void for_each_mass(Visit visit) const {
    for (const SharedMass& m : shared_masses_) visit(m.entry, -slip_.equations()[m.equation].shares[m.share].factor * m.mass);
  }

 private:
  struct SharedEntry { int from, to; std::size_t equation, share; };
  struct SharedMass { int entry; std::size_t equation, share; double mass; };

  const UnknownIndices& index_;
  const SlipForces& slip_;
  std::vector<SharedEntry> shared_entries_;
  std::vector<SharedMass> shared_masses_;        ///< Entries in the balances of pivots, in the rows that share them.
  std::vector<int> pivot_entries_;               ///< In the rows of pivots.
  std::vector<JacobianEntries::Constant> tied_;  ///< The coefficients of the equations of the trains.
};

}  // namespace rheonet
