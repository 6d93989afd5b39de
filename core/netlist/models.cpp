#include "core/netlist/models.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <unordered_map>

#include "core/netlist/dependency_order.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

namespace {

constexpr std::array<std::string_view, 7> instance_keys{"type",   "name",   "at",      "between",
                                                        "repeat", "series", "parallel"};

void read_ports(const TomlEntry& entry, Model& model, DiagnosticList& diagnostics) {
  const std::string hint = "ports = [\"a\", \"b\"]";
  if (!expect_array(entry.value, "`ports`", diagnostics, hint)) return;
  if (entry.value.items.empty()) diagnostics.error(entry.value.spot, "`ports` must name at least one node", hint);
  for (const TomlValue& item : entry.value.items) {
    if (!expect_string(item, "the name of a port", diagnostics, hint)) continue;
    if (!expect_name(item.text, item.spot, "a port", diagnostics)) continue;
    if (item.text == "ground") {
      diagnostics.error(item.spot, "a port cannot be called `ground`", "`ground` is known inside every model anyway");
    } else if (model.scope.node_index.contains(item.text)) {
      diagnostics.error(item.spot, "port `" + item.text + "` is named twice");
    } else {
      model.ports.push_back(item.text);
      model.scope.node(item.text, item.spot);
    }
  }
}

void add_parameter(NamedFormula parameter, Model& model, DiagnosticList& diagnostics) {
  const bool twice = std::any_of(model.parameters.begin(), model.parameters.end(),
                                 [&](const NamedFormula& p) { return p.name == parameter.name; });
  if (twice)
    diagnostics.error(parameter.spot, "parameter `" + parameter.name + "` is named twice");
  else
    model.parameters.push_back(std::move(parameter));
}

void read_parameters(const TomlEntry& entry, Model& model, DiagnosticList& diagnostics) {
  if (entry.value.is_array()) {
    for (const TomlValue& item : entry.value.items) {
      if (item.is_table()) {
        for (NamedFormula& parameter : read_named_formulas(item, diagnostics)) add_parameter(std::move(parameter), model, diagnostics);
      } else if (expect_string(item, "the name of a parameter", diagnostics, "[\"k\", \"B\", { n = 1 }]: names, and tables of defaults") &&
                 expect_identifier(item.text, item.spot, "a parameter", diagnostics)) {
        add_parameter({item.text, item.spot, Formula()}, model, diagnostics);
      }
    }
  } else if (expect_table(entry.value, "`parameters`", diagnostics,
                          "parameters with defaults, { k = \"100 N/m\" }, or names without, [\"k\"]")) {
    model.parameters = read_named_formulas(entry.value, diagnostics);
  }
  for (const NamedFormula& parameter : model.parameters)
    if (std::find(instance_keys.begin(), instance_keys.end(), parameter.name) != instance_keys.end())
      diagnostics.error(parameter.spot, "a parameter cannot be called `" + parameter.name + "`",
                     "an element has a key of that name already");
  model.order = evaluation_order(model.parameters, diagnostics);
}

void read_domain_of(const TomlEntry& entry, Model& model, DiagnosticList& diagnostics) {
  if (!expect_string(entry.value, "`domain`", diagnostics, "domain = \"both\"")) return;
  model.both_domains = entry.value.text == "both";
  if (!model.both_domains)
    diagnostics.error(entry.value.spot, "the `domain` of a model or a law can only be `both`, but is `" + entry.value.text + "`",
                      "its elements, or its instances, may belong to one domain");
  else if (model.ports.size() != 2)
    diagnostics.error(entry.value.spot, "only a model with two ports can be for both domains");
}

void evaluate_defaults(Model& model, DiagnosticList& diagnostics) {
  Environment environment{.names = {}, .outer = model.environment};
  for (const NamedFormula& parameter : model.parameters) environment.names[parameter.name] = mistaken_number();
  model.defaults.assign(model.parameters.size(), mistaken_number());
  for (const std::size_t i : model.order) {
    const NamedFormula& parameter = model.parameters[i];
    if (!parameter.formula.given()) continue;
    if (const auto number = parameter.formula.evaluate(environment, diagnostics))
      model.defaults[i] = environment.names[parameter.name] = *number;
  }
}

void refuse_unused_ports(const Model& model, DiagnosticList& diagnostics) {
  std::vector<bool> used(model.scope.nodes.size(), false);
  if (model.scope.entries.empty()) return;
  for (const ElementTemplate& entry : model.scope.entries) {
    if (!entry.sound) return;
    for (const int node : entry.nodes)
      if (node != Scope::ground) used[static_cast<std::size_t>(node)] = true;
  }
  for (std::size_t i = 0; i < model.ports.size(); ++i)
    if (!used[i])
      diagnostics.error(model.scope.nodes[i].spot,
                     "no element of model `" + model.name + "` is at its port `" + model.ports[i] + "`",
                     "elements name ports as they name nodes");
}

/// Whether `name` is the type of an element.
bool is_taken(const std::string& name, const Context& context) {
  return std::any_of(context.declarations.begin(), context.declarations.end(),
                     [&](const Declaration* d) { return d->type == name || d->rotational_type == name; });
}

std::string place(Spot spot, const Context& context) {
  return context.files.shown(spot.file) + ":" + std::to_string(spot.line);
}

/// Lower bound on the number of elements of a plan; the bounds of its models must be known.
double least_elements(const ElementTemplate& plan) {
  if (plan.kind == ElementTemplate::Kind::element) return 1;
  double sum = plan.model ? plan.model->least_elements : 0;
  for (const ElementTemplate& member : plan.members) sum += least_elements(member);
  return sum;
}

/// Visits the instances of models in a plan, at any depth.
void collect_models(const ElementTemplate& plan, const std::function<void(const ElementTemplate&)>& visit) {
  if (plan.model) visit(plan);
  for (const ElementTemplate& member : plan.members) collect_models(member, visit);
}

}  // namespace

void declare_models(const TomlValue& table, const Environment& environment, Context& context, Models& models) {
  DiagnosticList& diagnostics = context.diagnostics;
  if (!expect_table(table, "`models`", diagnostics)) return;
  for (const TomlEntry& entry : table.entries) {
    if (!expect_name(entry.key, entry.spot, "a model", diagnostics)) continue;
    if (!expect_table(entry.value, "model `" + entry.key + "`", diagnostics)) continue;
    if (is_taken(entry.key, context)) {
      diagnostics.error(entry.spot, "`" + entry.key + "` is an element type already", "a model needs a name of its own");
      continue;
    }
    if (const auto known = models.find(entry.key); known != models.end()) {
      diagnostics.error(entry.spot,
                     "model `" + entry.key + "` is defined already, at " + place(known->second->spot, context),
                     "rename one of them");
      continue;
    }
    auto model = std::make_unique<Model>();
    const std::size_t before = diagnostics.errors();
    model->name = entry.key;
    model->spot = entry.spot;
    model->source = &entry.value;
    model->environment = &environment;
    TableReader reader(entry.value, "a model");
    if (const TomlEntry* ports = reader.require("ports", entry.spot, "ports = [\"a\", \"b\"]"))
      read_ports(*ports, *model, diagnostics);
    if (const TomlEntry* parameters = reader.find("parameters")) read_parameters(*parameters, *model, diagnostics);
    if (const TomlEntry* check = reader.find("check")) model->check = &check->value;
    if (const TomlEntry* domain = reader.find("domain")) read_domain_of(*domain, *model, diagnostics);
    const TomlEntry* elements =
        reader.require("elements", entry.spot, "[models." + entry.key + ".elements] with a line for each");
    if (elements && elements->value.is_table() && elements->value.entries.empty())
      diagnostics.error(elements->spot, "model `" + entry.key + "` has no elements");
    reader.finish(diagnostics);
    model->sound = diagnostics.errors() == before;
    models.emplace(entry.key, std::move(model));
  }
}

void plan_models(Context& context, Models& models) {
  DiagnosticList& diagnostics = context.diagnostics;
  TemplateReader planner(context, models);
  std::vector<Model*> all;
  std::unordered_map<const Model*, std::size_t> index;
  for (auto& [name, model] : models) {
    index[model.get()] = all.size();
    all.push_back(model.get());
    const std::size_t before = diagnostics.errors();
    if (const TomlEntry* elements = model->source->find("elements"))
      planner.read_elements(elements->value, model->scope, true);
    refuse_unused_ports(*model, diagnostics);
    evaluate_defaults(*model, diagnostics);
    model->sound = model->sound && diagnostics.errors() == before;
  }

  std::vector<std::vector<std::size_t>> uses(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const ElementTemplate& entry : all[i]->scope.entries)
      collect_models(entry, [&](const ElementTemplate& plan) { uses[i].push_back(index[plan.model]); });
  const DependencyOrder dependencies = dependency_order(uses);
  for (const auto& cycle : dependencies.cycles) {
    std::string path;
    for (const std::size_t i : cycle) path += "`" + all[i]->name + "` -> ";
    diagnostics.error(all[cycle.front()]->spot,
                   "models contain each other in a circle: " + path + "`" + all[cycle.front()]->name + "`");
  }
  // A model with an instance of an unsound model is unsound too.
  std::vector<bool> finite(all.size(), false);
  for (const std::size_t i : dependencies.order) {
    finite[i] = true;
    for (const ElementTemplate& entry : all[i]->scope.entries) all[i]->least_elements += least_elements(entry);
    for (const std::size_t used : uses[i]) all[i]->sound = all[i]->sound && all[used]->sound;
  }
  for (std::size_t i = 0; i < all.size(); ++i) all[i]->sound = all[i]->sound && finite[i];
}

}  // namespace rheonet
