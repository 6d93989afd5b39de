#pragma once

#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// `rheonet run`: simulates a scene, writes the rows and prints a summary.
ExitStatus run_scene(const Arguments& arguments);

/// `rheonet check`: reads a scene and reports every mistake that can be found without a simulation.
ExitStatus check_scene(const Arguments& arguments);

/// `rheonet explain`: explains which equations of a scene will be solved, and why; or lists the numerical parameters of the engine.
ExitStatus explain_scene(const Arguments& arguments);

/// `rheonet effects`: reports the contribution and the cost of each physical effect in a scene.
ExitStatus weigh_effects(const Arguments& arguments);

/// `rheonet compare`: runs several scenes and reports their differences from the first.
ExitStatus compare_scenes(const Arguments& arguments);

/// `rheonet precision`: measures CPU time against error for a scene.
ExitStatus price_scene(const Arguments& arguments);

/// `rheonet sweep`: simulates a scene for many values of its parameters.
ExitStatus sweep_scene(const Arguments& arguments);

/// `rheonet plot`: draws curves of scenes and of CSV files.
ExitStatus plot_results(const Arguments& arguments);

/// `rheonet draw`: draws the network of a scene.
ExitStatus draw_network(const Arguments& arguments);

/// `rheonet report`: writes one HTML file that shows scenes and their results.
ExitStatus write_report(const Arguments& arguments);

/// `rheonet serve`: replaces the process by the server of the playground.
ExitStatus serve_playground(const Arguments& arguments);

/// `rheonet components`: prints the reference.
ExitStatus print_components(const Arguments& arguments);

}  // namespace rheonet::tool
