#pragma once

#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"

namespace rheonet {

struct Network;

/// The blocks of a scene, and what they take in of the network.
struct Blocks {
  struct Sensor {
    enum class What { position, velocity, force };
    What what;
    int index;        ///< of a node of the network, or of an element of the scene
    int motion = -1;  ///< that prescribes the node: then it is a function of time alone
    int record = 0;   ///< index into Scene::sensed, for messages
  };
  struct Input {
    bool from_block;  ///< else from a sensor
    int index;
    double sign;
  };
  /// u is the sum of the inputs, or the signal.
  struct Block {
    int element;
    BlockLaw law;
    bool generates = false;
    Signal signal;
    std::vector<Input> inputs;
    /// Its output does not depend on what it takes in at present.
    bool breaks_loops() const { return law.state || law.delay > 0; }
  };

  std::vector<Block> blocks;   ///< those of the scene; then the rates of some of them
  std::vector<Sensor> sensors;
  std::vector<int> order;      ///< in which all can be evaluated
};

/// Time counts from the scene's start. Motions whose position a block gives get one that puts out their velocity. Throws
/// SimulationError where blocks wait for each other in a loop, or take in what cannot be sensed, or where a position has no
/// rate.
Blocks find_blocks(Network& network);

}  // namespace rheonet
