#pragma once

#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// `rheonet run`: reads, simulates, writes the rows and says what it took.
ExitStatus run_scene(const Arguments& arguments);

/// `rheonet check`: reads, and finds out what can be known without simulating.
ExitStatus check_scene(const Arguments& arguments);

/// `rheonet explain`: says what will be simulated of a scene, and why; or lists the numerical parameters of the engine.
ExitStatus explain_scene(const Arguments& arguments);

/// `rheonet effects`: says what each effect of a scene contributes, and what it costs.
ExitStatus weigh_effects(const Arguments& arguments);

/// `rheonet compare`: runs several scenes and says how far they are from the first.
ExitStatus compare_scenes(const Arguments& arguments);

/// `rheonet precision`: says what accuracy costs in a scene.
ExitStatus price_scene(const Arguments& arguments);

/// `rheonet sweep`: simulates a scene for many values of its parameters.
ExitStatus sweep_scene(const Arguments& arguments);

/// `rheonet plot`: draws curves of scenes and of CSV files.
ExitStatus plot_results(const Arguments& arguments);

/// `rheonet draw`: draws the network of a scene.
ExitStatus draw_network(const Arguments& arguments);

/// `rheonet report`: writes one HTML file that shows scenes and their results.
ExitStatus write_report(const Arguments& arguments);

/// `rheonet serve`: becomes the program that serves the playground.
ExitStatus serve_playground(const Arguments& arguments);

/// `rheonet components`: prints the reference.
ExitStatus print_components(const Arguments& arguments);

}  // namespace rheonet::tool
