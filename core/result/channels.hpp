#pragma once

#include <vector>

#include "core/dae/consistency.hpp"
#include "core/dae/dae.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// An element between the same ends as a record of a displacement, which knows its own: the difference of two positions has
/// lost the digits of a small one. -1: there is none. `sign` is -1 where its ends are the other way round.
struct Gauge { int element = -1; double sign = 1; };
/// One for each record.
std::vector<Gauge> gauges(const Network& network, const std::vector<Record>& records);

/// For each node whether its position is needed to answer the scene's records and claims.
std::vector<char> needed_positions(const Network& network);

/// Takes records of a scene from states of its DAE.
class Channels {
 public:
  Channels(const Network& network, const std::vector<Record>& records);
  /// Goes over to these equations.
  void attach(Dae& dae, Consistency& consistency);

  /// One value a record, SI, of a consistent state. One within a step of the integrator is consistent to its tolerance
  /// only: with `rate`, the inverse of that step, it is brought onto the equations where that matters.
  const std::vector<double>& read(double t, const std::vector<double>& y, const std::vector<double>& yp,
                                  double rate = 0);

 private:
  const std::vector<double>& read_state(double t, const std::vector<double>& y, const std::vector<double>& yp, bool exact);
  double element_force(int element, const Dae::View& view) const;
  double position(NodeId node, const Dae::View& view) const;
  double velocity(NodeId node, const Dae::View& view) const;
  double displacement(std::size_t record, const Dae::View& view) const;
  double velocity(const Record& record, const Dae::View& view) const;

  const Network& network_;
  const Scene& scene_;
  const std::vector<Record>& records_;
  const std::vector<Gauge> gauges_;
  Dae* dae_ = nullptr;
  Consistency* consistency_ = nullptr;
  bool bent_ = false;          ///< between steps forces are out of balance at some massless node
  bool rates_needed_ = false;  ///< a record needs y' of a floating node
  std::vector<double> y_, slope_, yp_, row_;
};

}  // namespace rheonet
