#include "core/result/output_sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "core/base/index.hpp"
#include "core/network/error.hpp"
#include "core/network/reductions.hpp"
#include "core/result/pair_view.hpp"

namespace rheonet {

namespace {

/// The ends between which a record measures a displacement or a velocity.
struct Ends { NodeId a, b; };

Ends ends_of(const Scene& scene, const Record& record) {
  switch (record.subject) {
    case Record::Subject::node:
      return {record.index, ground};
    case Record::Subject::element:
      return {scene.elements[at(record.index)].a, scene.elements[at(record.index)].b};
    case Record::Subject::block:
    case Record::Subject::expression:
      return {ground, ground};
    case Record::Subject::assembly:
      break;
  }
  return {scene.assemblies[at(record.index)].a, scene.assemblies[at(record.index)].b};
}

bool own_displacement(const Network& network, int element) {
  const Network::Place& place = network.places[at(element)];
  if (place.paired) return true;
  if (place.role != Role::deflection) return false;
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    const int i = place.index - laws.first;
    if (i >= 0 && i < static_cast<int>(laws.batch->size())) return !laws.batch->creeps(at(i));
  }
  return false;
}

/// Some massless node balances the force of a law with a memory. Between steps the unknowns follow polynomials and violate
/// that balance.
bool bent(const Dae& dae) {
  const Structure& structure = dae.structure();
  const auto massless = [&](NodeId node) {
    return structure.kind[at(node)] == Kind::viscous || structure.kind[at(node)] == Kind::floating;
  };
  for (const Laws<DeflectionBatch>& laws : dae.network().deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = structure.deflections[at(laws.first) + i];
      if (laws.batch->events(i) > 0 && b.a != b.b && (massless(b.a) || massless(b.b))) return true;
    }
  }
  return false;
}

/// The records, each expression replaced by its operands.
std::vector<const Record*> operands_of(const Scene& scene, const std::vector<Record>& records) {
  std::vector<const Record*> result;
  result.reserve(records.size());
  for (const Record& record : records) {
    for_each_operand(scene, record, [&](const Record& operand) { result.push_back(&operand); });
  }
  return result;
}

/// Values of the channel depend on the relative velocity of an element.
bool is_power(const Record& record) {
  return record.channel == Record::Channel::power || record.channel == Record::Channel::dissipated;
}

bool is_place(const Record& record) {
  return record.channel == Record::Channel::position || record.channel == Record::Channel::displacement;
}

/// The gauge of each record.
std::vector<Gauge> gauges(const Network& network, const std::vector<const Record*>& records) {
  const Scene& scene = *network.scene;
  std::vector<Gauge> result(records.size());
  // By the ends: elements with a displacement of their own; filled on first use.
  std::map<std::pair<NodeId, NodeId>, int> between;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Record& record = *records[k];
    if (record.channel != Record::Channel::displacement) continue;
    if (record.subject == Record::Subject::element && own_displacement(network, record.index)) {
      result[k] = {record.index, 1};
      continue;
    }
    if (between.empty()) {
      for (int e = 0; at(e) < scene.elements.size(); ++e) {
        if (scene.elements[at(e)].b >= 0 && own_displacement(network, e)) {
          between.insert({{scene.elements[at(e)].a, scene.elements[at(e)].b}, e});
        }
      }
    }
    const Ends ends = ends_of(scene, record);
    if (const auto same = between.find({ends.a, ends.b}); same != between.end()) result[k] = {same->second, 1};
    else if (const auto other = between.find({ends.b, ends.a}); other != between.end()) result[k] = {other->second, -1};
  }
  return result;
}

}  // namespace

std::vector<char> needed_positions(const Network& network) {
  if (kept(*network.scene, Reduction::positions)) return std::vector<char>(network.nodes(), 1);
  std::vector<char> needed(network.nodes(), 0);
  for (const std::vector<Record>* all : {&network.scene->records, &network.scene->claimed}) {
    const std::vector<const Record*> records = operands_of(*network.scene, *all);
    const std::vector<Gauge> measured = gauges(network, records);
    for (std::size_t k = 0; k < records.size(); ++k) {
      const Record& record = *records[k];
      if (!is_place(record) || measured[k].element >= 0) continue;
      const Ends ends = ends_of(*network.scene, record);
      for (const NodeId end : {ends.a, ends.b}) {
        const int node = network.node_of[at(end)];
        needed[at(node < 0 ? network.pairs[at(-1 - node)].slider_end : node)] = 1;
      }
    }
  }
  for (const Network::Motion& motion : network.motions) {
    if (motion.block >= 0) needed[at(motion.node)] = 1;
  }
  for (const Blocks::Sensor& sensor : network.blocks.sensors) {
    if (sensor.what == Blocks::Sensor::What::position) needed[at(sensor.index)] = 1;
  }
  // A slider that begins to stick takes the position of one end from the other: both must be known.
  if (std::find(needed.begin(), needed.end(), 1) == needed.end()) return needed;
  for (const Network::Slider& slider : network.sliders) needed[at(slider.branch.a)] = needed[at(slider.branch.b)] = 1;
  return needed;
}

OutputSampler::OutputSampler(const Network& network, const std::vector<Record>& records)
    : network_(network),
      scene_(*network.scene),
      records_(records),
      operands_(operands_of(scene_, records)),
      gauges_(gauges(network, operands_)),
      values_(operands_.size()),
      row_(records.size()) {}

void OutputSampler::attach(Dae& dae, Consistency& consistency) {
  dae_ = &dae;
  consistency_ = &consistency;
  const Structure& structure = dae.structure();
  const auto floating_node = [&](NodeId node) { return structure.group[at(structure.rigid[at(node)])] >= 0; };
  const auto floating = [&](NodeId end) {
    const int node = network_.node_of[at(end)];
    if (node >= 0) return floating_node(node);
    const Pair& pair = network_.pairs[at(-1 - node)];
    return floating_node(pair.spring_end) || floating_node(pair.slider_end);
  };
  bent_ = bent(dae);
  rates_needed_ = false;
  for (const Record* operand : operands_) {
    const Record& record = *operand;
    if (record.channel == Record::Channel::acceleration) rates_needed_ = follow_acceleration(record.index) || rates_needed_;
    if (is_power(record) && network_.places[at(record.index)].role == Role::deflection) rates_needed_ = true;
    if (record.channel != Record::Channel::velocity && !is_power(record)) continue;
    const Ends ends = ends_of(scene_, record);
    rates_needed_ = rates_needed_ || floating(ends.a) || floating(ends.b);
  }
}

/// Whether the acceleration of a node is the rate of an unknown. Refuses nodes without an equation for their velocity.
bool OutputSampler::follow_acceleration(NodeId end) const {
  const int number = network_.node_of[at(end)];
  const Structure& structure = dae_->structure();
  bool any = false;
  const auto follow = [&](NodeId node) {
    const Kind kind = structure.kind[at(structure.rigid[at(node)])];
    if (kind == Kind::floating) {
      const SceneNode& named = scene_.nodes[at(end)];
      throw SimulationError(
          named.spot,
          fmt::format("the acceleration of node `{}` is not known: the node has no mass, and only springs and laws with a memory hold it; give the "
                      "node a mass, or record its velocity",
                      named.name));
    }
    any = any || kind == Kind::viscous;
  };
  if (number >= 0) {
    follow(number);
  } else {
    follow(network_.pairs[at(-1 - number)].spring_end);
    follow(network_.pairs[at(-1 - number)].slider_end);
  }
  return any;
}

double OutputSampler::position(NodeId end, const Dae::View& view) const {
  const int node = network_.node_of[at(end)];
  if (node >= 0) return view.position[at(node)];
  const PairView pair(network_, -1 - node, view);
  return view.position[at(pair.pair.slider_end)] + pair.slide();
}

double OutputSampler::velocity(NodeId end, const Dae::View& view) const {
  const int node = network_.node_of[at(end)];
  if (node >= 0) return view.velocity[at(node)];
  const PairView pair(network_, -1 - node, view);
  return view.velocity[at(pair.slips() ? pair.pair.spring_end : pair.pair.slider_end)];
}

double OutputSampler::acceleration(NodeId end, const Dae::View& view, const std::vector<double>& rates) const {
  int node = network_.node_of[at(end)];
  if (node < 0) {
    const PairView pair(network_, -1 - node, view);
    node = pair.slips() ? pair.pair.spring_end : pair.pair.slider_end;
  }
  const Structure& structure = dae_->structure();
  const NodeId leader = structure.rigid[at(node)];
  if (structure.kind[at(leader)] == Kind::viscous) return rates[at(dae_->indices().velocity[at(leader)])];
  return view.acceleration[at(leader)];
}

double OutputSampler::displacement(std::size_t operand, const Dae::View& view) const {
  if (const auto [element, sign] = gauges_[operand]; element >= 0) {
    const Network::Place& place = network_.places[at(element)];
    if (!place.paired) return sign * dae_->places().displacement(place.index, dae_->viewed().p);
    const PairView pair(network_, place.index, view);
    return sign * (element == pair.pair.spring ? pair.pair.spring_sign * pair.stretch()
                                               : pair.pair.slider_sign * pair.slide());
  }
  const Ends ends = ends_of(scene_, *operands_[operand]);
  return position(ends.a, view) - position(ends.b, view);
}

double OutputSampler::velocity(const Record& record, const Dae::View& view) const {
  if (record.subject == Record::Subject::element) return element_velocity(record.index, view);
  const Ends ends = ends_of(scene_, record);
  return velocity(ends.a, view) - velocity(ends.b, view);
}

void OutputSampler::refuse_undefined(double t) const { dae_->inputs().blocks().refuse_undefined(t); }

const std::vector<double>& OutputSampler::read(double t, const std::vector<double>& y, const std::vector<double>& yp,
                                          double rate) {
  if ((dae_->rough() || dae_->follows_time() || bent_) && rate > 0) {
    y_ = y;
    slope_ = yp;
    consistency_->collocate(t, rate, y_, slope_);
    return read_state(t, y_, slope_, false);
  }
  return read_state(t, y, yp, rate == 0);
}

const std::vector<double>& OutputSampler::read_state(double t, const std::vector<double>& y, const std::vector<double>& yp,
                                                bool exact) {
  const std::vector<double>* rates = &yp;
  if (rates_needed_ && !exact) {
    consistency_->derivative(t, y, yp_);
    rates = &yp_;
  }
  const Dae::View& view = dae_->view(t, y.data(), rates->data());
  for (std::size_t k = 0; k < operands_.size(); ++k) values_[k] = operands_[k]->factor * value(k, view, *rates);
  std::span<const double> left(values_);
  for (std::size_t k = 0; k < row_.size(); ++k) {
    if (records_[k].subject != Record::Subject::expression) {
      row_[k] = left.front();
      left = left.subspan(1);
      continue;
    }
    const SceneExpression& expression = scene_.expressions[at(records_[k].index)];
    row_[k] = expression.value(left.first(expression.operands.size()));
    left = left.subspan(expression.operands.size());
  }
  return row_;
}

double OutputSampler::value(std::size_t operand, const Dae::View& view, const std::vector<double>& rates) const {
  const Record& record = *operands_[operand];
  switch (record.channel) {
    case Record::Channel::position:
    case Record::Channel::displacement:
      return displacement(operand, view);
    case Record::Channel::velocity:
      return velocity(record, view);
    case Record::Channel::acceleration:
      return acceleration(record.index, view, rates);
    case Record::Channel::power:
      if (network_.places[at(record.index)].role == Role::train) return dissipated_power(record.index, view);
      return element_force(record.index, view) * element_velocity(record.index, view);
    case Record::Channel::dissipated:
      return dissipated_power(record.index, view);
    case Record::Channel::energy:
      return stored_energy(record.index, view);
    case Record::Channel::out:
      return dae_->inputs().blocks().out(record.index).value;
    case Record::Channel::value:
      break;
    case Record::Channel::force:
      if (record.subject == Record::Subject::element) return element_force(record.index, view);
      double sum = 0;
      for (const SceneAssembly::Term& term : scene_.assemblies[at(record.index)].force) {
        sum += term.sign * element_force(term.element, view);
      }
      return sum;
  }
  return 0;
}

}  // namespace rheonet
