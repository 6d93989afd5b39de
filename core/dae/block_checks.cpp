#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>
#include <utility>

#include "core/dae/block_checks.hpp"
#include "core/dae/block_signals.hpp"

namespace rheonet {

using What = Blocks::Sensor::What;

namespace {

/// For messages: "drum.velocity".
std::string path_of(const Network& network, const Blocks::Sensor& sensor) {
  if (sensor.record >= 0) return network.scene->sensed[at(sensor.record)].path;
  return network.node_name(sensor.index) + (sensor.what == Blocks::Sensor::What::velocity ? ".velocity" : ".position");
}

}  // namespace

void check_sensors(const Network& network, const Structure& classified) {
  const std::vector<char> firm = firm_nodes(network, classified);
  for (const Blocks::Sensor& sensor : network.blocks.sensors) {
    if (sensor.what != What::velocity || classified.kind[at(sensor.index)] != Kind::floating || firm[at(sensor.index)]) continue;
    throw SimulationError(
        network.spot_of_node(sensor.index),
        fmt::format("no block and no law can depend on `{}`: node `{}` has no mass, and no dashpots lead from there to a mass, to ground or to a "
                    "prescribed motion, so that its velocity follows from how fast the forces there change; add one, or use "
                    "the position",
                    path_of(network, sensor), network.node_name(sensor.index)));
  }
}

bool follows_forces(const Network& network, const Blocks::Sensor& sensor, const Structure& classified, const std::vector<char>& firm_node) {
  const auto firm = [&](NodeId node) { return firm_node[at(node)] != 0; };
  if (sensor.what == What::velocity) return !firm(sensor.index);
  if (sensor.what == What::position) return classified.kind[at(sensor.index)] == Kind::floating && !firm(sensor.index);
  const Network::Place& place = network.places[at(sensor.index)];
  if (place.role == Role::force) return false;
  const bool rate = place.role == Role::rate;
  const Branch& b = rate ? network.rates[at(place.index)] : network.deflections[at(place.index)];
  if (rate) return !firm(b.a) || !firm(b.b);
  const auto grouped = [&](NodeId node) { return classified.group[at(node)] >= 0 && !firm(node); };
  return grouped(b.a) || grouped(b.b);
}

void refuse_loops(const Network& network, const BlockSignals& blocks, const Structure& classified) {
  const std::vector<char> firm = firm_nodes(network, classified);
  for (const Network::Motion& motion : network.motions) {
    for (std::size_t k = 0; motion.block >= 0 && k < network.blocks.sensors.size(); ++k) {
      const Blocks::Sensor& sensor = network.blocks.sensors[k];
      if (!blocks.slopes().depends(motion.block, blocks.states() + k)) continue;
      const bool follows = blocks.slopes().follows(motion.block, blocks.states() + k) && sensor.what != What::position;
      if (!follows && !follows_forces(network, sensor, classified, firm)) continue;
      throw SimulationError(network.spot_of(motion.element),
                            fmt::format("the velocity of `{}` follows at the same instant from `{}`, of which it is not known how fast "
                                        "it changes, so that no acceleration would be known; put a `lag` between them",
                                        network.scene->elements[at(motion.element)].name,
                                        path_of(network, sensor)));
    }
  }
  for (const Network::Force& force : network.forces) {
    for (std::size_t k = 0; force.block >= 0 && k < network.blocks.sensors.size(); ++k) {
      const Blocks::Sensor& sensor = network.blocks.sensors[k];
      if (!blocks.slopes().depends(force.block, blocks.states() + k) || !follows_forces(network, sensor, classified, firm)) continue;
      const std::string& source = network.scene->elements[at(force.element)].name;
      throw SimulationError(
          network.spot_of(force.element),
          fmt::format("`{}` follows at the same instant from `{}`, which no mass keeps from jumping when a force does: "
                      "neither can be known before the other; put a `lag` between them{}",
                      source, path_of(network, sensor),
                      sensor.what == What::force ? "" : fmt::format(", or give node `{}` a mass", network.node_name(sensor.index))));
    }
  }
}

namespace {

/// The search for the equilibrium of blocks.
class BlockEquilibrium {
 public:
  BlockEquilibrium(const Network& network, const BlockSignals& blocks) : network_(network), blocks_(blocks), list_(network.blocks.blocks) {}
  SteadyBlocks find();

 private:
  bool senses(int block, std::vector<char>& seen) const;
  double settle(int block, std::vector<char>& on_way);
  [[noreturn]] void refuse(int block, const char* why) const;

  const Network& network_;
  const BlockSignals& blocks_;
  const std::vector<Blocks::Block>& list_;
  SteadyBlocks result_;
};

bool BlockEquilibrium::senses(int index, std::vector<char>& seen) const {
  if (std::exchange(seen[at(index)], 1)) return false;
  for (const Blocks::Input& in : list_[at(index)].inputs) {
    if (!in.from_block || senses(in.index, seen)) return true;
  }
  return false;
}

SteadyBlocks BlockEquilibrium::find() {
  for (const Dual& z : blocks_.state) result_.state.push_back(z.value);
  for (std::size_t k = 0; k < list_.size(); ++k) {
    const int block = static_cast<int>(k);
    bool matters = list_[k].breaks_loops();
    for (const Network::Force& force : network_.forces) matters = matters || (force.block == block && !force.beside);  // 0 at rest
    for (const Network::Motion& motion : network_.motions) matters = matters || motion.block == block;
    std::vector<char> seen(list_.size(), 0);
    if (matters && senses(block, seen)) refuse(block, "depends on how the network moves, which is what is looked for");
  }
  result_.out.assign(list_.size(), 0);
  for (std::size_t k = 0; k < list_.size(); ++k) {
    std::vector<char> seen(list_.size(), 0), on_way(seen);
    if (!senses(static_cast<int>(k), seen)) result_.out[k] = settle(static_cast<int>(k), on_way);
  }
  return result_;
}

/// Output of a block at equilibrium.
double BlockEquilibrium::settle(int index, std::vector<char>& on_way) {
  const Blocks::Block& block = list_[at(index)];
  if (block.generates) return blocks_.out(index).value;
  if (std::exchange(on_way[at(index)], 1)) refuse(index, "is in a loop of blocks");
  double u = 0;
  if (block.steady) {
    for (const Blocks::Input& in : *block.steady) u += in.sign * settle(in.index, on_way);
    on_way[at(index)] = 0;
    result_.state[at(blocks_.state_of(index))] = u;
    return u;
  }
  if (block.function) {
    FunctionBlock function(*block.function);
    function.begin(network_.scene->start);
    for (const Blocks::Input& in : block.inputs) function.add(in.argument, Dual(in.sign * settle(in.index, on_way)));
    u = function.value(false).value;
    if (std::isnan(u)) refuse(index, "has no finite value there");
  } else {
    for (const Blocks::Input& in : block.inputs) u += in.sign * settle(in.index, on_way);
  }
  on_way[at(index)] = 0;
  if (block.law.delay > 0) return u;
  if (block.law.period > 0) return quantised(block.law, u);
  if (!block.law.state) return limited(block.law, block.law.gain * u).value;
  double& z = result_.state[at(blocks_.state_of(index))];
  if (block.law.leak > 0) z = block.law.gain / block.law.leak * u;
  if (block.law.leak == 0 && block.law.gain * u != 0) refuse(index, "would go on for ever: its input is not 0");
  return z;
}

void BlockEquilibrium::refuse(int index, const char* why) const {
  const int element = list_[at(index)].element;
  const SceneElement& of = network_.scene->elements[at(element)];
  const bool law = network_.places[at(element)].role == Role::force;
  throw SimulationError(network_.spot_of(element),
                        fmt::format("a start from rest or in steady motion is not known here: {} {}; start from "
                                    "given values, and give it time to settle",
                                    law ? "`" + of.name + "`, with a parameter that varies," : block_in_words(of), why));
}

}  // namespace

SteadyBlocks steady_blocks(const Network& network, const BlockSignals& blocks) { return BlockEquilibrium(network, blocks).find(); }

void BlockSignals::refuse_undefined(double since) const {
  if (undefined_ < 0 || undefined_at_ < since) return;
  const Blocks::Block& block = blocks_->blocks[at(undefined_)];
  std::vector<std::string> arguments;
  for (std::size_t k = 0; k + 1 < block.function->variables(); ++k) {
    double u = 0;
    for (const Blocks::Input& in : block.inputs) u += in.argument == k ? in.sign * source(in).value : 0;
    arguments.push_back(std::isfinite(u) ? fmt::format("{} = {:.6g}", block.function->variable(k), u)
                                         : fmt::format("{} is beyond the range of double precision", block.function->variable(k)));
  }
  if (network_->places[at(block.element)].role == Role::force) {
    throw SimulationError(network_->spot_of(block.element),
                          fmt::format("{}, the law of `{}` has no finite force, or no finite slope ({}, in SI): a parameter that it divides by may be 0",
                                      at_time(*network_->scene, undefined_at_), network_->scene->elements[at(block.element)].name, fmt::join(arguments, ", ")));
  }
  throw SimulationError(network_->spot_of(block.element),
                        fmt::format("{}, the output `{}` of {} has no finite value, or no finite slope ({}, in SI)",
                                    at_time(*network_->scene, undefined_at_), block.function->text(),
                                    block_in_words(network_->scene->elements[at(block.element)]), fmt::join(arguments, ", ")));
}

}  // namespace rheonet
