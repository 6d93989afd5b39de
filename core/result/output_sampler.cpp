#include "core/result/output_sampler.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/index.hpp"
#include "core/network/reductions.hpp"

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
      return {ground, ground};
    case Record::Subject::assembly:
      break;
  }
  return {scene.assemblies[at(record.index)].a, scene.assemblies[at(record.index)].b};
}

/// A spring and its slider in a state of their bundle; positive from the spring's end to the slider's.
struct PairView {
  PairView(const Network& network, int k, const Dae::View& view)
      : pair(network.pairs[at(k)]),
        bundle((*network.bundles)[at(pair.bundle)]),
        branch(network.first_bundle + pair.bundle),
        p(view.p[at(branch)]) {}
  double force() const { return pair.sign * bundle.pair_force(pair.index, p); }
  double stretch() const { return pair.sign * bundle.stretch(pair.index, p); }
  double slide() const { return pair.sign * bundle.slide(pair.index, p); }
  bool slips() const { return bundle.pair_yields(pair.index, p); }

  const Pair& pair;
  const Iwan& bundle;
  int branch;
  double p;
};

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

bool is_place(const Record& record) {
  return record.channel == Record::Channel::position || record.channel == Record::Channel::displacement;
}

}  // namespace

std::vector<Gauge> gauges(const Network& network, const std::vector<Record>& records) {
  const Scene& scene = *network.scene;
  std::vector<Gauge> result(records.size());
  // By the ends: elements with a displacement of their own; filled on first use.
  std::map<std::pair<NodeId, NodeId>, int> between;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Record& record = records[k];
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

std::vector<char> needed_positions(const Network& network) {
  if (kept(*network.scene, Reduction::positions)) return std::vector<char>(network.nodes(), 1);
  std::vector<char> needed(network.nodes(), 0);
  for (const std::vector<Record>* records : {&network.scene->records, &network.scene->claimed}) {
    const std::vector<Gauge> measured = gauges(network, *records);
    for (std::size_t k = 0; k < records->size(); ++k) {
      const Record& record = (*records)[k];
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
    : network_(network), scene_(*network.scene), records_(records), gauges_(gauges(network, records)), row_(records.size()) {}

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
  for (const Record& record : records_) {
    if (record.channel != Record::Channel::velocity) continue;
    const Ends ends = ends_of(scene_, record);
    rates_needed_ = rates_needed_ || floating(ends.a) || floating(ends.b);
  }
}

double OutputSampler::element_force(int element, const Dae::View& view) const {
  const Network& network = network_;
  const Network::Place& place = network.places[at(element)];
  if (place.paired) {
    const PairView pair(network, place.index, view);
    return (element == pair.pair.spring ? pair.pair.spring_sign : pair.pair.slider_sign) * pair.force();
  }
  switch (place.role) {
    case Role::deflection: {
      // Round-off of the displacement times a stiffness of 1e12 N/m can lift the force above its bound at the event.
      std::size_t i = 0;
      const double bound = network.batch_of(place.index, i).steady(i).bound;
      return std::clamp(view.f[at(place.index)], -bound, bound);
    }
    case Role::rate:
      return view.rate_force[at(place.index)];
    case Role::slip:
      return view.slider_force[at(place.index)];
    case Role::mass: {
      const Network::Mass& m = network.masses[at(place.index)];
      return m.mass * view.acceleration[at(m.node)];
    }
    case Role::inerter:
      return dae_->inerter_force(at(place.index));
    case Role::motion:
      return dae_->reaction(network.motions[at(place.index)].node);
    case Role::force:
      return dae_->applied_force(place.index);
    case Role::block:
    case Role::nothing:
      break;
  }
  return 0;
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

double OutputSampler::displacement(std::size_t record, const Dae::View& view) const {
  if (const auto [element, sign] = gauges_[record]; element >= 0) {
    const Network::Place& place = network_.places[at(element)];
    if (!place.paired) return sign * dae_->displacement(place.index);
    const PairView pair(network_, place.index, view);
    return sign * (element == pair.pair.spring ? pair.pair.spring_sign * pair.stretch()
                                               : pair.pair.slider_sign * pair.slide());
  }
  const Ends ends = ends_of(scene_, records_[record]);
  return position(ends.a, view) - position(ends.b, view);
}

double OutputSampler::velocity(const Record& record, const Dae::View& view) const {
  if (record.subject == Record::Subject::element) {
    const Network::Place& place = network_.places[at(record.index)];
    if (place.paired) {
      const PairView pair(network_, place.index, view);
      const bool spring = record.index == pair.pair.spring;
      if (spring == pair.slips()) return 0;
      return (spring ? pair.pair.spring_sign : pair.pair.slider_sign) * pair.pair.sign * view.flow[at(pair.branch)];
    }
    if (place.role == Role::deflection) return view.flow[at(place.index)];
    if (place.role == Role::rate) return view.rate_velocity[at(place.index)];
    if (place.role == Role::slip) return view.slider_velocity[at(place.index)];
  }
  const Ends ends = ends_of(scene_, record);
  return velocity(ends.a, view) - velocity(ends.b, view);
}

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
  for (std::size_t k = 0; k < row_.size(); ++k) {
    const Record& record = records_[k];
    switch (record.channel) {
      case Record::Channel::position:
      case Record::Channel::displacement:
        row_[k] = displacement(k, view);
        break;
      case Record::Channel::velocity:
        row_[k] = velocity(record, view);
        break;
      case Record::Channel::out:
        row_[k] = dae_->output(record.index);
        break;
      case Record::Channel::force:
        row_[k] = 0;
        if (record.subject == Record::Subject::element) {
          row_[k] = element_force(record.index, view);
        } else {
          for (const SceneAssembly::Term& term : scene_.assemblies[at(record.index)].force) {
            row_[k] += term.sign * element_force(term.element, view);
          }
        }
        break;
    }
  }
  return row_;
}

}  // namespace rheonet
