#pragma once

#include <string>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// A scene's elements as text, a line for each: "k1: spring drum-mid 100 0"; values that are not given are left out,
/// signals show their value at 0.25 s.
std::string elements_of(const Scene& scene);

/// "bingham: drum-ground = bingham.k1 - bingham.f", a line for each assembly.
std::string assemblies_of(const Scene& scene);

/// The paths of nodes but ground, or of records, one after the other.
std::string nodes_of(const Scene& scene);
std::string records_of(const Scene& scene);

}  // namespace rheonet::test
