#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/loop_equations.hpp"
#include "core/dae/matrix.hpp"
#include "core/dae/slip_forces.hpp"
#include "core/dae/unknown_indices.hpp"

namespace rheonet {

/// The entries of the Jacobian due to blocks: through their states, and through the forces, velocities and parameters that they give.
class BlockEntries {
 public:
  /// All must outlive this.
  BlockEntries(const Network& network, const Structure& structure, Inputs& inputs, const UnknownIndices& index, const SlipForces& slip)
      : network_(network), structure_(structure), inputs_(inputs), index_(index), slip_(slip) {}

  /// Reserves the entries, then takes their places in the pattern. `reserve_shares`, after PivotRows::reserve, is for entries in the balances of pivots
  /// that other rows share.
  void reserve(PatternBuilder& builder, const LoopEquations& loops);
  void reserve_shares(PatternBuilder& builder);
  void take(const std::vector<int>& entry_of_ticket);

  /// Slopes of all deflection and rate laws.
  struct LawSlopes { const std::vector<double>&of_forces, &of_rates; };
  /// Adds the entries at the present state of the blocks.
  void add(const LawSlopes& laws, double* values) const;
  /// Blocks change shares of the balances of pivots.
  bool any_shares() const { return !share_couplings_.empty(); }
  /// Adds the entries of these, after `add`. `balance`: the balance of forces in each row.
  void add_shares(const LawSlopes& laws, const std::vector<double>& balance, double* values) const;

 private:
  /// d(output, or rate of a state)/d(atom) d(atom)/dy times `factor`.
  struct Coupling {
    enum class By { itself, slope, damping };  ///< d(atom)/dy: 1, the slope of a deflection law, that of a rate law.
    int entry;
    bool of_rate;  ///< It delays the rate of state `source`, else the output of block `source`.
    std::size_t source, atom;
    double factor;
    By by;
    std::size_t branch;
  };
  /// The same through a varying parameter of a slipping slider: times the slope of its sliding force.
  struct SlidingCoupling { Coupling coupling; std::size_t slider, parameter; };
  /// The same through the share of a pivot's balance, on which the losses of a train have an influence (TrainShares).
  struct ShareCoupling { Coupling coupling; std::size_t slider, parameter; Eigen::Index share, pivot; };
  struct AtomTerm { int column; double factor; Coupling::By by; std::size_t branch; };
  std::vector<AtomTerm> terms_of_atom(std::size_t atom) const;
  std::vector<Coupling> entries_of(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor) const;
  void couple(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor,
              Coupling::By by = Coupling::By::itself, std::size_t branch = 0);
  void couple_motions(PatternBuilder& builder, const LoopEquations& loops);
  void couple_sliders(PatternBuilder& builder);
  double slope(const Coupling& coupling, const LawSlopes& laws) const;

  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  const UnknownIndices& index_;
  const SlipForces& slip_;
  std::vector<Coupling> couplings_;
  std::vector<SlidingCoupling> sliding_couplings_;
  std::vector<ShareCoupling> share_couplings_;
};

}  // namespace rheonet
