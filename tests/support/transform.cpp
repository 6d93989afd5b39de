#include "tests/support/transform.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/index.hpp"
#include "core/netlist/records.hpp"
#include "core/network/component.hpp"

namespace rheonet::test {

namespace {

const Declaration& declaration_of(const SceneElement& element) { return *declarations()[at(element.declaration)]; }

const Parameter& parameter_of(const SceneElement& element, std::size_t signal) {
  return declaration_of(element).parameters[at(element.signal_parameters[signal])];
}

/// Calls `change(quantity, signal)`.
template <class Change>
void for_each_signal(Scene& scene, const Change& change) {
  for (SceneElement& e : scene.elements)
    for (std::size_t k = 0; k < e.signals.size(); ++k) change(parameter_of(e, k).quantity, e.signals.own()[k]);
}

struct Transform {
  double value, time, add;

  Signal::Shape operator()(Signal::Constant s) const { return Signal::Constant{value * s.value + add}; }
  Signal::Shape operator()(Signal::Step s) const {
    return Signal::Step{value * s.height, time * s.time, value * s.offset + add};
  }
  Signal::Shape operator()(Signal::Ramp s) const {
    return Signal::Ramp{value / time * s.slope, time * s.time, value * s.offset + add, time * s.duration};
  }
  template <class Periodic>  // Sine, Square, Triangle
  Signal::Shape operator()(Periodic s) const {
    return Periodic{value * s.amplitude, s.frequency / time, s.phase, time * s.time, value * s.offset + add};
  }
  Signal::Shape operator()(Signal::Noise s) const {
    return Signal::Noise{value * s.amplitude, time * s.interval, s.seed, time * s.time, value * s.offset + add};
  }
  Signal::Shape operator()(Signal::Chirp s) const {
    return Signal::Chirp{value * s.amplitude, s.frequency / time,    s.end_frequency / time, time * s.duration, s.phase,
                         time * s.time,       value * s.offset + add};
  }
  Signal::Shape operator()(Signal::Pulse s) const {
    return Signal::Pulse{value * s.height, time * s.width, s.frequency / time,
                         s.phase,          time * s.time,  value * s.offset + add};
  }
  Signal::Shape operator()(Signal::Table s) const {
    for (double& t : s.times) t *= time;
    for (double& x : s.values) x *= value;
    s.time *= time;
    s.offset = value * s.offset + add;
    return s;
  }
};

void require_no_ground(const Scene& scene) {
  for (const SceneElement& e : scene.elements) REQUIRE_MESSAGE((e.at || (e.a != ground && e.b != ground)), e.name);
}

void negate_oriented(SceneElement& element) {
  const std::vector<Parameter>& parameters = declaration_of(element).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (oriented(parameters[k])) element.values.own()[k] = -element.values[k];
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      if (parameters[other].name == parameters[k].turned) std::swap(element.values.own()[k], element.values.own()[other]);
    }
  }
  for (std::size_t k = 0; k < element.signals.size(); ++k) {
    if (oriented(parameters[at(element.signal_parameters[k])])) element.signals.own()[k] = transformed(element.signals[k], -1);
  }
}

}  // namespace

double Scaling::of(Quantity quantity, Domain domain, double flow_index) const {
  const Dimension d = dimension_of(quantity, domain, flow_index);
  // In base units: the mass that `force` gives `length` per `time`^2 to; in rotation the inertia over length^2.
  const double mass = force * time * time / (domain == Domain::rotation ? length * length : length);
  return std::pow(length, d.metre) * std::pow(mass, d.kilogram) * std::pow(time, d.second);
}

double factor(const Scene& scene, const Record& record, const Scaling& scaling) {
  switch (record.channel) {
    case Record::Channel::position:
    case Record::Channel::displacement:
      return scaling.of(Quantity::position, scene.domain);
    case Record::Channel::velocity:
      return scaling.of(Quantity::velocity, scene.domain);
    case Record::Channel::force:
    case Record::Channel::out:  // no scene that is scaled has blocks
      break;
    case Record::Channel::acceleration:
    case Record::Channel::power:
    case Record::Channel::dissipated:
    case Record::Channel::energy:
    case Record::Channel::value:
      return scaling.of(quantity_of(record.channel), scene.domain);
  }
  return scaling.of(Quantity::force, scene.domain);
}

bool oriented(const Parameter& parameter) {
  const bool directed = parameter.quantity == Quantity::position || parameter.quantity == Quantity::velocity ||
                        parameter.quantity == Quantity::force;
  return parameter.kind == Parameter::Kind::signal || (directed && parameter.lower < 0);
}

bool one_way(const SceneElement& element) {
  const Component& component = *components()[at(element.declaration)];
  if (!component.box || !element.signals.empty()) return false;
  const std::vector<double> values = element.values;
  const Box box = constant_box(component, values);
  return std::isinf(box.forward.sliding.value) != std::isinf(box.backward.sliding.value);
}

double flow_index(const Declaration& declaration, const Parameter& parameter, const std::vector<double>& values) {
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    if (declaration.parameters[k].name == parameter.flow_index) return values[k];
  }
  return 1;
}

Signal transformed(const Signal& signal, double value, double time, double add) {
  return Signal(std::visit(Transform{value, time, add}, signal.shape()));
}

bool drives(const SceneElement& element) {
  const Role role = components()[at(element.declaration)]->role;
  return element.at && (role == Role::motion || role == Role::force);
}

namespace {

Quantity driven_quantity(const SceneElement& drive) { return parameter_of(drive, 0).quantity; }

bool fed(const Scene& scene, int element) {
  return std::any_of(scene.feeds.begin(), scene.feeds.end(), [&](const SceneFeed& feed) { return feed.element == element; });
}

/// Starts the shaft of a drive where the driven node is: a gear keeps the ratio of positions only from where they start.
void start_alike(const SceneElement& drive, double start, SceneNode& shaft, SceneNode& driven, double ratio) {
  if (driven_quantity(drive) == Quantity::position) {
    if (std::isnan(driven.position)) driven.position = drive.signals[0].before(start) / ratio;
    return;
  }
  shaft.position = ratio * driven.position;
  if (driven_quantity(drive) == Quantity::acceleration) shaft.velocity = ratio * driven.velocity;
}

}  // namespace

Scene behind_gears(const Scene& scene, double ratio) {
  Scene result = scene;
  std::vector<int> driving;
  for (int e = 0; at(e) < scene.elements.size(); ++e) {
    const SceneElement& element = scene.elements[at(e)];
    if (drives(element) && element.a != ground && !(fed(scene, e) && driven_quantity(element) == Quantity::position)) driving.push_back(e);
  }
  const int added = static_cast<int>(driving.size());
  const auto move = [added](NodeId& node) { node = node == ground ? ground : node + added; };
  const auto move_record = [&](Record& record) {
    if (record.subject == Record::Subject::node) move(record.index);
  };
  std::vector<SceneNode> nodes{scene.nodes.front()};
  for (const int e : driving) nodes.push_back({.name = scene.elements[at(e)].name + "_shaft", .spot = {}});
  nodes.insert(nodes.end(), scene.nodes.begin() + 1, scene.nodes.end());
  result.nodes = nodes;
  for (SceneElement& element : result.elements) {
    move(element.a);
    move(element.b);
    move(element.support);
  }
  for (SceneAssembly& assembly : result.assemblies) {
    move(assembly.a);
    move(assembly.b);
  }
  for (std::vector<Record>* records : {&result.records, &result.claimed, &result.sensed}) {
    for (Record& record : *records) move_record(record);
  }
  for (SceneExpression& expression : result.expressions) {
    for (Record& operand : expression.operands) move_record(operand);
  }
  for (int k = 0; k < added; ++k) {
    SceneElement& drive = result.elements[at(driving[at(k)])];
    const bool motion = components()[at(drive.declaration)]->role == Role::motion;
    const double factor = motion ? ratio : 1 / ratio;
    drive.signals.own()[0] = transformed(drive.signals[0], factor);
    for (SceneFeed& feed : result.feeds) {
      if (feed.element == driving[at(k)]) feed.sign *= factor;
    }
    SceneElement gear;
    gear.name = drive.name + "_gear";
    gear.declaration = static_cast<int>(std::find(components().begin(), components().end(), find_component("gear")) - components().begin());
    gear.values = {ratio, 1, 1, 0, 0};
    gear.a = k + 1;
    gear.b = std::exchange(drive.a, k + 1);
    start_alike(drive, scene.start, result.nodes[at(gear.a)], result.nodes[at(gear.b)], ratio);
    result.elements.push_back(gear);
  }
  return result;
}

Scene rescaled(Scene scene, const Scaling& scaling) {
  for (SceneNode& n : scene.nodes) {
    n.position *= scaling.of(Quantity::position, scene.domain);
    n.velocity *= scaling.of(Quantity::velocity, scene.domain);
  }
  for (SceneElement& e : scene.elements) {
    const Declaration& d = declaration_of(e);
    const std::vector<double> before = e.values;
    for (std::size_t k = 0; k < d.parameters.size(); ++k) {
      e.values.own()[k] *= scaling.of(quantity_of(d, e, k), scene.domain, flow_index(d, d.parameters[k], before));
    }
    for (std::size_t k = 0; k < e.signals.size(); ++k) {
      e.signals.own()[k] = transformed(e.signals[k], scaling.of(quantity_of(declaration_of(e), e, at(e.signal_parameters[k])), scene.domain), scaling.time);
    }
  }
  scene.start *= scaling.time;
  scene.stop *= scaling.time;
  scene.output_every *= scaling.time;
  return scene;
}

Scene negated(Scene scene) {
  for (SceneNode& n : scene.nodes) {
    n.position = -n.position;
    n.velocity = -n.velocity;
  }
  for (SceneElement& e : scene.elements) {
    if (one_way(e)) std::swap(e.a, e.b);
    negate_oriented(e);
  }
  return scene;
}

Scene shifted(Scene scene, double dx) {
  require_no_ground(scene);
  for (std::size_t n = 1; n < scene.nodes.size(); ++n) scene.nodes[n].position += dx;
  for_each_signal(scene, [dx](Quantity quantity, Signal& signal) {
    if (quantity == Quantity::position) signal = transformed(signal, 1, 1, dx);
  });
  return scene;
}

Scene boosted(Scene scene, double v) {
  require_no_ground(scene);
  for (std::size_t n = 1; n < scene.nodes.size(); ++n) scene.nodes[n].velocity += v;
  for_each_signal(scene, [v](Quantity quantity, Signal& signal) {
    REQUIRE(quantity != Quantity::position);
    if (quantity == Quantity::velocity) signal = transformed(signal, 1, 1, v);
  });
  return scene;
}

Scene exchanged(Scene scene, int element) {
  SceneElement& e = scene.elements[at(element)];
  REQUIRE(!e.at);
  std::swap(e.a, e.b);
  // A signal belongs to the first end: for the same effect it is negated with the rest.
  negate_oriented(e);
  return scene;
}

}  // namespace rheonet::test
