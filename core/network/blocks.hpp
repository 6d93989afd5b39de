#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"

namespace rheonet {

struct Network;

/// The blocks of a scene, and the quantities of the network that they sense.
struct Blocks {
  struct Sensor {
    enum class What { position, velocity, force };
    What what;
    int index;        ///< A node of the network (position, velocity), or an element of the scene (force).
    int motion = -1;  ///< The given motion that prescribes the node: the signal is then a function of time alone; -1.
    int record = 0;   ///< Index into Scene::sensed, for messages; -1: the law of an element needs it.
  };
  struct Input {
    bool from_block;  ///< Otherwise `index` is a sensor.
    int index;
    double sign;
    std::size_t argument = 0;  ///< Argument of the function to which it adds.
  };
  /// The input u of the law is the sum of `inputs`, or `signal` if the block generates one. If there is a `function`, the
  /// output is its value; each argument is the sum of some inputs, and the last one is the time in the scene.
  struct Block {
    int element;
    BlockLaw law;
    bool generates = false;
    Signal signal;
    std::vector<Input> inputs;
    std::shared_ptr<const SwitchedFunction> function = {};
    std::optional<std::vector<Input>> steady = {};  ///< For a state: its value in equilibrium is the sum of these; absent: as its law says.
    /// Its present output does not depend on its present input.
    bool breaks_loops() const { return law.state || law.delay > 0; }
  };

  std::vector<Block> blocks;   ///< The blocks of the scene, followed by rates, integrals, states and varying parameters (see find_blocks).
  std::vector<Sensor> sensors;
  std::vector<int> order;      ///< An order of evaluation in which each block follows those whose present outputs it needs.
};

/// Finds the blocks of a network; time counts from the scene's start. A motion whose position a block gives follows an added
/// block instead, whose output is the velocity; so does a motion whose acceleration a block gives. A transfer function gets a block for each of its states. Each varying parameter of a slider gets a block too. Throws SimulationError for an algebraic loop, for a loop closed by delays
/// alone, for a force that cannot be sensed, and for a position without a known rate.
Blocks find_blocks(Network& network);

}  // namespace rheonet
