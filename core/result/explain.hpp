#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/error.hpp"

namespace rheonet {

/// What will be simulated of a scene, and why: everything that is known before it runs. Names are those of the scene.
struct Explanation {
  struct EffectFound {
    Effect effect;
    std::vector<std::string> by = {};        ///< elements that bring it
    std::vector<std::string> left_out = {};  ///< elements that would, but for what the scene leaves out
  };
  std::vector<EffectFound> effects = {};  ///< all there are, in their order

  /// Unknowns of one kind that are determined in one way.
  struct Unknowns {
    std::string quantity = {};  ///< "velocity", "deflection", "force", "position", "state"
    std::string unit = {};      ///< "" of states, which may each have another
    std::string equation = {};  ///< what determines them
    bool differential = false;
    bool of_nodes = false;  ///< `names` are nodes, else elements
    std::vector<std::string> names = {};
  };
  std::vector<Unknowns> unknowns = {};  ///< in the modes in which the run begins

  /// What is not simulated.
  struct Omission {
    std::string reduction = {};  ///< its name, as after --keep; "" where that does not apply
    std::string what = {};       ///< "position of", with `names` after it
    std::string reason = {};
    bool of_nodes = false;
    std::vector<std::string> names = {};
  };
  std::vector<Omission> left_out = {};

  struct Structure {
    int index_as_wired = 0;  ///< of the equations at nodes, as one would write them down
    std::string because = {};     ///< why it is that
    int index = 0;           ///< of the equations that are solved: 0 or 1
    int differential = 0;    ///< number of unknowns that are integrated
    int algebraic = 0;       ///< that follow from others
    int loops = 0;           ///< deflections that depend on others through the wiring
    int parts = 0;           ///< of the network: they share nothing but ground and given motions
    int integrations = 1;    ///< so many of these parts, or groups of them, are integrated each with its own steps
  };
  Structure structure;

  /// Elements that may switch, and how.
  struct Events {
    std::string kinds = {};  ///< "stick, slip, reversal"
    std::vector<std::string> names = {};
  };
  std::vector<Events> events = {};

  struct Cost {
    int unknowns = 0;
    int entries = 0;            ///< of the Jacobian
    bool sparse = false;        ///< KLU rather than dense linear algebra
    double fastest_rate = 0;    ///< at which the network changes by itself at the start [1/s]
    double fastest_drive = 0;   ///< largest angular frequency of the drives [rad/s]
    long known_instants = 0;    ///< jumps and corners of signals, at each of which the integrator starts anew
    // The run is begun to see how it goes; the rest is supposed to go on like that.
    long tried_steps = 0;       ///< 0: it cannot be begun
    double tried = 0;           ///< share of the run that these came to
    double steps = 0;           ///< predicted
    double seconds_a_step = 0;  ///< CPU time
    double seconds() const { return steps * seconds_a_step; }
  };
  Cost cost;
  std::vector<std::string> notes = {};
};

/// Throws SimulationError for a scene that cannot be simulated from the start.
Explanation explain(const Scene& scene);

}  // namespace rheonet
