#pragma once

#include <array>
#include <string>

#include "core/netlist/scene.hpp"

namespace rheonet::tool {

/// "1 element", "2 elements".
std::string count(std::size_t n, const char* one, const char* many);

/// An element as four cells: name, type, place and values in SI.
std::array<std::string, 4> row_of(const SceneElement& element, const Scene& scene);

/// The network with every value in SI, as `check -v` prints it.
std::string describe_network(const Scene& scene);

}  // namespace rheonet::tool
