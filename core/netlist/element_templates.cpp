#include "core/netlist/element_templates.hpp"

#include <algorithm>

#include "core/netlist/group_names.hpp"
#include "core/netlist/signal_connections.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

namespace {

std::string article(const std::string& type) {
  return (std::string_view("aeiou").find(type.front()) == std::string_view::npos ? "a `" : "an `") + type + "`";
}

const Parameter* find_parameter(const Declaration& declaration, const std::string& name) {
  for (const Parameter& p : declaration.parameters)
    if (p.name == name) return &p;
  return nullptr;
}

const char* const law_input_example = " = { block = \"current\" }, a quantity of the network (\"motor.force\"), or a signal";
const char* const function_example = "an expression over the inputs and the time: \"u1*u2\"";

/// Describes a valid value of a missing parameter.
std::string wanted(const Parameter& parameter, const ElementTemplate& of, Domain domain) {
  if (of.quantity_of(parameter) != parameter.quantity) return "a number without a unit, which multiplies `" + parameter.coefficient_with + "`";
  const std::string unit = unit_of(parameter.quantity, domain);
  if (parameter.kind == Parameter::Kind::signal)
    return "a signal: a number or a table such as { step = \"1 " + unit + "\" }";
  if (parameter.kind == Parameter::Kind::expression) return function_example;
  if (parameter.kind == Parameter::Kind::table) return LookupTemplate::example;
  if (parameter.kind == Parameter::Kind::coefficients) return CoefficientsTemplate::example;
  const std::string value = parameter.quantity == Quantity::number ? "a number" : "a " + name_of(parameter.quantity, domain) + ", in " + unit;
  return parameter.description.empty() ? value : value + ": " + parameter.description;
}

/// Lists the parameters of a type that may vary in time; if there are none, the types that have such parameters.
std::string what_may_vary(const Declaration& of, Declarations declarations) {
  const auto signals = [](const Declaration& declaration) {
    std::vector<std::string> names;
    for (const Parameter& p : declaration.parameters) {
      if (p.takes_signal()) names.push_back(p.name);
    }
    return names;
  };
  if (const std::vector<std::string> own = signals(of); !own.empty()) return "what may vary in time is " + list_names(own, "and") + " of " + article(of.type);
  std::vector<std::string> types;
  for (const Declaration* declaration : declarations) {
    if (!signals(*declaration).empty()) types.push_back(declaration->type);
  }
  return "no parameter of " + article(of.type) + " may vary in time; types with such parameters are " + list_names(types, "and");
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The entry `type`, `series` or `parallel` of an element or group; nullptr, with a mistake, unless it has exactly one.
const TomlEntry* find_kind(const TomlValue& source, Spot spot, const std::string& called, DiagnosticList& diagnostics) {
  const TomlEntry* kind = nullptr;
  for (const char* key : {"type", "series", "parallel"}) {
    const TomlEntry* entry = source.find(key);
    if (entry && kind) {
      refuse_both(*kind, *entry, called, diagnostics,
                  "a group in a group is a member of its own: series = [ { parallel = [ ... ] }, ... ]");
      return nullptr;
    }
    if (entry) kind = entry;
  }
  if (!kind) {
    std::string hint = "expected `type`, `series` or `parallel`";
    Spot where = spot;
    for (const TomlEntry& entry : source.entries)
      if (const auto meant = nearest(entry.key, {"type", "series", "parallel"}); !meant.empty()) {
        hint = "is `" + entry.key + "` meant to be `" + meant + "`?";
        where = entry.spot;
      }
    diagnostics.error(where, called + " has no `type`", hint);
  }
  return kind;
}

/// The parameter that has this name elsewhere, or else this symbol in its law; "" if none.
std::string parameter_called(const Declaration& declaration, std::string_view name, Domain domain) {
  for (const Parameter& p : declaration.parameters) {
    if (std::find(p.other_names.begin(), p.other_names.end(), name) != p.other_names.end()) return p.name_in(domain);
  }
  for (const Parameter& p : declaration.parameters) {
    if (p.symbol == name) return p.name_in(domain);
  }
  return "";
}

/// Reports a parameter given by its name in the other domain: "unknown key" would help less. True if there is one.
bool refuse_other_names(const Parameter& parameter, const std::string& name, bool in_model, Domain domain, TableReader& reader,
                        DiagnosticList& diagnostics) {
  const bool rotation = domain == Domain::rotation;
  bool misnamed = false;
  for (const std::string* const of_domain : {&parameter.name, &parameter.rotational_name}) {
    const std::string& other = *of_domain;
    const TomlEntry* entry = other.empty() || other == name ? nullptr : reader.find_quietly(other);
    if (!entry) continue;
    // In a model for translation, an override replaces the value that the model gives.
    const TomlEntry* given_now = reader.find_quietly(name);
    if (in_model && rotation && other == parameter.name && given_now && given_now->spot.on_command_line()) continue;
    misnamed = true;
    diagnostics.error(
        entry->spot,
        "`" + other + "` is called `" + name + "` in a " + (rotation ? "rotational" : "translational") + " scene",
        "write `" + name + "`" + (rotation ? "" : ", or set domain = \"rotation\""));
  }
  return misnamed;
}

}  // namespace

/// The name by which a parameter is given, or may be. Where the domain of an element is not known yet, and in models, which have
/// none, either name does.
const std::string& TemplateReader::name_given(const Parameter& parameter, const ElementTemplate& plan, Domain domain, TableReader& reader) const {
  const std::string& usual = parameter.name_in(domain);
  if (parameter.rotational_name.empty()) return usual;
  const std::string& other = domain == Domain::rotation ? parameter.name : parameter.rotational_name;
  const bool open = (plan.in_model && domain == Domain::rotation) || (context_.several_domains && !plan.domain);
  return open && reader.find_quietly(other) && !reader.find_quietly(usual) ? other : usual;
}

bool ElementTemplate::varies(std::size_t parameter) const {
  const int p = static_cast<int>(parameter);
  return std::find(signal_parameters.begin(), signal_parameters.end(), p) != signal_parameters.end() ||
         std::any_of(feeds.begin(), feeds.end(), [&](const SignalConnection& feed) { return feed.parameter == p; });
}

int Scope::node(const std::string& name, Spot spot) {
  if (name == "ground") return ground;
  const auto [found, is_new] = node_index.emplace(name, static_cast<int>(nodes.size()));
  if (is_new) nodes.push_back({name, spot});
  return found->second;
}

const ElementTemplate* Scope::find(const std::string& name) const {
  const auto found = entry_index.find(name);
  return found == entry_index.end() ? nullptr : &entries[found->second];
}

/// Reads a signal, a function of the motion, or a value.
void TemplateReader::read_value(ElementTemplate& plan, std::size_t i, const TomlValue& value, const std::string& name, TableReader& reader) {
  const Declaration& declaration = *context_.declarations[static_cast<std::size_t>(plan.declaration)];
  const Parameter& parameter = declaration.parameters[i];
  DiagnosticList& diagnostics = context_.diagnostics;
  if (parameter.may_be_curve && CharacteristicTemplate::may_be(value, parameter)) {
    plan.characteristics.try_emplace(i, value, reader.find("smooth"), reader.find("columns"), parameter, plan.quantity_of(parameter), context_);
    if (!value.is_string() || value.text.ends_with(".csv")) return;  // else `w` may be a parameter
  }
  if (parameter.kind == Parameter::Kind::signal || (parameter.may_vary && value.is_table())) {
    if (const TomlEntry* feed = find_feed(value)) {
      if (auto connection = read_feed(*feed, value, declaration, i, context_)) plan.feeds.push_back(std::move(*connection));
      return;
    }
    const bool any_unit = parameter.unit != Parameter::Unit::quantity;
    plan.signals.emplace_back(value, name, any_unit ? std::nullopt : std::optional(plan.quantity_of(parameter)), context_);
    plan.signal_parameters.push_back(static_cast<int>(i));
  } else if (value.is_table()) {
    diagnostics.error(value.spot, "`" + name + "` is constant in time, but is " + describe(value), what_may_vary(declaration, context_.declarations));
  } else {
    const bool coefficient = plan.quantity_of(parameter) != parameter.quantity;
    plan.values[i] = Formula(value, "`" + name + "`" + (coefficient ? " (which multiplies `" + parameter.coefficient_with + "`)" : ""), diagnostics);
  }
}

void TemplateReader::read_elements(const TomlValue& table, Scope& scope, bool in_model) {
  if (!expect_table(table, "`elements`", context_.diagnostics)) return;
  for (const TomlEntry& entry : table.entries) {
    if (!expect_name(entry.key, entry.spot, "an element", context_.diagnostics)) continue;
    if (entry.key == "ground") {
      context_.diagnostics.error(entry.spot, "an element cannot be called `ground`: that is the node that never moves");
      continue;
    }
    scope.entry_index.emplace(entry.key, scope.entries.size());
    scope.entries.push_back(read_entry(entry.key, entry.spot, entry.value, &scope, in_model));
  }
  check_names(scope, context_.diagnostics);
}

ElementTemplate TemplateReader::read_entry(std::string name, Spot spot, const TomlValue& source, Scope* scope, bool in_model) {
  ElementTemplate plan;
  plan.in_model = in_model;
  plan.name = std::move(name);
  plan.spot = spot;
  plan.source = &source;
  DiagnosticList& diagnostics = context_.diagnostics;
  const std::size_t before = diagnostics.errors();
  const std::string called = scope ? "element `" + plan.name + "`" : "a member of a group";
  if (!expect_table(source, called, diagnostics, "an element is a table: { type = \"spring\", ... }")) return plan;

  const TomlEntry* kind = find_kind(source, spot, called, diagnostics);
  if (!kind) return plan;

  const auto read_name = [&](TableReader& reader) {
    const TomlEntry* entry = scope ? nullptr : reader.find("name");
    if (!entry) return;
    if (!expect_string(entry->value, "`name`", diagnostics)) return;
    if (!expect_name(entry->value.text, entry->value.spot, "an element", diagnostics)) return;
    plan.name = entry->value.text;
    plan.spot = entry->value.spot;
  };
  if (kind->key != "type") {
    plan.kind = kind->key == "series" ? ElementTemplate::Kind::series : ElementTemplate::Kind::parallel;
    TableReader reader(source, article(kind->key) + " group");
    read_name(reader);
    read_place(plan, scope, 2, false, true, reader);
    read_domain(plan, reader);
    read_repeat(plan, reader);
    read_group(plan, *kind, reader);
    reader.finish(diagnostics);
    // An unnamed group within another adds no level: its members are numbered with the members around it.
    if (scope || !plan.name.empty() || plan.repeat) name_members(plan, diagnostics);
  } else if (expect_string(kind->value, "`type`", diagnostics)) {
    const std::string& type = kind->value.text;
    const auto model = models_.find(type);
    const Declaration* declaration = find_type(type);
    if (declaration || model != models_.end()) {
      TableReader reader(source, article(type));
      reader.find("type");
      read_name(reader);
      if (declaration)
        read_element(plan, *kind, *declaration, scope, reader);
      else
        read_instance(plan, *model->second, scope, reader);
      read_repeat(plan, reader);
      reader.finish(diagnostics, [&](std::string_view key) { return declaration ? parameter_called(*declaration, key, plan.domain.value_or(context_.domain)) : ""; });
    } else if (context_.models_missing) {
      return plan;  // the type may be a model of that file
    } else {
      refuse_type(*kind, source);
    }
  }
  plan.sound = diagnostics.errors() == before;
  return plan;
}

const Declaration* TemplateReader::find_type(const std::string& type) const {
  for (const Declaration* d : context_.declarations)
    if (d->type == type || (!d->rotational_type.empty() && d->rotational_type == type)) return d;
  return nullptr;
}

void TemplateReader::refuse_type(const TomlEntry& type, const TomlValue& entry) {
  const bool at = entry.find("at"), between = entry.find("between");
  // No block is meant where nodes are named; a name may be misspelt by who also errs in the nodes.
  std::vector<std::string> names, fitting;
  for (const Declaration* d : context_.declarations) {
    if (d->ports == Declaration::Ports::block && (at || between)) continue;
    const bool fits = d->ports == Declaration::Ports::at_or_between || d->ports == Declaration::Ports::block || (d->ports == Declaration::Ports::at ? !between : !at);
    for (const std::string& name : {d->type, d->rotational_type}) {
      if (name.empty()) continue;
      names.push_back(name);
      if (fits) fitting.push_back(name);
    }
  }
  for (const auto& [name, model] : models_) {
    names.push_back(name);
    fitting.push_back(name);
  }
  std::string hint = called_here(type.value.text, context_.declarations);
  std::string model = type.value.text;
  std::replace(model.begin(), model.end(), '_', '-');
  if (const std::string file = hint.empty() ? context_.files.file_with_model(model) : ""; !file.empty())
    hint = "`" + model + "` is in the library: include = [\"" + file + "\"]";
  if (hint.empty()) hint = did_you_mean(type.value.text, names, "the types " + std::string(at ? "that stand at a node " : between ? "that stand between nodes " : "") + "are " + list_names(fitting, "and"));
  context_.diagnostics.error(type.value.spot, "unknown element type `" + type.value.text + "`", std::move(hint));
}

void TemplateReader::read_element(ElementTemplate& plan, const TomlEntry& type, const Declaration& declaration, Scope* scope,
                           TableReader& reader) {
  DiagnosticList& diagnostics = context_.diagnostics;
  const auto found = std::find(context_.declarations.begin(), context_.declarations.end(), &declaration);
  plan.declaration = static_cast<int>(found - context_.declarations.begin());
  const bool block = declaration.ports == Declaration::Ports::block;
  const bool may_be_at = declaration.ports != Declaration::Ports::between;
  const bool may_be_between = declaration.ports != Declaration::Ports::at;
  if (!scope && block)
    diagnostics.error(type.value.spot, article(type.value.text) + " is a block, which stands at no node: it cannot be a member of `series` or `parallel`",
                   "give it an entry of its own in [elements]");
  else if (!scope && !may_be_between)
    diagnostics.error(type.value.spot,
                   article(type.value.text) + " stands at a node: it cannot be a member of `series` or `parallel`",
                   "give it an entry of its own in [elements], with `at`");
  else if (!scope && !declaration.three.empty())
    diagnostics.error(type.value.spot, article(type.value.text) + " joins three nodes: it cannot be a member of `series` or `parallel`",
                   "give it an entry of its own in [elements]");
  if (block) {
    plan.at = true;
    plan.inputs = read_inputs(declaration, plan.name, plan.spot, reader, diagnostics);
  } else {
    read_place(plan, scope, !declaration.three.empty() ? 3 : may_be_at && !may_be_between ? 1 : 2, may_be_at, may_be_between, reader);
    if (declaration.supported) read_support(plan, scope, reader);
    if (declaration.domains.empty()) {
      read_domain(plan, reader);
    } else if (const TomlEntry* domain = reader.find_quietly("domain")) {
      diagnostics.error(domain->spot, article(declaration.type) + " joins two domains: it has none of its own", "leave it out");
    }
    if (!plan.domain && type.value.text == declaration.rotational_type && !type.value.text.empty()) plan.domain = Domain::rotation;
  }
  const Domain domain = plan.domain.value_or(context_.domain);
  // A source of motion at `ground` is refused elsewhere, as a conflict.
  if (plan.at && plan.nodes == std::vector<int>{Scope::ground} && !declaration.prescribes_motion())
    diagnostics.warning(plan.spot, "`" + plan.name + "` is at `ground`, which never moves: it has no effect there",
                     "name another node, or leave it out");

  std::vector<const TomlEntry*> given;  // of declaration.one_of
  plan.values.resize(declaration.parameters.size());
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i) {
    const Parameter& parameter = declaration.parameters[i];
    if (!parameter.second_of.empty()) continue;  // read with the first
    const std::string& name = name_given(parameter, plan, domain, reader);
    const bool misnamed = refuse_other_names(parameter, name, plan.in_model, domain, reader, diagnostics);
    const bool may_be_absent = parameter.kind == Parameter::Kind::initial || parameter.optional || parameter.fallback ||
                               !parameter.same_as.empty() || among(declaration.one_of, parameter.name) || misnamed;
    const TomlEntry* entry = may_be_absent ? reader.find(name)
                                           : reader.require(name, plan.spot, [&] { return wanted(parameter, plan, domain); });
    if (!entry) {
      if (parameter.kind == Parameter::Kind::signal && parameter.fallback) plan.default_signals.push_back(i);
      continue;
    }
    if (among(declaration.one_of, parameter.name)) given.push_back(entry);
    if (parameter.kind == Parameter::Kind::characteristic) {
      plan.characteristics.try_emplace(i, entry->value, reader.find("smooth"), nullptr, parameter, parameter.quantity, context_);
      continue;
    }
    if (parameter.kind == Parameter::Kind::expression) {
      if (expect_string(entry->value, "`" + name + "`", diagnostics, function_example)) plan.function = &entry->value;
      continue;
    }
    if (parameter.kind == Parameter::Kind::table) {
      plan.lookup.emplace(entry->value, reader.find("smooth"), reader.find("columns"), context_);
      continue;
    }
    if (parameter.kind == Parameter::Kind::coefficients) {
      plan.coefficients.emplace_back(entry->value, i, name, diagnostics);
      continue;
    }
    const bool may_be_two = i + 1 < declaration.parameters.size() && declaration.parameters[i + 1].second_of == parameter.name;
    if (!may_be_two || !CharacteristicTemplate::are_several(entry->value)) {
      read_value(plan, i, entry->value, name, reader);
    } else if (entry->value.items.size() != 2) {
      diagnostics.error(entry->value.spot, "`" + name + "` takes one value or two, but has " + std::to_string(entry->value.items.size()),
                        name + " = [" + parameter.symbol + ", " + declaration.parameters[i + 1].symbol + "]");
    } else {
      for (std::size_t k = 0; k < 2; ++k) read_value(plan, i + k, entry->value.items[k], name, reader);
    }
  }
  if (given.size() > 1) refuse_both(*given[0], *given[1], article(type.value.text), diagnostics);
  for (const Parameter& parameter : declaration.parameters) {
    const TomlEntry* one = parameter.not_with.empty() ? nullptr : plan.source->find(parameter.name);
    const TomlEntry* other = one ? plan.source->find(parameter.not_with) : nullptr;
    if (other) refuse_both(*other, *one, article(type.value.text), diagnostics);
  }
  const auto misnamed = [&](const TomlEntry& entry) {
    const std::string called = parameter_called(declaration, entry.key, domain);
    return std::any_of(declaration.one_of.begin(), declaration.one_of.end(), [&](const std::string& name) { return find_parameter(declaration, name)->name_in(domain) == called; });
  };
  if (!declaration.one_of.empty() && given.empty() && std::none_of(plan.source->entries.begin(), plan.source->entries.end(), misnamed)) {
    std::vector<std::string> names;
    for (const std::string& name : declaration.one_of)
      if (const Parameter* p = find_parameter(declaration, name)) names.push_back(p->name_in(domain));
    diagnostics.error(plan.spot, article(type.value.text) + " needs " + list_names(names));
  }
}

void TemplateReader::read_instance(ElementTemplate& plan, Model& model, Scope* scope, TableReader& reader) {
  plan.kind = ElementTemplate::Kind::instance;
  plan.model = &model;
  const std::size_t ports = model.ports.size();
  if (!scope && ports != 2 && ports != 0)
    context_.diagnostics.error(plan.spot, "model `" + model.name + "` has " + std::to_string(ports) +
                                           (ports == 1 ? " port" : " ports") +
                                           ": a member of `series` or `parallel` needs two");
  read_place(plan, scope, ports, ports == 1, ports != 1, reader);
  const bool of_its_own = std::any_of(model.parameters.begin(), model.parameters.end(), [](const NamedFormula& p) { return p.name == "domain"; });
  if (!of_its_own) read_domain(plan, reader);
  for (const NamedFormula& parameter : model.parameters) {
    const TomlEntry* entry = parameter.formula.given()
                                 ? reader.find(parameter.name)
                                 : reader.require(parameter.name, plan.spot, model.law ? "the law gives it no default" : "the model gives it no default");
    plan.values.push_back(entry ? Formula(entry->value, "`" + parameter.name + "`", context_.diagnostics) : Formula());
  }
  for (const std::string& input : model.inputs)
    if (const TomlEntry* entry = reader.require(input, plan.spot, input + law_input_example)) read_law_input(plan, *entry);
}

/// Reads the value of an input of a law at one of its instances: a wire, or a signal, for which it gets a generator.
void TemplateReader::read_law_input(ElementTemplate& plan, const TomlEntry& entry) {
  const bool path = is_path_of_quantity(entry.value);
  if (path || find_feed(entry.value)) {
    auto wire = path ? read_wire(entry.value, "`" + entry.key + "`", context_.diagnostics) : read_block(entry.value, context_);
    if (!wire) return;
    wire->name = entry.key;
    plan.inputs.push_back(std::move(*wire));
    return;
  }
  const auto generates = [](const Declaration* d) { return d->ports == Declaration::Ports::block && d->inputs.most == 0 && d->parameters.front().kind == Parameter::Kind::signal; };
  const auto found = std::find_if(context_.declarations.begin(), context_.declarations.end(), generates);
  const std::size_t before = context_.diagnostics.errors();
  ElementTemplate generator;
  generator.name = entry.key;
  generator.spot = entry.spot;
  generator.source = &entry.value;
  generator.in_model = plan.in_model;
  generator.at = true;
  generator.declaration = static_cast<int>(found - context_.declarations.begin());
  generator.values.resize((*found)->parameters.size());
  generator.signals.emplace_back(entry.value, entry.key, std::nullopt, context_);
  generator.signal_parameters.push_back(0);
  generator.sound = context_.diagnostics.errors() == before;
  plan.members.push_back(std::move(generator));
}

void TemplateReader::read_group(ElementTemplate& plan, const TomlEntry& group, TableReader& reader) {
  reader.find(group.key);
  if (!expect_array(group.value, "`" + group.key + "`", context_.diagnostics,
                    "a group lists its members: " + group.key + " = [ { type = \"spring\", ... }, ... ]"))
    return;
  if (group.value.items.empty()) context_.diagnostics.error(group.value.spot, "`" + group.key + "` has no members");
  plan.members.reserve(group.value.items.size());
  for (const TomlValue& item : group.value.items) plan.members.push_back(read_entry("", item.spot, item, nullptr, plan.in_model));
}

}  // namespace rheonet
