#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/read.hpp"

namespace rheonet {

namespace {

using Json = nlohmann::ordered_json;

Json reference(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }

Json described(Json schema, const std::string& description) {
  schema["description"] = description;
  return schema;
}

Json object(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

/// An object with arbitrary names, all with the same kind of value.
Json named(Json value) { return {{"type", "object"}, {"additionalProperties", std::move(value)}}; }

Json list_of(Json items, int least = 0) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", least}};
}

Json text(const std::string& description) { return {{"type", "string"}, {"description", description}}; }

Json value() {
  return described({{"type", {"number", "string"}}},
                   "a number in SI, a quantity (\"2 in*ozf\": a number, a space, a unit), or an expression (\"2*B\")");
}

std::vector<std::string> names_of(const Parameter& parameter) {
  std::vector<std::string> names{parameter.name};
  if (!parameter.rotational_name.empty()) names.push_back(parameter.rotational_name);
  return names;
}

std::vector<std::string> types_of(const Declaration& declaration) {
  std::vector<std::string> types{declaration.type};
  if (!declaration.rotational_type.empty()) types.push_back(declaration.rotational_type);
  return types;
}

std::string units_of(const Parameter& parameter) {
  if (parameter.kind == Parameter::Kind::expression) return "an expression over u1, u2, ... and t";
  if (parameter.kind == Parameter::Kind::table) return "points [input, output], or the name of a CSV file";
  if (parameter.kind == Parameter::Kind::coefficients) return "any unit, times s for each power of the Laplace variable";
  if (parameter.unit == Parameter::Unit::own) return "any unit";
  if (parameter.unit == Parameter::Unit::input) return "the unit of the input";
  if (parameter.unit == Parameter::Unit::output) return "the unit of the output";
  if (parameter.quantity == Quantity::number) return "no unit";
  const bool power_law = !parameter.flow_index.empty();
  const auto in = [&](Domain domain) {
    const std::string unit = unit_of(parameter.quantity, domain);
    if (!power_law) return unit;
    return std::string(domain == Domain::rotation ? "N*m*(s/rad)^" : "N*(s/m)^") + parameter.flow_index;
  };
  const std::string translation = in(Domain::translation), rotation = in(Domain::rotation);
  return translation == rotation ? translation : fmt::format("{}, in a rotational scene {}", translation, rotation);
}

/// `table`, whose points are pairs of two values.
Json table_schema(const std::string& description) {
  Json points = list_of(
      {{"type", "array"}, {"prefixItems", {reference("value"), reference("value")}}, {"items", false}, {"minItems", 2}},
      1);
  return {{"anyOf", {std::move(points), text("name of a CSV file")}}, {"description", description}};
}

/// `columns` and `smooth`, which go with a `table`.
void add_table_keys(Json& properties, const std::string& columns) {
  properties["columns"] = list_of(text("of the " + columns + ", as the first row of the CSV file of a `table` names them"), 2);
  properties["smooth"] = {{"type", "boolean"}, {"description", "a `table` runs along monotone cubics between its points"}};
}

Json parameter_schema(const Parameter& parameter) {
  std::string description = parameter.symbol;
  if (!description.empty() && !parameter.description.empty()) description += ": ";
  description += parameter.description;
  description += fmt::format(" [{}]", units_of(parameter));
  if (!parameter.same_as.empty())
    description += fmt::format("; if absent, {} `{}`", parameter.opposite ? "minus" : "as", parameter.same_as);
  if (parameter.fallback) description += fmt::format("; {} if absent", *parameter.fallback);
  if (parameter.may_be_infinite) description += "; may be \"inf\"";
  if (parameter.kind == Parameter::Kind::expression) return text(description);
  if (parameter.kind == Parameter::Kind::table) return table_schema(description);
  if (parameter.kind == Parameter::Kind::coefficients) return described(list_of(reference("value"), 1), description);
  const bool characteristic = parameter.kind == Parameter::Kind::characteristic;
  Json schema = described(reference(characteristic ? "characteristic" : parameter.takes_signal() ? "signal" : "value"), description);
  if (characteristic) return schema;
  if (parameter.may_be_curve) schema = described({{"anyOf", {reference("signal"), table_schema("points [speed, value], or an expression over w")}}}, description);
  if (parameter.fallback && std::isfinite(*parameter.fallback)) schema["default"] = *parameter.fallback;
  // The bounds apply to numbers only; the value of a text is known only when the netlist is read.
  if (parameter.kind == Parameter::Kind::signal) return schema;
  if (std::isfinite(parameter.lower)) schema[parameter.lower_open ? "exclusiveMinimum" : "minimum"] = parameter.lower;
  if (std::isfinite(parameter.upper)) schema["maximum"] = parameter.upper;
  return schema;
}

/// Objects that have exactly one of the keys.
Json one_required(const std::vector<std::string>& reader) {
  Json alternatives = Json::array();
  for (const std::string& key : reader) alternatives.push_back({{"required", {key}}});
  return {{"oneOf", std::move(alternatives)}};
}

/// Properties of any element or member of a group.
Json common_properties() {
  return {{"name", text("for a member of a group: the name by which it is addressed in it")},
          {"repeat", reference("repeat")}};
}

Json inputs_schema(const Declaration::Inputs& inputs) {
  const Json one = text("the name of a block, or a quantity of the network: drum.velocity; with - its negative");
  return inputs.most == 1 ? one : list_of(one, static_cast<int>(inputs.least));
}

Json domain_schema(const std::string& description) { return {{"enum", {"translation", "rotation"}}, {"description", description}}; }

Json ports_properties(Declaration::Ports ports) {
  Json properties = Json::object();
  if (ports == Declaration::Ports::block) return properties;
  properties["domain"] = domain_schema("of its nodes; without it, that of the elements around, or that of the scene");
  if (ports != Declaration::Ports::at) properties["between"] = reference("between");
  if (ports != Declaration::Ports::between) properties["at"] = reference("at");
  return properties;
}

Json element_schema(const Declaration& declaration) {
  Json properties{{"type", {{"enum", types_of(declaration)}}}};
  properties.update(ports_properties(declaration.ports));
  if (declaration.supported) properties["support"] = text("the node against which it turns; without it, ground");
  if (!declaration.three.empty()) {
    const std::vector<std::string>& three = declaration.three;
    properties["between"] = described(list_of(text("a node; `ground` never moves"), 3), "its nodes: " + three[0] + ", " + three[1] + " and " + three[2]);
  }
  if (declaration.inputs.most > 0 && declaration.ports == Declaration::Ports::block)
    properties["in"] = inputs_schema(declaration.inputs);
  properties.update(common_properties());
  Json requirements = Json::array();
  std::vector<std::string> one_of;
  for (const Parameter& parameter : declaration.parameters) {
    const auto names = names_of(parameter);
    if (!parameter.second_of.empty()) {
      properties[parameter.second_of] = {{"anyOf", {properties[parameter.second_of], list_of(reference("value"), 2)}}};
      continue;
    }
    for (const std::string& name : names) properties[name] = parameter_schema(parameter);
    if (parameter.kind == Parameter::Kind::characteristic)
      properties["smooth"] = {{"type", "boolean"}, {"description", fmt::format("a monotone cubic spline through the points of `{}`", parameter.name)}};
    if (parameter.may_be_curve) add_table_keys(properties, "speeds and of the values");
    if (parameter.kind == Parameter::Kind::table) add_table_keys(properties, "inputs and of the outputs");
    const bool alternative =
        std::find(declaration.one_of.begin(), declaration.one_of.end(), parameter.name) != declaration.one_of.end();
    if (alternative) one_of.insert(one_of.end(), names.begin(), names.end());
    const bool optional = alternative || parameter.kind == Parameter::Kind::initial || parameter.optional || parameter.fallback ||
                          !parameter.same_as.empty();
    if (!optional) requirements.push_back(one_required(names));
  }
  if (properties.contains("in") && declaration.inputs.alike) requirements.push_back(one_required({"in"}));
  if (!one_of.empty()) requirements.push_back(one_required(one_of));
  Json schema = object(std::move(properties));
  if (!requirements.empty()) schema["allOf"] = std::move(requirements);
  return described(std::move(schema), declaration.summary + ": " + declaration.law);
}

Json group_schema() {
  Json properties{{"between", reference("between")}, {"domain", domain_schema("of all its members")}};
  properties.update(common_properties());
  properties["series"] =
      described(list_of(reference("member"), 1), "members one after the other, from the first node on");
  properties["parallel"] = described(list_of(reference("member"), 1), "members side by side");
  Json schema = object(std::move(properties));
  schema.update(one_required({"series", "parallel"}));
  return described(std::move(schema), "a composed element: has force, displacement and velocity of its own");
}

Json if_then(Json condition, const std::string& definition) {
  return {{"if", std::move(condition)}, {"then", reference(definition)}};
}

/// An element or a member of a group, without its place. An undeclared type is a model, possibly of another file: its
/// parameters are unknown here.
Json body_schema(Declarations declarations) {
  Json types = Json::array();
  Json cases = Json::array();
  for (const Declaration* declaration : declarations) {
    for (const std::string& type : types_of(*declaration))
      types.push_back({{"const", type}, {"description", declaration->summary + ": " + declaration->law}});
    Json is_it{{"properties", {{"type", {{"enum", types_of(*declaration)}}}}}, {"required", {"type"}}};
    cases.push_back(if_then(std::move(is_it), declaration->type));
  }
  types.push_back(text("the name of a model or a law"));
  for (const char* kind : {"series", "parallel"}) cases.push_back(if_then({{"required", {kind}}}, "group"));
  Json properties{{"type", {{"anyOf", std::move(types)}}}, {"at", reference("at")}, {"between", reference("between")},
                  {"domain", domain_schema("of its nodes")}};
  properties.update(common_properties());
  Json schema{{"type", "object"}, {"properties", std::move(properties)}};
  schema.update(one_required({"type", "series", "parallel"}));
  schema["allOf"] = std::move(cases);
  return schema;
}

Json signal_schema() {
  Json properties{
      {"step", described(reference("value"), "height of a step at `time`")},
      {"ramp", described(reference("value"), "slope of a ramp that begins at `time` [unit of the quantity / s]")},
      {"sine", described(reference("value"), "amplitude of a sine")},
      {"cosine", described(reference("value"), "amplitude of a cosine")},
      {"square", described(reference("value"), "amplitude of a square wave; it starts on its high side")},
      {"triangle", described(reference("value"), "amplitude of a triangle wave; it starts at 0, rising")},
      {"chirp", described(reference("value"),
                          "amplitude of a sine whose frequency goes from `frequency` to "
                          "`end_frequency` within `duration`")},
      {"pulse",
       described(reference("value"), "height of a pulse of `width`, again at every period if there is a `frequency`")},
      {"noise", described(reference("value"), "random values, uniformly distributed between minus and plus this, each held for an `interval`")},
  };
  std::vector<std::string> shapes;
  for (const auto& [shape, schema] : properties.items()) shapes.push_back(shape);
  shapes.emplace_back("table");
  properties["table"] = table_schema("[time, value] points: linear between them, held after the last");
  add_table_keys(properties, "times and of the values");
  const std::pair<const char*, const char*> reader[] = {
      {"amplitude", "factor on the signal"},
      {"frequency", "cycles a second [Hz; rad/s and rpm are converted]"},
      {"end_frequency", "of a chirp [Hz]"},
      {"duration", "of a ramp, which then keeps its value, or of the sweep of a chirp [s]"},
      {"width", "of a pulse [s]"},
      {"interval", "of noise: the time for which each value holds [s]"},
      {"seed", "of noise: a whole number; signals of one seed have the same values"},
      {"phase", "added to the angle [rad]"},
      {"offset", "added to the signal, also before its `time`"},
      {"time", "when it starts [s]; 0 if absent"},
  };
  for (const auto& [key, description] : reader) properties[key] = described(reference("value"), description);
  Json table = object(std::move(properties));
  table.update(one_required(shapes));
  table["dependentRequired"] = {{"sine", {"frequency"}},   {"cosine", {"frequency"}},
                                {"square", {"frequency"}}, {"triangle", {"frequency"}},
                                {"pulse", {"width"}},      {"chirp", {"frequency", "end_frequency", "duration"}},
                                {"noise", {"interval", "seed"}}};
  Json block = object({{"block", text("the name of a block: its output is the signal, with - its negative")}});
  block["required"] = {"block"};
  return described({{"anyOf", {reference("value"), std::move(table), std::move(block)}}},
                   "a function of time: a constant, or a shape; or what a block puts out");
}

Json characteristic_schema() {
  Json long_form = object({{"table", table_schema("points")}});
  add_table_keys(long_form["properties"], "displacements or velocities and of the forces");
  long_form["required"] = {"table"};
  return {{"anyOf", {table_schema("points [displacement or velocity, force], or an expression over d or w"), std::move(long_form)}}};
}

Json repeat_schema() {
  Json schema = object({{"count", described(reference("value"), "how many; `n` in expressions")},
                        {"as", text("name of the number of a member, 0 to count-1, in expressions")},
                        {"arrange", {{"enum", {"series", "parallel"}}}}});
  schema["required"] = {"count"};
  return described(std::move(schema), "a chain or a bundle of this element: its members are NAME.0, NAME.1, ...");
}

Json check_schema() {
  const Json that = text("a comparison between parameters: \"speed < critical_speed\"");
  Json schema = object({{"that", that},
                        {"warn", text("shown where it does not hold; the run goes on")},
                        {"error", text("shown where it does not hold; the scene is refused")}});
  schema["required"] = {"that"};
  schema["not"] = {{"required", {"warn", "error"}}};
  return described(named({{"anyOf", {that, std::move(schema)}}}), "what should hold between the parameters");
}

Json own_parameters() {
  const Json defaults = named(reference("value"));
  return described({{"anyOf", {defaults, list_of({{"anyOf", {text("a parameter without a default"), defaults}}})}}},
                   "parameters with their defaults, or a list of names without and of tables with defaults");
}

Json both_domains() {
  return {{"enum", {"both"}}, {"description", "its defaults, of translation, count in rotation as their counterparts: N as N*m, m as rad, kg as kg*m^2"}};
}

Json model_schema() {
  Json schema = object(
      {{"ports", described(list_of(text("name of a node inside"), 1), "nodes by which it is connected, in this order")},
       {"parameters", own_parameters()},
       {"domain", both_domains()},
       {"check", check_schema()},
       {"elements", reference("elements")}});
  schema["required"] = {"ports", "elements"};
  return described(std::move(schema), "a network with ports, used as an element type");
}

Json law_schema() {
  Json state = object({{"start", described(reference("value"), "its value at the start, with its unit")}, {"rate", text("an expression")}});
  state["required"] = {"start", "rate"};
  Json schema = object({{"force", text("an expression over the displacement d, the velocity w, the time t, parameters, states, inputs and names in `where`")},
                        {"parameters", own_parameters()},
                        {"domain", both_domains()},
                        {"check", check_schema()},
                        {"inputs", list_of(text("the name of a signal, which each instance gives"), 1)},
                        {"where", described(named(text("an expression")), "names for parts of the expressions")},
                        {"states", described(named(std::move(state)), "rate(z) is the rate of the state z in other expressions")},
                        {"stores", text("the energy stored in it, an expression")},
                        {"summary", text("what it is")},
                        {"source", text("where it comes from")}});
  schema["required"] = {"force"};
  return described(std::move(schema), "an element type of the file's own, between two nodes");
}

Json expect_schema() {
  const Json value = reference("value");
  const Json claimed = {{"anyOf", {value, {{"type", "array"}, {"items", value}, {"minItems", 2}, {"maxItems", 2}}}}};
  Json claim = object({{"value", described(claimed, "at the time `at`; one value, or two between which it lies")},
                       {"final", described(claimed, "at the end of the run")},
                       {"max", described(claimed, "the largest")},
                       {"min", described(claimed, "the smallest")},
                       {"mean", described(claimed, "mean over time")},
                       {"rms", described(claimed, "root mean square over time")},
                       {"crosses", described(value, "a value that is crossed, for the first time at the time `at`")},
                       {"at", described(claimed, "[s]; with `value` and `crosses`")},
                       {"from", described(value, "[s]; where max, min, mean, rms, crosses look; the start if absent")},
                       {"to", described(value, "[s]; the end if absent")},
                       {"per", text("another record: the claim is on the ratio to its figure")},
                       {"within", described(value,
                                            "tolerance: with a unit absolute, without one a fraction of the record's "
                                            "largest magnitude in the run; the run's accuracy if absent")}});
  claim.update(one_required({"value", "final", "max", "min", "mean", "rms", "crosses"}));
  claim["dependentRequired"] = {{"value", {"at"}}, {"crosses", {"at"}}};
  // The last alternative: without quotes k1.force is a table in a table.
  return described(named({{"anyOf", {claim, list_of(claim, 1), reference("expect")}}}),
                   "claims on results, by record; checked after a run");
}

Json plot_schema() {
  const auto texts = [](const std::string& description) {
    return described({{"anyOf", {text(description), list_of(text(description))}}}, description);
  };
  Json schema = object({{"x", text("a record; `time` if absent")},
                        {"y", texts("records that are drawn against it")},
                        {"loop", texts("elements: force against displacement")},
                        {"flow", texts("elements: force against velocity")},
                        {"phase", texts("nodes: velocity against position")},
                        {"unit", texts("units for the axes that have their dimension")},
                        {"log", {{"enum", {"x", "y", "xy"}}, {"description", "logarithmic axes"}}}});
  schema["dependentRequired"] = {{"x", {"y"}}};
  return described(std::move(schema), "what is drawn where nobody says otherwise");
}

Json demo_schema() {
  const Json range = {{"type", "array"}, {"items", reference("value")}, {"minItems", 2}, {"maxItems", 3}};
  Json schema = object({{"question", text("what it is about")},
                        {"change", text("which values to change")},
                        {"see", text("what can then be seen")},
                        {"why", text("why that is so")},
                        {"sliders", described(named(range), "parameters worth moving: from, to and perhaps a step")}});
  schema["required"] = {"question", "change", "see", "why"};
  return described(std::move(schema), "what a scene is to teach");
}

Json simulate_schema() {
  Json output = object({{"every", described(reference("value"), "interval of the rows [s]")},
                        {"points", described(reference("value"), "number of rows, first and last included")},
                        {"events",
                         {{"type", "boolean"},
                          {"description", "a pair of rows, before and after, at every event"},
                          {"default", false}}}});
  Json expression = object({{"name", text("its column, and its path elsewhere: gap")},
                            {"value", text("an expression over records and parameters: a.position - b.position")}});
  expression["required"] = {"name", "value"};
  Json schema = object({{"start", described(reference("value"), "[s]; 0 if absent")},
                        {"start_from",
                         {{"enum", {"given", "rest", "steady"}},
                          {"description", "start values as given; or at rest, or in steady motion, with all forces balanced"},
                          {"default", "given"}}},
                        {"method",
                         {{"enum", {"auto", "ida", "exact"}},
                          {"description", "how the time between events is crossed: in closed form where all laws are linear there, else by SUNDIALS IDA; or by one of them"},
                          {"default", "auto"}}},
                        {"stop", described(reference("value"), "[s]")},
                        {"stop_when", text("a comparison over records and parameters, at whose event the run ends earlier: a.position > xmax")},
                        {"accuracy", described(reference("value"),
                                               "error allowed, relative to the largest magnitude of "
                                               "each recorded quantity; 1e-6 if absent")},
                        {"output", std::move(output)},
                        {"record", described(list_of({{"anyOf", {text("k1.force, mid.velocity, mid.acceleration, k1.power, ..."), std::move(expression)}}}),
                                             "absent: every position, displacement, velocity, force and output")}});
  schema["required"] = {"stop"};
  return schema;
}

Json effects_schema() {
  std::string pattern;
  for (const Effect effect : effects()) pattern += (pattern.empty() ? "" : "|") + name_of(effect);
  const Json list = list_of({{"type", "string"}, {"pattern", "^(" + pattern + ")(:.+)?$"}});
  Json schema = object({{"without", described(list, "effects that are left out: inertia, or elasticity:oil of one element")},
                        {"only", described(list, "all others are left out")}});
  return described(std::move(schema), "physical effects that the scene does without");
}

}  // namespace

std::string json_schema(Declarations declarations) {
  Json definitions;
  definitions["value"] = value();
  definitions["signal"] = signal_schema();
  definitions["characteristic"] = characteristic_schema();
  definitions["at"] = text("the node");
  definitions["between"] = described(list_of(text("a node; `ground` never moves"), 2),
                                     "its nodes: displacement, velocity and force count from the first to the second");
  definitions["repeat"] = repeat_schema();
  for (const Declaration* declaration : declarations) definitions[declaration->type] = element_schema(*declaration);
  definitions["group"] = group_schema();
  definitions["body"] = body_schema(declarations);
  definitions["member"] = {{"allOf", {reference("body")}}, {"properties", {{"at", false}, {"between", false}}}};
  Json element = {{"allOf", {reference("body")}}, {"properties", {{"name", false}}}};
  element.update(one_required({"at", "between"}));
  definitions["elements"] = described(named(std::move(element)), "one line, one element: the key is its name");
  definitions["model"] = model_schema();
  definitions["expect"] = expect_schema();
  // Also accepts k1.force without quotes.
  definitions["exact"] = described(named({{"anyOf", {reference("value"), reference("exact")}}}),
                                   "closed forms of records, over the parameters and the time t");
  const Json node = object({{"position", described(reference("value"), "at the start; 0 if absent")},
                            {"velocity", described(reference("value"), "at the start; 0 if absent")}});

  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "rheonet netlist, version 1"}};
  schema.update(object({
      {"title", text("of the scene")},
      {"domain",
       {{"enum", {"translation", "rotation"}},
        {"default", "translation"},
        {"description", "m, N, kg or rad, N*m, kg*m^2"}}},
      {"include",
       described(list_of(text("a file with models")), "looked for beside this file and below, then in the library")},
      {"parameters", described(named(reference("value")), "named values, for all expressions")},
      {"check", check_schema()},
      {"nodes", described(named(node), "initial values that are not 0; nodes exist by being named")},
      {"elements", reference("elements")},
      {"models", named(reference("model"))},
      {"laws", named(law_schema())},
      {"simulate", simulate_schema()},
      {"effects", effects_schema()},
      {"expect", reference("expect")},
      {"exact", reference("exact")},
      {"plot", plot_schema()},
      {"demo", demo_schema()},
  }));
  schema["$defs"] = std::move(definitions);
  return schema.dump(2);
}

}  // namespace rheonet
