#include "core/netlist/records.hpp"

#include <algorithm>
#include <unordered_set>

#include "core/netlist/record_expressions.hpp"
#include "core/netlist/scene_index.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

using Channel = Record::Channel;
using Subject = Record::Subject;

constexpr std::pair<const char*, Channel> channels[] = {{"position", Channel::position},
                                                        {"velocity", Channel::velocity},
                                                        {"displacement", Channel::displacement},
                                                        {"force", Channel::force},
                                                        {"acceleration", Channel::acceleration},
                                                        {"power", Channel::power},
                                                        {"dissipated", Channel::dissipated},
                                                        {"energy", Channel::energy},
                                                        {"out", Channel::out}};

/// Powers and energies are scalars: those of an assembly are sums over its elements.
bool is_scalar(Channel channel) {
  return channel == Channel::power || channel == Channel::dissipated || channel == Channel::energy;
}

struct Path {
  std::string object;
  std::string channel;
  const TomlValue* source;  ///< nullptr: no channel
};

/// The channels that can be recorded, or be inputs of blocks.
std::vector<std::string> channels_of(const SceneIndex::Found& found, bool sensed) {
  std::vector<std::string> names;
  if (found.block >= 0) names = {"out"};
  if (found.node >= 0) names.insert(names.end(), {"position", "velocity"});
  if (found.node >= 0 && !sensed) names.emplace_back("acceleration");
  if (found.block >= 0 || (found.element < 0 && found.assembly < 0)) return names;
  names.insert(names.end(), {"force", "displacement"});
  if (found.node < 0) names.emplace_back("velocity");
  if (!sensed || found.element >= 0) names.emplace_back("power");
  if (!sensed) names.insert(names.end(), {"dissipated", "energy"});
  return names;
}

/// The channel meant by a word of rotational scenes, or by another word that users may try.
std::string meant_channel(const std::string& channel, const std::vector<std::string>& known) {
  const auto may = [&](const char* name) { return std::find(known.begin(), known.end(), name) != known.end(); };
  if (channel == "torque" && may("force")) return "force";
  if (channel == "speed" && may("velocity")) return "velocity";
  if (channel == "angle" || channel == "position" || channel == "displacement")
    return may("position") ? "position" : "displacement";
  return nearest(channel, known);
}

std::optional<Record> resolve(const Path& path, const SceneIndex::Found& found) {
  const auto channel =
      std::find_if(std::begin(channels), std::end(channels), [&](const auto& c) { return path.channel == c.first; });
  if (channel == std::end(channels)) return {};
  Record record{path.object + '.' + path.channel, Subject::node, found.node, channel->second};
  const bool of_node_alone = record.channel == Channel::position || record.channel == Channel::acceleration;
  if ((of_node_alone || record.channel == Channel::velocity) && found.node >= 0) return record;
  if (of_node_alone || (record.channel == Channel::out) != (found.block >= 0)) return {};
  if (found.block >= 0) {
    record.subject = Subject::block;
    record.index = found.block;
    return record;
  }
  if (found.element >= 0) {
    record.subject = Subject::element;
    record.index = found.element;
    return record;
  }
  if (found.assembly < 0) return {};
  record.subject = Subject::assembly;
  record.index = found.assembly;
  return record;
}

/// Whether the record is a difference of an angle and a length.
bool measures_across_domains(const Scene& scene, const Record& record) {
  if (record.channel != Channel::displacement && record.channel != Channel::velocity) return false;
  const auto k = static_cast<std::size_t>(record.index);
  if (record.subject == Subject::element) return !scene.elements[k].at && joins_domains(scene, scene.elements[k].a, scene.elements[k].b);
  return record.subject == Subject::assembly && joins_domains(scene, scene.assemblies[k].a, scene.assemblies[k].b);
}

void refuse(const Path& path, const SceneIndex::Found& found, bool sensed, Context& context, const Scene& scene) {
  const TomlValue& source = *path.source;
  if (!found.any()) {
    const auto known = known_paths(scene, true);
    // A member of a group is often named without its group.
    const auto member = std::find_if(known.begin(), known.end(), [&](const std::string& name) { return name.ends_with('.' + path.object); });
    const std::string meant = member != known.end() ? *member : nearest(path.object, known);
    context.diagnostics.error(source.spot, "nothing is called `" + path.object + "`",
                           meant.empty() ? "" : "did you mean `" + meant + "." + path.channel + "`?");
    return;
  }
  const auto known = channels_of(found, sensed);
  const Spot spot = context.diagnostics.inside(source, path.object.size() + 1);
  const bool of_node = path.channel == "position" || path.channel == "acceleration";
  if (found.block < 0 && found.element >= 0 && scene.elements[static_cast<std::size_t>(found.element)].at && of_node) {
    const NodeId node = scene.elements[static_cast<std::size_t>(found.element)].a;
    context.diagnostics.error(spot, "`" + path.object + "` has no `" + path.channel + "`: it is an element, only nodes have one",
                           "that of its node is `" + scene.nodes[static_cast<std::size_t>(node)].name + '.' + path.channel + '`');
    return;
  }
  const std::string part = path.object + '.' + path.channel;
  if (const SceneIndex::Found inside = SceneIndex(scene, {part}).find(part); inside.any()) {
    context.diagnostics.error(source.spot, "`" + part + "` does not say which quantity is meant",
                              "did you mean `" + part + "." + channels_of(inside, sensed).front() + "`?");
    return;
  }
  const std::string meant = meant_channel(path.channel, known);
  const bool of_element = found.node >= 0 && (path.channel == "force" || path.channel == "displacement");
  context.diagnostics.error(
      spot, "`" + path.object + "` has no `" + path.channel + (of_element ? "`: it is a node, only elements have one" : "`"),
      meant.empty() ? "it has " + list_names(known, "and") : "did you mean `" + path.object + "." + meant + "`?");
}

}  // namespace

std::vector<Record> every_record(const Scene& scene) {
  std::vector<Record> records;
  const auto add = [&](const std::string& name, Subject subject, std::size_t index,
                       std::initializer_list<Channel> wanted) {
    for (const Channel channel : wanted)
      for (const auto& [word, known] : channels)
        if (known == channel) records.push_back({name + '.' + word, subject, static_cast<int>(index), channel});
  };
  for (std::size_t i = 1; i < scene.nodes.size(); ++i)
    add(scene.nodes[i].name, Subject::node, i, {Channel::position, Channel::velocity});
  std::size_t block = 0;
  for (std::size_t i = 0; i < scene.elements.size(); ++i) {
    if (block < scene.blocks.size() && scene.blocks[block].element == static_cast<int>(i)) {
      if (!scene.blocks[block].of_stop_when && scene.elements[i].part != SceneElement::Part::inner) add(scene.elements[i].name, Subject::block, block, {Channel::out});
      ++block;
      continue;
    }
    // An element at a node moves with the node, whose motion is recorded already.
    if (scene.elements[i].at || joins_domains(scene, scene.elements[i].a, scene.elements[i].b))
      add(scene.elements[i].name, Subject::element, i, {Channel::force});
    else
      add(scene.elements[i].name, Subject::element, i, {Channel::force, Channel::displacement, Channel::velocity});
  }
  for (std::size_t i = 0; i < scene.assemblies.size(); ++i) {
    if (joins_domains(scene, scene.assemblies[i].a, scene.assemblies[i].b))
      add(scene.assemblies[i].name, Subject::assembly, i, {Channel::force});
    else
      add(scene.assemblies[i].name, Subject::assembly, i, {Channel::force, Channel::displacement, Channel::velocity});
  }
  return records;
}

namespace {

bool is_doubtful(const std::string& path, const std::set<std::string>& doubtful) {
  return doubtful.contains(path.substr(0, path.find('.')));
}

}  // namespace

Quantity quantity_of(Channel channel) {
  switch (channel) {
    case Channel::position:
    case Channel::displacement:
      return Quantity::position;
    case Channel::velocity:
      return Quantity::velocity;
    case Channel::acceleration:
      return Quantity::acceleration;
    case Channel::power:
    case Channel::dissipated:
      return Quantity::power;
    case Channel::energy:
      return Quantity::energy;
    case Channel::value:
      return Quantity::number;
    case Channel::force:
    case Channel::out:
      break;
  }
  return Quantity::force;
}

bool may_be_sensed(const Record& record) {
  return record.channel == Channel::position || record.channel == Channel::velocity || record.channel == Channel::displacement ||
         record.channel == Channel::force || (record.channel == Channel::power && record.subject == Subject::element);
}

BlockUnit unit_of(const Scene& scene, const Record& record) {
  if (record.subject == Subject::block) return scene.blocks[static_cast<std::size_t>(record.index)].unit;
  if (record.subject == Subject::expression) return scene.expressions[static_cast<std::size_t>(record.index)].unit;
  const bool by_angle = record.channel != Channel::force && !is_scalar(record.channel);
  const Domain domain = domain_of(scene, record);
  const double radian = domain == Domain::rotation && by_angle ? 1 : 0;
  return {dimension_of(quantity_of(record.channel), domain), radian, false};
}

Number one_of(const BlockUnit& unit) {
  return {.value = 1, .dimension = unit.dimension, .plain = unit.open, .radian = unit.radian};
}

BlockUnit unit_of(const Number& number) { return {number.dimension, number.radian, number.plain}; }

std::optional<Quantity> quantity_of(const Scene& scene, const Record& record) {
  if (record.subject != Subject::block && record.subject != Subject::expression) return quantity_of(record.channel);
  const BlockUnit unit = unit_of(scene, record);
  if (unit.open) return {};
  // An exponent of rad distinguishes an angle from a number; in other units it has no meaning, and is often omitted.
  const Domain domain = domain_of(scene, record);
  const bool angle = domain == Domain::rotation && unit.radian != 0;
  for (const Quantity known : {angle ? Quantity::position : Quantity::number, Quantity::position, Quantity::velocity, Quantity::force, Quantity::acceleration, Quantity::power, Quantity::energy})
    if (unit.dimension.same(dimension_of(known, domain))) return known;
  return {};
}

std::string unit_text(const Scene& scene, const Record& record) {
  const auto known = quantity_of(scene, record);
  return known ? unit_of(*known, domain_of(scene, record)) : to_string(unit_of(scene, record).dimension);
}

namespace {

std::vector<std::string> expression_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneExpression& expression : scene.expressions) names.push_back(expression.name);
  return names;
}

}  // namespace

std::vector<std::optional<Record>> find_records(const std::vector<TomlValue>& paths,
                                                const std::set<std::string>& doubtful, Context& context,
                                                Scene& scene, bool sensed, const SceneIndex* known) {
  DiagnosticList& diagnostics = context.diagnostics;
  std::vector<Path> parts;
  std::vector<std::string> objects;
  for (const TomlValue& path : paths) {
    const std::size_t dot = path.text.rfind('.');
    const bool whole = dot == path.text.npos;
    const bool expression = find_expression(scene, path.text).has_value();
    if (!expression && path.text == "time")
      diagnostics.error(path.spot, "`time` is no quantity of an element or a node: it is the first column always",
                     "leave it out");
    else if (!expression && whole && !is_doubtful(path.text, doubtful))
      diagnostics.error(path.spot, "`" + path.text + "` does not say which quantity is meant",
                     did_you_mean(path.text, expression_names(scene), "for instance `" + path.text + ".force` of an element, `" + path.text + ".velocity` of a node"));
    parts.push_back({path.text.substr(0, dot), whole ? "" : path.text.substr(dot + 1), whole && !expression ? nullptr : &path});
    objects.push_back(parts.back().object);
  }
  std::optional<SceneIndex> own;
  const SceneIndex& index = known ? *known : own.emplace(scene, objects);
  std::vector<std::optional<Record>> records;
  for (const Path& path : parts) {
    records.emplace_back();
    if (!path.source) continue;
    if (auto expression = find_expression(scene, path.source->text)) {
      records.back() = std::move(expression);
      continue;
    }
    const auto found = index.find(path.object);
    if (path.object == "ground")
      diagnostics.error(path.source->spot, "`ground` never moves: there is nothing to record of it");
    else if (auto record = resolve(path, found); record && measures_across_domains(scene, *record))
      diagnostics.error(path.source->spot, "`" + path.object + "` has no `" + path.channel + "`: one of its ends turns, the other moves along a line",
                     "record the motions of its nodes");
    else if (record)
      records.back() = record->subject == Subject::assembly && is_scalar(record->channel)
                           ? sum_over_assembly(record->path, scene.assemblies[static_cast<std::size_t>(record->index)], record->channel,
                                               path.source->spot, context, scene)
                           : std::move(record);
    else if (found.any() || !is_doubtful(path.object, doubtful))
      refuse(path, found, sensed, context, scene);
  }
  return records;
}

void resolve_records(const TomlEntry* record, const Environment& environment, std::set<std::string>& doubtful, Context& context,
                     Scene& scene) {
  if (!record) {
    scene.records = every_record(scene);
    return;
  }
  DiagnosticList& diagnostics = context.diagnostics;
  const std::string hint = "record = [\"k1.force\", \"mid.velocity\"]";
  if (!expect_array(record->value, "`record`", diagnostics, hint)) return;
  if (record->value.items.empty())
    diagnostics.warning(record->value.spot, "`record` is empty: only the time is written",
                     "without `record` everything is, or name some: " + hint);
  std::vector<const TomlValue*> tables;
  for (const TomlValue& item : record->value.items) {
    if (item.is_table()) tables.push_back(&item);
  }
  const auto expressions = read_record_expressions(tables, environment, doubtful, context, scene);
  std::vector<TomlValue> paths;
  std::unordered_set<std::string> seen;
  auto expression = expressions.begin();
  for (const TomlValue& item : record->value.items) {
    TomlValue path = item;
    if (item.is_table()) {
      const std::optional<Record>& made = *expression++;
      if (!made) continue;
      path.kind = TomlValue::Kind::string;
      path.text = made->path;
    } else if (!expect_string(item, "what to record", diagnostics, hint)) {
      continue;
    }
    if (seen.insert(path.text).second)
      paths.push_back(std::move(path));
    else
      diagnostics.warning(item.spot, "`" + path.text + "` is recorded already: it has one column");
  }
  for (auto& found : find_records(paths, doubtful, context, scene))
    if (found) scene.records.push_back(std::move(*found));
}

void add_records(const std::vector<std::string>& paths, const std::set<std::string>& doubtful, Context& context,
                 Sources& sources, Scene& scene) {
  std::vector<TomlValue> wanted;
  for (const std::string& path : paths) {
    const auto is_recorded = [&path](const Record& record) { return record.path == path; };
    if (std::any_of(scene.records.begin(), scene.records.end(), is_recorded)) continue;
    sources.command_line.push_back(path);
    wanted.emplace_back();
    wanted.back().kind = TomlValue::Kind::string;
    wanted.back().spot = {Spot::command_line, static_cast<int>(sources.command_line.size()), 1};
    wanted.back().text = path;
  }
  for (auto& found : find_records(wanted, doubtful, context, scene))
    if (found) scene.records.push_back(std::move(*found));
}

void read_initial_values(const TomlValue& nodes, const Environment& environment, const std::set<std::string>& doubtful,
                         Context& context, Scene& scene) {
  DiagnosticList& diagnostics = context.diagnostics;
  if (!expect_table(nodes, "`nodes`", diagnostics)) return;
  std::vector<std::string> names;
  for (const TomlEntry& entry : nodes.entries) names.push_back(entry.key);
  const SceneIndex index(scene, names);
  for (const TomlEntry& entry : nodes.entries) {
    if (entry.key == "ground") {
      diagnostics.error(entry.spot, "`ground` never moves: it has no initial values");
      continue;
    }
    const auto found = index.find(entry.key);
    if (found.node < 0) {
      if (is_doubtful(entry.key, doubtful)) continue;
      std::string hint = did_you_mean(entry.key, known_paths(scene, false), "nodes exist by being named in an element");
      if (found.any()) hint = "`" + entry.key + "` is an element: initial values are those of its nodes";
      diagnostics.error(entry.spot, "no element names a node `" + entry.key + "`", hint);
      continue;
    }
    const Domain domain = domain_of(scene, scene.nodes[static_cast<std::size_t>(found.node)]);
    const std::string hint = entry.key + " = { position = \"1 " + unit_of(Quantity::position, domain) + "\" }";
    if (!expect_table(entry.value, "node `" + entry.key + "`", diagnostics, hint)) continue;
    TableReader reader(entry.value, "a node");
    const auto value = [&](const char* key, Quantity quantity, double& target) {
      const TomlEntry* given = reader.find(key);
      if (!given) return;
      const Formula formula(given->value, '`' + std::string(key) + '`', diagnostics);
      if (!formula.given()) return;
      if (const auto si = formula.evaluate_finite(environment, quantity, domain, diagnostics)) target = *si;
    };
    SceneNode& node = scene.nodes[static_cast<std::size_t>(found.node)];
    node.spot = entry.spot;
    value("position", Quantity::position, node.position);
    value("velocity", Quantity::velocity, node.velocity);
    reader.finish(diagnostics);
  }
}

}  // namespace rheonet
