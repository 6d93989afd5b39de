#include "core/network/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/index.hpp"
#include "core/netlist/run_time_expression.hpp"
#include "core/netlist/speed_curve.hpp"
#include "core/network/block_order.hpp"
#include "core/network/effects.hpp"
#include "core/network/network.hpp"
#include "core/network/resolved.hpp"
#include "core/network/sliding_power.hpp"
#include "core/network/transfer_function.hpp"

namespace rheonet {

namespace {

class Finder {
 public:
  explicit Finder(Network& network) : network_(network), scene_(*network.scene) {
    if (scene_.without.empty()) return;
    open_ = acting_blocks(scene_);
    for (std::size_t b = 0; b < open_.size(); ++b) {
      const SceneElement& block = scene_.elements[at(scene_.blocks[b].element)];
      open_[b] = open_[b] && block.part == SceneElement::Part::none && std::any_of(scene_.without.begin(), scene_.without.end(), [&](const EffectLeftOut& e) {
        return e.effect == Effect::feedback && e.concerns(block.name);
      });
    }
  }

  Blocks find() {
    const std::vector<int> rates = number_rates();
    const std::vector<Blocks::Block> accelerations = integrate_accelerations(scene_.blocks.size() + rates.size());
    first_added_ = scene_.blocks.size() + rates.size() + accelerations.size();
    for (const SceneBlock& block : scene_.blocks) add(block);
    for (const int block : rates) add_rate(block);
    result_.blocks.insert(result_.blocks.end(), accelerations.begin(), accelerations.end());
    result_.blocks.insert(result_.blocks.end(), added_.begin(), added_.end());
    for (Network::Slider& slider : network_.sliders) {
      for (Network::VaryingParameter& varying : slider.varying) add_parameter(slider, varying);
    }
    for (const auto& [block, slider] : powers_of_sliders_) {
      for (std::size_t k = 0; k < slider->varying.size(); ++k) {
        const Network::VaryingParameter& v = slider->varying[k];
        result_.blocks[at(block)].inputs.push_back({true, v.block, v.sign, k + 1});
      }
    }
    for (Network::Force& force : network_.forces) {
      if (force.beside) force.block = add_function({force.element, force.a, force.b}, *force.beside);
      if (force.varying) add_varying(force);
    }
    for (Blocks::Block& block : result_.blocks) {
      for (Blocks::Input& input : block.inputs) {
        if (input.from_block && input.index < 0) input.index = network_.forces[at(force_of(input.index))].block;
      }
    }
    // Without a state to smooth discontinuities, a loop of delays alone would repeat each of them for ever.
    const auto refuse_delays = [&](const std::vector<int>& loop) {
      refuse(loop, "make a loop in which nothing but delays takes time, and what jumps would jump for ever; put a `lag` into it");
    };
    const auto refuse_loop = [&](const std::vector<int>& loop) {
      refuse(loop, loop.size() > 1 ? "make a loop in which each needs the output of another at the same instant; put a `lag` into it"
                                   : "needs its own output at the same instant; put a `lag` between");
    };
    result_.order = block_order(result_.blocks, [](const Blocks::Block& b) { return b.breaks_loops(); }, refuse_loop);
    block_order(result_.blocks, [](const Blocks::Block& b) { return b.law.state; }, refuse_delays);
    for (const Network::Force& force : network_.forces) {
      std::vector<char> seen(result_.blocks.size(), 0);
      if (force.energy >= 0) refuse_energy_of_forces(force, force.energy, seen);
    }
    return std::move(result_);
  }

 private:
  /// Makes a motion whose position a block gives follow the rate of that block. Returns these blocks; their rates are
  /// numbered after the blocks of the scene.
  std::vector<int> number_rates() {
    std::vector<int> rates;
    for (Network::Motion& motion : network_.motions) {
      if (motion.block < 0 || !motion.position) continue;
      const SceneElement& giver = scene_.elements[at(scene_.blocks[at(motion.block)].element)];
      const SceneElement& moved = scene_.elements[at(motion.element)];
      const BlockLaw law = law_of(scene_.blocks[at(motion.block)]);
      if (!law.state)
        throw SimulationError(moved.spot,
                              fmt::format("motion `{}` takes its position from block `{}`, which is no integrator or lag: its rate, "
                                          "the velocity, is not known; put an `integrator` or `lag` last, or give the velocity",
                                          moved.name, giver.name));
      if (scene_.start_from != Scene::StartFrom::given)
        throw SimulationError(moved.spot,
                              fmt::format("motion `{}` takes its position from block `{}`: a start from rest or in steady motion is not "
                                          "known then; start from given values, and give it time to settle",
                                          moved.name, giver.name));
      motion.from = motion.sign * law.initial;
      motion.position = false;
      rates.push_back(std::exchange(motion.block, static_cast<int>(scene_.blocks.size() + rates.size())));
    }
    return rates;
  }

  /// Makes a motion whose acceleration a block gives follow the integral of that acceleration. Returns the blocks that integrate; the first
  /// one gets the number `next`.
  std::vector<Blocks::Block> integrate_accelerations(std::size_t next) {
    std::vector<Blocks::Block> added;
    for (Network::Motion& motion : network_.motions) {
      if (!motion.acceleration || motion.block < 0) continue;
      const Blocks::Input input{true, motion.block, motion.sign};
      const double velocity = network_.node(motion.node).velocity;
      motion.block = static_cast<int>(next + added.size());
      motion.sign = 1;
      added.push_back({.element = motion.element, .law = {.state = true, .initial = std::isnan(velocity) ? 0 : velocity},
                       .generates = false, .signal = {}, .inputs = {input}});
    }
    return added;
  }

  static Blocks::Block generator(int element, Signal signal) {
    return {.element = element, .law = {}, .generates = true, .signal = std::move(signal), .inputs = {}};
  }

  void add_rate(int state) {
    const Blocks::Block of = result_.blocks[at(state)];
    Blocks::Block rate{.element = of.element, .law = {}, .generates = false, .signal = {}, .inputs = of.inputs};
    for (Blocks::Input& input : rate.inputs) input.sign *= of.law.gain;
    if (of.law.leak != 0) rate.inputs.push_back({true, state, -of.law.leak});
    result_.blocks.push_back(std::move(rate));
  }

  /// A varying parameter is the output of a block, or of a generator made for its signal. Below its least value it counts as that
  /// value: a limiter sees to it.
  void add_parameter(const Network::Slider& slider, Network::VaryingParameter& varying) {
    const int e = slider.branch.element;
    const SceneElement& element = scene_.elements[at(e)];
    const auto k = at(varying.parameter);
    if (const auto curve = element.characteristic(k)) {
      const Parameter& bounds = components()[at(element.declaration)]->declaration.parameters[k];
      varying.block = add_of_motion(slider.branch, {.element = e, .law = {}, .generates = false, .signal = {}, .inputs = {}, .function = std::make_shared<const SpeedCurve>(*curve, bounds)});
      return;
    }
    if (const auto over = over_velocity(*slider.component, slider.law_values());
        over && over->parameter == varying.parameter) {
      varying.block = add_function(slider.branch, *over);
      return;
    }
    varying.block = parameter_block(e, varying.parameter);
  }

  /// The block that gives a varying parameter of an element.
  int parameter_block(int e, int parameter) {
    const SceneElement& element = scene_.elements[at(e)];
    const auto fed = std::find_if(scene_.feeds.begin(), scene_.feeds.end(), [&](const SceneFeed& feed) {
      return feed.element == e && feed.parameter == parameter;
    });
    Blocks::Input input{true, -1, 1};
    if (fed != scene_.feeds.end()) {
      input = {true, fed->block, fed->sign};
    } else {
      const auto which = std::find(element.signal_parameters.begin(), element.signal_parameters.end(), parameter);
      const Signal& signal = element.signals[static_cast<std::size_t>(which - element.signal_parameters.begin())];
      input.index = static_cast<int>(result_.blocks.size());
      result_.blocks.push_back(generator(e, signal.seen_from(scene_.start)));
    }
    const double least = components()[at(element.declaration)]->declaration.parameters[at(parameter)].lower;
    result_.blocks.push_back({.element = e, .law = {.lower = least}, .generates = false, .signal = {}, .inputs = {input}});
    return static_cast<int>(result_.blocks.size()) - 1;
  }

  /// Adds the blocks of the states, of the force, and of the stored energy, of an element with parameters that vary.
  void add_varying(Network::Force& force) {
    const SceneElement& element = scene_.elements[at(force.element)];
    const std::vector<Parameter>& parameters = components()[at(element.declaration)]->declaration.parameters;
    const std::vector<double> values = resolved_values(scene_, element);
    MotionExpression of;
    std::vector<std::pair<std::string, int>> varying;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const auto& signals = element.signal_parameters;
      if (std::isnan(values[k]) && std::find(signals.begin(), signals.end(), static_cast<int>(k)) != signals.end()) {
        varying.emplace_back(parameters[k].name, parameter_block(force.element, static_cast<int>(k)));
      } else if (!std::isnan(values[k])) {
        of.names[parameters[k].name] = values[k];
      }
    }
    const Branch branch{force.element, force.a, force.b};
    const std::size_t first = result_.blocks.size();
    for (const VaryingLaw::State& state : force.varying->states) {
      varying.emplace_back(state.name, static_cast<int>(result_.blocks.size()));
      result_.blocks.push_back({.element = force.element, .law = {.state = true, .initial = state.start}, .generates = false, .signal = {}, .inputs = {}});
    }
    for (std::size_t k = 0; k < force.varying->states.size(); ++k) {
      of.expression = force.varying->states[k].rate;
      const int rate = add_function(branch, of, varying);
      result_.blocks[first + k].inputs.push_back({true, rate, 1});
    }
    of.expression = force.varying->force;
    force.block = add_function(branch, of, varying);
    if (force.varying->stored.empty()) return;
    of.expression = force.varying->stored;
    force.energy = add_function(branch, of, varying);
  }

  /// Adds a block for a quantity of an element that depends on its displacement and velocity, and on the outputs of blocks by these
  /// names. Returns its index.
  int add_function(const Branch& branch, const MotionExpression& of, const std::vector<std::pair<std::string, int>>& parameters = {}) {
    Blocks::Block block{.element = branch.element, .law = {}, .generates = false, .signal = {}, .inputs = {}};
    Environment names;
    for (const auto& [name, value] : of.names) names.names[name] = Number{.value = value, .dimension = {}};
    std::vector<RunTimeExpression::Variable> variables{{"d", {}}, {"w", {}}};
    for (const auto& [name, from] : parameters) variables.push_back({name, {}});
    if (network_.places[at(branch.element)].role == Role::deflection) {
      block.inputs.push_back({false, sensor({Blocks::Sensor::What::force, branch.element, -1, -1}), 1, variables.size()});
      variables.push_back({"f", {}});
    }
    variables.push_back({"t", {}});
    block.function = std::make_shared<const RunTimeExpression>(std::get<RunTimeExpression>(RunTimeExpression::compile(of.expression, variables, names)));
    for (std::size_t k = 0; k < parameters.size(); ++k) block.inputs.push_back({true, parameters[k].second, 1, 2 + k});
    return add_of_motion(branch, std::move(block));
  }

  /// Adds the block of a function whose first two arguments are the displacement and the velocity of an element.
  int add_of_motion(const Branch& branch, Blocks::Block block) {
    for (const auto& [node, sign] : {std::pair{branch.a, 1.0}, std::pair{branch.b, -1.0}}) {
      if (node <= ground) continue;
      const int motion = motion_of(node), giver = motion < 0 ? -1 : network_.motions[at(motion)].block;
      const int given = giver < 0 ? motion : -1;
      if (block.function->uses(0)) block.inputs.push_back({false, sensor({Blocks::Sensor::What::position, node, given, -1}), sign, 0});
      if (giver >= 0) {
        block.inputs.push_back({true, giver, sign * network_.motions[at(motion)].sign, 1});
      } else {
        block.inputs.push_back({false, sensor({Blocks::Sensor::What::velocity, node, given, -1}), sign, 1});
      }
    }
    result_.blocks.push_back(std::move(block));
    return static_cast<int>(result_.blocks.size()) - 1;
  }

  /// The slider whose quantity a record is, nullptr if it is none, or stands for a contact or for losses.
  const Network::Slider* plain_slider(const Record& record) const {
    if (record.subject != Record::Subject::element) return nullptr;
    const Network::Place& place = network_.places[at(record.index)];
    if (place.role != Role::slip || place.paired) return nullptr;
    const Network::Slider& slider = network_.sliders[at(place.index)];
    return slider.contact || slider.train >= 0 || std::isinf(slider.box.largest()) ? nullptr : &slider;
  }

  /// A power that a block takes in is the output of a function added for it: force times velocity.
  void take_in_power(Blocks::Block& block, const SceneBlock::Input& input, const Record& record) {
    static const auto product = [] {
      const std::vector<RunTimeExpression::Variable> variables{{"u1", {}}, {"u2", {}}, {"t", {}}};
      RunTimeExpression result = std::get<RunTimeExpression>(RunTimeExpression::compile("u1*u2", variables, {}));
      result.show_as("power of an element");
      return std::make_shared<const RunTimeExpression>(std::move(result));
    }();
    Blocks::Block power{.element = block.element, .law = {}, .generates = false, .signal = {}, .inputs = {}, .function = product};
    Record factor = record;
    if (const Network::Slider* slider = plain_slider(record)) {
      power.function = std::make_shared<const SlidingPower>(*slider);
      factor.channel = Record::Channel::velocity;
      take_in(power, {.from_block = false, .index = input.index, .sign = 1}, factor);
      powers_of_sliders_.emplace_back(next_added(), slider);
      block.inputs.push_back({true, next_added(), input.sign});
      added_.push_back(std::move(power));
      return;
    }
    factor.channel = Record::Channel::force;
    take_in(power, {.from_block = false, .index = input.index, .sign = 1}, factor);
    const std::size_t forces = power.inputs.size();
    factor.channel = Record::Channel::velocity;
    take_in(power, {.from_block = false, .index = input.index, .sign = 1}, factor);
    for (std::size_t k = forces; k < power.inputs.size(); ++k) power.inputs[k].argument = 1;
    block.inputs.push_back({true, next_added(), input.sign});
    added_.push_back(std::move(power));
  }

  /// The law of a block. The output of a transfer function is a state if it does not depend on the present input.
  BlockLaw law_of(const SceneBlock& block) const {
    const SceneElement& element = scene_.elements[at(block.element)];
    BlockLaw law = components()[at(element.declaration)]->block(resolved_values(scene_, element));
    if (block.coefficients.empty()) return law;
    const TransferFunction transfer(block.coefficients[0], block.coefficients[1]);
    law.state = transfer.order() > 0 && !transfer.direct();
    if (law.state) law.leak = transfer.a[1];
    return law;
  }

  int next_added() const { return static_cast<int>(first_added_ + added_.size()); }

  void add(const SceneBlock& made) {
    const SceneElement& element = scene_.elements[at(made.element)];
    Blocks::Block block{.element = made.element,
                        .law = law_of(made),
                        .generates = !element.signals.empty(),
                        .signal = {},
                        .inputs = {}};
    if (block.generates) block.signal = element.signals.front().seen_from(scene_.start);
    block.function = made.function;
    for (std::size_t argument = 0; argument < made.inputs.size(); ++argument) {
      const SceneBlock::Input& input = made.inputs[argument];
      const std::size_t first = block.inputs.size();
      if (input.from_block) {
        block.inputs.push_back({true, input.index, input.sign});
      } else if (const Record& record = scene_.sensed[at(input.index)]; record.channel == Record::Channel::power) {
        take_in_power(block, input, record);
      } else {
        take_in(block, input, record);
      }
      for (std::size_t k = first; k < block.inputs.size(); ++k) block.inputs[k].argument = argument;
    }
    if (!made.coefficients.empty()) {
      const TransferFunction transfer(made.coefficients[0], made.coefficients[1]);
      std::vector<Blocks::Block> states = realise(block, transfer, static_cast<int>(result_.blocks.size()), next_added());
      added_.insert(added_.end(), std::make_move_iterator(states.begin()), std::make_move_iterator(states.end()));
    }
    result_.blocks.push_back(std::move(block));
  }

  /// Adds a quantity of the network to the inputs of a block, as a sum of sensors.
  void take_in(Blocks::Block& block, const SceneBlock::Input& input, const Record& record) {
    const bool no_feedback = !open_.empty() && open_[result_.blocks.size()] != 0;
    using What = Blocks::Sensor::What;
    if (record.channel == Record::Channel::force) {
      if (record.subject == Record::Subject::element) {
        if (!no_feedback) force(block, record.index, input.sign, input.index);
      } else if (!no_feedback) {
        for (const SceneAssembly::Term& term : scene_.assemblies[at(record.index)].force)
          force(block, term.element, input.sign * term.sign, input.index);
      }
      return;
    }
    const What what = record.channel == Record::Channel::velocity ? What::velocity : What::position;
    const auto [a, b] = [&]() -> std::pair<NodeId, NodeId> {
      switch (record.subject) {
        case Record::Subject::element:
          return {scene_.elements[at(record.index)].a, scene_.elements[at(record.index)].b};
        case Record::Subject::assembly:
          return {scene_.assemblies[at(record.index)].a, scene_.assemblies[at(record.index)].b};
        default:
          return {record.index, ground};
      }
    }();
    for (const auto& [end, sign] : {std::pair{a, input.sign}, std::pair{b, -input.sign}}) {
      if (end == ground) continue;
      const int node = network_.node_of[at(end)], motion = motion_of(node);
      const int giver = motion < 0 ? -1 : network_.motions[at(motion)].block;
      if (what == What::velocity && giver >= 0)
        block.inputs.push_back({true, giver, sign * network_.motions[at(motion)].sign});
      else if (!no_feedback || (motion >= 0 && giver < 0))
        block.inputs.push_back({false, sensor({what, node, giver < 0 ? motion : -1, input.index}), sign});
    }
  }

  /// The index of the block of a force until that is made, and back.
  static int force_of(int index) { return -1 - index; }

  void force(Blocks::Block& block, int element, double sign, int record) {
    const Network::Place& place = network_.places[at(element)];
    if (const auto beside = network_.beside.find(element); beside != network_.beside.end()) block.inputs.push_back({true, force_of(beside->second), sign});
    if (place.role == Role::force && network_.forces[at(place.index)].varying) {
      block.inputs.push_back({true, force_of(place.index), sign});
      return;
    }
    for (const SceneFeed& feed : scene_.feeds) {
      if (feed.element != element || (place.role != Role::motion && place.role != Role::force)) continue;
      block.inputs.push_back({true, feed.block, sign * feed.sign});
      return;
    }
    if (place.role == Role::nothing) return;
    if (place.role != Role::deflection && place.role != Role::rate && place.role != Role::force) {
      const bool condition = std::any_of(scene_.blocks.begin(), scene_.blocks.end(), [&](const SceneBlock& b) { return b.element == block.element && b.of_stop_when; });
      throw SimulationError(
          scene_.elements[at(block.element)].spot,
          fmt::format("{} `{}`: the force of `{}` is what all others at its node leave over; take in that of a spring or a dashpot beside it",
                      condition ? "`stop_when` cannot depend on" : block_in_words(scene_.elements[at(block.element)]) + " cannot take in",
                      scene_.sensed[at(record)].path, scene_.elements[at(element)].name));
    }
    block.inputs.push_back({false, sensor({Blocks::Sensor::What::force, element, -1, record}), sign});
  }

  int motion_of(int node) const {
    const auto moves = [&](const Network::Motion& m) { return m.node == node; };
    const auto found = std::find_if(network_.motions.begin(), network_.motions.end(), moves);
    return found == network_.motions.end() ? -1 : static_cast<int>(found - network_.motions.begin());
  }

  /// The index of a sensor; each quantity is sensed once.
  int sensor(const Blocks::Sensor& wanted) {
    const auto same = [&](const Blocks::Sensor& s) { return s.what == wanted.what && s.index == wanted.index; };
    const auto found = std::find_if(result_.sensors.begin(), result_.sensors.end(), same);
    if (found != result_.sensors.end()) return static_cast<int>(found - result_.sensors.begin());
    result_.sensors.push_back(wanted);
    return static_cast<int>(result_.sensors.size()) - 1;
  }

  /// The power that an element dissipates follows from the rate of its energy, which is not always known for a force.
  void refuse_energy_of_forces(const Network::Force& force, int block, std::vector<char>& seen) const {
    if (std::exchange(seen[at(block)], 1)) return;
    for (const Blocks::Input& input : result_.blocks[at(block)].inputs) {
      if (input.from_block) {
        if (!result_.blocks[at(input.index)].law.state) refuse_energy_of_forces(force, input.index, seen);
        continue;
      }
      const Blocks::Sensor& sensor = result_.sensors[at(input.index)];
      if (sensor.what != Blocks::Sensor::What::force) continue;
      throw SimulationError(network_.spot_of(force.element),
                            fmt::format("the energy that `{}` stores depends on `{}`: it may depend on displacements, velocities and states of blocks alone",
                                        scene_.elements[at(force.element)].name, scene_.sensed[at(sensor.record)].path));
    }
  }

  [[noreturn]] void refuse(const std::vector<int>& loop, const std::string& why) const {
    std::string names;
    for (std::size_t k = 0; k < loop.size(); ++k)
      names += (k == 0 ? "" : k + 1 == loop.size() ? " and " : ", ") + ('`' + name(loop[k]) + '`');
    throw SimulationError(scene_.elements[at(result_.blocks[at(loop.front())].element)].spot,
                          (loop.size() > 1 ? "blocks " : "block ") + names + " " + why);
  }

  const std::string& name(int block) const { return scene_.elements[at(result_.blocks[at(block)].element)].name; }

  Network& network_;
  const Scene& scene_;
  std::size_t first_added_ = 0;         ///< Number of the first of `added_` among all blocks.
  std::vector<std::pair<int, const Network::Slider*>> powers_of_sliders_;  ///< Blocks that take them in.
  std::vector<Blocks::Block> added_;    ///< Powers of elements that blocks take in, and states of transfer functions.
  std::vector<char> open_;  ///< Blocks whose feedback is left out: they sense no unknown of the network; empty: none.
  Blocks result_;
};

}  // namespace

Blocks find_blocks(Network& network) { return Finder(network).find(); }

}  // namespace rheonet
