#include "tests/support/scene_builder.hpp"

#include <stdexcept>

#include "core/network/component.hpp"

namespace rheonet::test {

namespace {

constexpr std::pair<const char*, Record::Channel> node_channels[] = {{"position", Record::Channel::position},
                                                                     {"velocity", Record::Channel::velocity}};
constexpr std::pair<const char*, Record::Channel> element_channels[] = {{"force", Record::Channel::force},
                                                                        {"displacement", Record::Channel::displacement},
                                                                        {"velocity", Record::Channel::velocity}};

template <class OutputSampler>
Record::Channel channel_of(const OutputSampler& channels, const std::string& name) {
  for (const auto& [text, channel] : channels) {
    if (name == text) return channel;
  }
  throw std::invalid_argument("no channel " + name);
}

int declaration_of(const std::string& type) {
  for (std::size_t k = 0; k < declarations().size(); ++k) {
    if (declarations()[k]->type == type) return static_cast<int>(k);
  }
  throw std::invalid_argument("no component " + type);
}

const Declaration& declared(const SceneElement& element) {
  return *declarations()[static_cast<std::size_t>(element.declaration)];
}

int parameter_of(const SceneElement& element, const std::string& name) {
  const std::vector<Parameter>& parameters = declared(element).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].name == name) return static_cast<int>(k);
  }
  throw std::invalid_argument("no parameter " + name);
}

}  // namespace

SceneBuilder::SceneBuilder(Domain domain) {
  scene_.domain = domain;
  node("ground");
}

NodeId SceneBuilder::node(const std::string& name) {
  for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
    if (scene_.nodes[n].name == name) return static_cast<NodeId>(n);
  }
  scene_.nodes.push_back({.name = name, .spot = {}});
  return static_cast<NodeId>(scene_.nodes.size() - 1);
}

void SceneBuilder::start(const std::string& name, double position, double velocity) {
  SceneNode& n = scene_.nodes[static_cast<std::size_t>(node(name))];
  n.position = position;
  n.velocity = velocity;
}

SceneElement SceneBuilder::element(const std::string& name, const std::string& type, Given given) {
  SceneElement element;
  element.name = name;
  element.declaration = declaration_of(type);
  for (const Parameter& p : declared(element).parameters) element.values.own().push_back(p.fallback.value_or(not_given));
  for (const auto& [parameter, value] : given) {
    element.values.own()[static_cast<std::size_t>(parameter_of(element, parameter))] = value;
  }
  return element;
}

int SceneBuilder::add(SceneElement element, const std::string& a, const std::string& b) {
  element.a = node(a);
  element.b = element.at ? ground : node(b);
  scene_.elements.push_back(std::move(element));
  return static_cast<int>(scene_.elements.size() - 1);
}

int SceneBuilder::between(const std::string& name, const std::string& type, const std::string& a, const std::string& b,
                          Given given) {
  return add(element(name, type, given), a, b);
}

int SceneBuilder::at(const std::string& name, const std::string& type, const std::string& node, Given given) {
  SceneElement e = element(name, type, given);
  e.at = true;
  return add(std::move(e), node, "");
}

int SceneBuilder::motion(const std::string& name, const std::string& node, const std::string& parameter,
                         Signal signal) {
  SceneElement e = element(name, "motion");
  e.at = true;
  e.signal_parameters = {parameter_of(e, parameter)};
  e.signals = {std::move(signal)};
  return add(std::move(e), node, "");
}

int SceneBuilder::force(const std::string& name, const std::string& node, Signal signal) {
  SceneElement e = element(name, "force");
  e.at = true;
  e.signal_parameters = {0};
  e.signals = {std::move(signal)};
  return add(std::move(e), node, "");
}

int SceneBuilder::force(const std::string& name, const std::string& a, const std::string& b, Signal signal) {
  SceneElement e = element(name, "force");
  e.signal_parameters = {0};
  e.signals = {std::move(signal)};
  return add(std::move(e), a, b);
}

void SceneBuilder::record(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  const std::string name = path.substr(0, dot), channel = path.substr(dot + 1);
  for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
    if (scene_.elements[e].name != name) continue;
    scene_.records.push_back(
        {path, Record::Subject::element, static_cast<int>(e), channel_of(element_channels, channel)});
    return;
  }
  scene_.records.push_back({path, Record::Subject::node, node(name), channel_of(node_channels, channel)});
}

std::vector<Record> SceneBuilder::everything() const {
  std::vector<Record> records;
  const auto add = [&](const std::string& name, Record::Subject subject, std::size_t index, const auto& channels) {
    for (const auto& [text, channel] : channels) {
      records.push_back({name + "." + text, subject, static_cast<int>(index), channel});
    }
  };
  for (std::size_t n = 1; n < scene_.nodes.size(); ++n) {
    add(scene_.nodes[n].name, Record::Subject::node, n, node_channels);
  }
  for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
    add(scene_.elements[e].name, Record::Subject::element, e, element_channels);
  }
  return records;
}

Scene SceneBuilder::finish(double stop, int intervals, double accuracy) const {
  Scene scene = scene_;
  scene.stop = stop;
  scene.accuracy = accuracy;
  scene.output_intervals = intervals;
  scene.output_every = stop / intervals;
  if (scene.records.empty()) scene.records = everything();
  return scene;
}

}  // namespace rheonet::test
