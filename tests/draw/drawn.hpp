#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tools/draw/picture.hpp"

namespace rheonet::test {

/// A netlist read with the components that there are; fails the test with its messages if it is refused.
Scene scene_from(const std::string& netlist);
/// The same of a file.
Scene scene_from_file(const std::string& path);
/// All scenes that come with the project: every netlist but the libraries.
std::vector<std::string> scene_files();

/// Checks the drawing of a scene. Returns one line for each violation of these rules, "" if there is none:
///
/// * every element has one symbol, with its ends at its nodes, except for the number that the picture reports as left out;
/// * the wires of a node are one piece that all its ends touch; those of ground may be several, each with a wall;
/// * wires of different nodes do not meet, unless one hops over the other;
/// * no symbol or label overlaps another, and no wire runs through a label or through a symbol that is not its own;
/// * signals begin and end at the sides of blocks or at texts, one for each input and feed; they cross no symbol, and overlap each other
///   only if they are the same signal;
/// * everything is inside the picture.
std::string faults_of(const draw::Picture& picture, const Scene& scene);

}  // namespace rheonet::test
