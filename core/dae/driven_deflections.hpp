#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Deflections of the branches between prescribed nodes (Structure::driven), which are functions of time and no unknowns.
class DrivenDeflections {
 public:
  /// Both must outlive this.
  DrivenDeflections(const Structure& structure, const Inputs& inputs) : structure_(structure), inputs_(inputs), from_(structure.driven.size(), 0) {}

  /// The deflections are those of the state at t, just after Inputs::enter or mark.
  void enter(double t, const State& state);
  /// Deflection of a branch at t [m].
  double deflection(std::size_t branch, double t) const { return from_[branch] + way(structure_.deflections[branch], t); }

 private:
  double way(const Branch& ends, double t) const;

  const Structure& structure_;
  const Inputs& inputs_;
  std::vector<double> from_;  ///< For each driven branch: its deflection at the last `enter` [m].
};

}  // namespace rheonet
