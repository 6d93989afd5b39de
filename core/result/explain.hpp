#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/error.hpp"

namespace rheonet {

/// The plan of a simulation, with reasons: everything known about a scene before it runs. Names are those of the scene.
struct Explanation {
  struct EffectFound {
    Effect effect;
    std::vector<std::string> by = {};        ///< Elements that bring the effect.
    std::vector<std::string> left_out = {};  ///< Elements that would, if the scene did not leave it out.
  };
  std::vector<EffectFound> effects = {};  ///< All effects, in the order of their enumeration.

  /// Unknowns of one kind with the same determining equation.
  struct Unknowns {
    std::string quantity = {};  ///< "velocity", "deflection", "force", "position", "state".
    std::string unit = {};      ///< "" for states, whose units may differ.
    std::string equation = {};  ///< The equation that determines them, in words.
    bool differential = false;
    bool of_nodes = false;  ///< `names` are nodes rather than elements.
    std::vector<std::string> names = {};
  };
  std::vector<Unknowns> unknowns = {};  ///< In the initial modes.

  /// Something that is not simulated.
  struct Omission {
    std::string reduction = {};  ///< Name of the reduction, as given to --keep; "" if it is none.
    std::string what = {};       ///< "position of", to be followed by `names`.
    std::string reason = {};
    bool of_nodes = false;
    std::vector<std::string> names = {};
  };
  std::vector<Omission> left_out = {};

  struct Structure {
    int index_as_wired = 0;  ///< Index of the nodal equations as usually written.
    std::string because = {};     ///< Reason for that index.
    int index = 0;           ///< Index of the equations actually solved: 0 or 1.
    int differential = 0;    ///< Number of integrated unknowns.
    int algebraic = 0;       ///< Number of other unknowns.
    int loops = 0;           ///< Number of deflections given by others through loop equations.
    int parts = 0;           ///< Parts of the network, which share nothing but ground and given motions.
    int integrations = 1;    ///< Number of parts, or groups of parts, integrated with their own steps.
  };
  Structure structure;

  /// Elements that may switch, and their kinds of event.
  struct Events {
    std::string kinds = {};  ///< "stick, slip, reversal".
    std::vector<std::string> names = {};
  };
  std::vector<Events> events = {};

  struct Cost {
    int unknowns = 0;
    int entries = 0;            ///< Nonzero entries of the Jacobian.
    std::string why_ida = {};   ///< Why IDA and not an exact arc crosses the time between events; empty if an arc does.
    bool sparse = false;        ///< KLU rather than dense linear algebra.
    double fastest_rate = 0;    ///< Fastest rate of the network's own motion at the start [1/s].
    double fastest_drive = 0;   ///< Largest angular frequency of the inputs [rad/s].
    long known_instants = 0;    ///< Jumps and corners of signals, at each of which the integrator restarts.
    // A trial of the first part of the run, from which the rest is extrapolated:
    long tried_steps = 0;       ///< 0: the trial failed at once.
    double tried = 0;           ///< Share of the run completed in the trial.
    double steps = 0;           ///< Predicted for the whole run.
    double seconds_a_step = 0;  ///< CPU time.
    double seconds() const { return steps * seconds_a_step; }
  };
  Cost cost;
  std::vector<std::string> notes = {};
};

/// Throws SimulationError for a scene that cannot be simulated from the start.
Explanation explain(const Scene& scene);

}  // namespace rheonet
