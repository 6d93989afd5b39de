#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/netlist/checks.hpp"
#include "core/netlist/counting.hpp"
#include "core/netlist/expand.hpp"
#include "core/netlist/group_names.hpp"

namespace rheonet {

namespace {

bool has_member(const ElementTemplate& group, const std::string& name) {
  return std::any_of(group.members.begin(), group.members.end(), [&](const ElementTemplate& member) {
    return has_level(member) ? member.name == name : has_member(member, name);
  });
}

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether an override applies to something within the plan, not to one of its own keys.
bool goes_deeper(const ElementTemplate& plan, const ActiveOverride& active, bool is_member) {
  if (active.at_end()) return false;
  const std::string& name = active.next().name;
  if (plan.repeat && !is_member) return is_number(name);
  if (plan.kind == ElementTemplate::Kind::element) return false;
  if (plan.kind != ElementTemplate::Kind::instance) return has_member(plan, name);
  const auto named = [&](const auto& thing) { return thing.name == name; };
  // A parameter and an element of a model may share a name: a path that ends there means the parameter.
  const auto& parameters = plan.model->parameters;
  if (active.deeper().at_end() && std::any_of(parameters.begin(), parameters.end(), named)) return false;
  return plan.model->scope.find(name) != nullptr;
}

/// Whether an override changes the place of an entry, which a single member of a `repeat` cannot do.
bool names_place(const ActiveOverride& active) {
  return active.at_end() || active.next().name == "at" || active.next().name == "between" ||
         active.next().name == "repeat";
}

/// Collects the names that an override may use within a plan besides its keys.
void collect_names(const ElementTemplate& plan, std::vector<std::string>& names) {
  for (const ElementTemplate& member : plan.members) {
    if (has_level(member))
      names.push_back(member.name);
    else
      collect_names(member, names);
  }
  if (!plan.model) return;
  for (const NamedFormula& parameter : plan.model->parameters) names.push_back(parameter.name);
  for (const ElementTemplate& entry : plan.model->scope.entries) names.push_back(entry.name);
}

/// Whether an override names neither a key of the plan nor anything within it; reports a mistake if so.
bool is_lost(const ElementTemplate& plan, const ActiveOverride& active, bool is_member, DiagnosticList& diagnostics) {
  if (plan.kind == ElementTemplate::Kind::element || active.at_end()) return false;
  const std::string& name = active.next().name;
  std::vector<std::string> names{"at", "between", "repeat"};
  collect_names(plan, names);
  if (plan.source->find(name) || std::find(names.begin(), names.end(), name) != names.end()) return false;
  diagnostics.error(
      active.next().spot, "nothing in `" + path_to(active) + "` is called `" + name + "`",
      did_you_mean(name, names, plan.repeat && !is_member ? "its members are called by their numbers, from 0" : ""));
  return true;
}

/// A quantity of translation as its counterpart in rotation: N as N*m, m as rad, kg as kg*m^2. Any other quantity stays as it is.
Number turned(Number number) {
  Dimension& dimension = number.dimension;
  if (dimension.metre == 2 * dimension.kilogram) return number;
  number.radian += dimension.metre - dimension.kilogram;
  dimension.metre = 2 * dimension.kilogram;
  return number;
}

}  // namespace

const ElementTemplate& Expander::overridden(const ElementTemplate& plan, Scope* scope, const ActiveOverrides& overrides, bool is_member,
                                 ActiveOverrides& deeper) {
  ActiveOverrides own;
  for (const ActiveOverride& active : overrides) {
    if (goes_deeper(plan, active, is_member))
      deeper.push_back(active);
    else if (is_member && names_place(active))
      context_.diagnostics.error(active.override->path.back().spot,
                              "a member of a `repeat` stands where the whole puts it",
                              "only its values can be set, or those of the whole: `" + plan.name + "`");
    else if (!is_lost(plan, active, is_member, context_.diagnostics))
      own.push_back(active);
  }
  if (own.empty()) return plan;
  TomlValue& value = patched_values_.emplace_back(*plan.source);
  for (const ActiveOverride& active : own) apply(active, value, context_.diagnostics);
  return patched_plans_.emplace_back(planner_.read_entry(plan.name, plan.spot, value, scope, plan.in_model));
}

bool Expander::instance_parameters(const ElementTemplate& plan, const std::string& path, const Environment& around, Environment& inside) {
  const Model& model = *plan.model;
  const bool turns = model.both_domains && domain_at(path) == Domain::rotation;
  DiagnosticList& diagnostics = context_.diagnostics;
  bool good = true;
  for (const NamedFormula& parameter : model.parameters) inside.names[parameter.name] = mistaken_number();
  for (const std::size_t i : model.order) {
    const NamedFormula& parameter = model.parameters[i];
    const Formula& given = plan.values[i];
    auto number = given.given() ? given.evaluate(around, diagnostics) : parameter.formula.evaluate(inside, diagnostics);
    if (!number) {
      good = false;
      continue;
    }
    if (turns && !given.given()) number = turned(*number);
    const Number usual = turns ? turned(model.defaults[i]) : model.defaults[i];
    const bool known = !(without_values_ && model.both_domains);  // the domain, which decides about the dimension
    if (given.given() && known && !std::isnan(usual.value) && !fits(*number, usual)) {
      diagnostics.error(given.source().spot, given.name() + " of `" + model.name + "`: expected " +
                                              describe(usual) + ", as its default is, found " +
                                              describe(*number));
      good = false;
      continue;
    }
    Number& value = inside.names[parameter.name] = *number;
    if (number->plain && !usual.plain && !std::isnan(usual.value)) {  // a plain number has the unit of the default, in SI
      value = usual;
      value.value = number->value;
    }
  }
  return good;
}

/// Whether the conditions of a model hold for an instance; reports those that do not.
bool Expander::checked(const Model& model, const std::string& path, const Environment& environment) {
  if (!model.check) return true;
  const std::size_t before = context_.diagnostics.errors();
  const DiagnosticList::Within within(context_.diagnostics, path);
  evaluate_checks(*model.check, environment, context_.diagnostics);
  return context_.diagnostics.errors() == before;
}

bool Expander::instance(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around) {
  Model& model = *plan.model;
  if (!model.sound) return false;
  if (static_cast<double>(scene_.elements.size()) + model.least_elements > static_cast<double>(most_elements))
    return refuse_number(plan.spot);
  Environment environment{.names = {}, .outer = model.environment};
  if (!instance_parameters(plan, path, around.environment, environment) || !(without_values_ || checked(model, path, environment))) return false;

  const bool assembled = model.ports.size() == 2;
  const std::size_t assembly = assembled ? begin_assembly(plan, ends, path) : 0;
  Locals locals{model.scope, path, {ends.begin(), ends.end()}};
  Inside inside{path, {}};
  for (std::size_t i = 0; i < ends.size(); ++i)
    inside.ports[model.ports[i]] =
        ends[i] < 0 ? port_names_.at(ends[i]) : scene_.nodes[static_cast<std::size_t>(ends[i])].name;
  const NodeId port = next_port_;
  if (assembled) port_names_[port] = inside.ports.at(model.ports[0]);
  std::swap(inside_, inside);
  if (assembled) {
    // The first port may be a node that is also named inside (ground). It has an id of its own until the elements that end
    // at it are known.
    locals.ids[0] = port;
    --next_port_;
  }
  const std::size_t first_element = scene_.elements.size();
  const std::size_t first_assembly = scene_.assemblies.size();
  const DiagnosticList::Within within(context_.diagnostics, path);
  const bool good = entries(locals, path, environment, around.overrides, around.depth + 1);
  std::swap(inside_, inside);
  if (assembled) {
    ++next_port_;
    end_assembly(assembly, take_port_forces(port, ends[0], first_element, first_assembly), around);
  }
  return good;
}

Expander::Terms Expander::take_port_forces(NodeId port, NodeId actual, std::size_t first_element,
                                           std::size_t first_assembly) {
  Terms terms;
  for (std::size_t i = first_element; i < scene_.elements.size(); ++i) {
    SceneElement& element = scene_.elements[i];
    if (element.support == port) {
      element.support = actual;
      terms.push_back({static_cast<int>(i), 1, true});
    }
    // A source (motion or force) has the force that it applies; any other element has the force applied to it.
    const double applied = context_.declarations[static_cast<std::size_t>(element.declaration)]->is_source() ? -1 : 1;
    if (element.a == port) {
      element.a = actual;
      terms.push_back({static_cast<int>(i), applied});
    } else if (element.b == port) {
      element.b = actual;
      terms.push_back({static_cast<int>(i), -applied});
    }
  }
  for (std::size_t i = first_assembly; i < scene_.assemblies.size(); ++i) {
    SceneAssembly& assembly = scene_.assemblies[i];
    if (assembly.a == port) assembly.a = actual;
    if (assembly.b == port) assembly.b = actual;
  }
  return terms;
}

}  // namespace rheonet
