#pragma once

#include <string>
#include <vector>

#include "core/dae/convex.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Messages about a start from rest or in steady motion.
class SteadyReport {
 public:
  /// Both must outlive this.
  SteadyReport(const Network& network, const Structure& structure)
      : network_(network), structure_(structure), resting_(network.scene->start_from == Scene::StartFrom::rest) {}

  bool resting() const { return resting_; }
  /// The beginning of an error.
  std::string refusal() const { return resting_ ? "no state of rest to start from" : "no steady state to start from"; }
  void note(const std::string& text) { notes_.push_back((resting_ ? "start from rest: " : "steady start: ") + text); }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Throws SimulationError: the loads on these nodes accelerate them for ever.
  [[noreturn]] void refuse_acceleration(std::vector<NodeId> nodes) const;
  /// Throws SimulationError for a problem without a solution; values beyond `far` have run away.
  void refuse_unbalanced(const ConvexNetwork& problem, ConvexNetwork::Outcome outcome, double far) const;
  /// Throws SimulationError for prescribed nodes of different velocities that rigid branches join: these would stretch for ever.
  void refuse_stretching(const std::vector<Branch>& rigid, const std::vector<double>& velocity) const;
  /// Throws SimulationError for trains whose ends springs or motions hold at velocities that do not fit.
  void refuse_torn_trains(const std::vector<double>& velocity) const;
  /// Throws SimulationError if anything moves.
  void refuse_motion(const std::vector<double>& velocity) const;

 private:
  template <class Subject>
  std::string velocity_of(const Subject& of, double v) const { return with_unit(*network_.scene, of, v, Quantity::velocity); }

  const Network& network_;
  const Structure& structure_;
  const bool resting_;
  std::vector<std::string> notes_;
};

}  // namespace rheonet
