#pragma once

#include <cstdint>
#include <string>

namespace rheonet::test {

/// A network of random wiring: `nodes` nodes, every one of which is reached; masses and drives at some of them.
std::string random_network(std::uint64_t seed, int nodes, int branches);

/// `count` blocks of all kinds that take in each other's outputs, beside one that takes in a quantity of the network.
std::string random_blocks(std::uint64_t seed, int count);

/// A row of masses and springs to ground, driven by nothing: `chain.0.m`, `chain.0.k`, ...
std::string chain(int count);

/// Parallel springs to ground: `k.0`, ...
std::string bundle(int count);

}  // namespace rheonet::test
