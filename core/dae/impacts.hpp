#pragma once

#include <string>
#include <vector>

#include "core/dae/event_change.hpp"
#include "core/dae/event_network.hpp"

namespace rheonet {

/// Impulses at an event: masses that are joined go on together, dashpots pass on steps in position, freewheels and rigid stops end
/// motions that they forbid. They change velocities alone.
class Impacts {
 public:
  /// The network must outlive this.
  explicit Impacts(const EventNetwork& net) : net_(net), network_(net.network), structure_(net.structure), inputs_(net.inputs) {}

  /// All impulses of the event at t. `momentum`: that of dashpots at steps in position, for each node [N s].
  void resolve(double t, const std::vector<double>& momentum, const FiredGuards& fired, const Modes& modes, State& state, EventChange& change);
  /// Contacts that the selected modes do not hold are over.
  void open_contacts(const Modes& modes, State& state, EventChange& change) const;

 private:
  std::vector<int> closed_but_for_roundoff(const std::vector<int>& settles, const State& state) const;
  Modes without_moved(Modes modes, const std::vector<double>& before, const State& state) const;
  double halt(double t, const std::vector<int>& events, const Modes& modes, State& state, std::vector<std::string>& notes) const;
  std::vector<double> held_to_motions(const std::vector<int>& joining, const Modes& held) const;
  double go_on_together(const std::vector<int>& joining, const Modes& held, State& state, std::vector<std::string>& notes) const;
  double collide(double t, const std::vector<double>& momentum, const std::vector<int>& settles, State& state, EventChange& change);
  void refuse_jams(double t, const ConvexNetwork& problem) const;
  void open_parted(const std::vector<int>& settles, State& state, EventChange& change) const;
  double rebound(double t, const std::vector<int>& hit, const std::vector<int>& settles, State& state) const;
  double turn_trains(double t, State& state, std::vector<std::string>& notes) const;
  /// Returns the impulse of each slider [N s].
  std::vector<double> share_impulses(double t, const std::vector<double>& jump, const std::vector<double>& momentum, State& state,
                                     const Modes* held = nullptr) const;

  const EventNetwork& net_;
  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  bool started_ = false;       ///< The impulses of the start have been resolved.
  std::vector<int> hit_;       ///< Sliders in contact whose ends moved towards each other at this event.
  double largest_kinetic_ = 0; ///< At events so far [J].
  double largest_speed_ = 0;   ///< The largest of all nodes at events so far [m/s].
};

}  // namespace rheonet
