#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/netlist/read.hpp"

namespace rheonet::test::schema_test {

using nlohmann::json;

namespace {

const Declaration damper{
    .type = "damper",
    .parameters = {{.name = "damping",
                    .quantity = Quantity::damping,
                    .lower_open = false,
                    .may_be_infinite = true,
                    .flow_index = "index",
                    .symbol = "B",
                    .description = "force at unit velocity"},
                   {.name = "index", .quantity = Quantity::number, .fallback = 1.5, .upper = 20, .symbol = "n"},
                   {.name = "limit", .quantity = Quantity::force, .same_as = "damping"},
                   {.name = "temperature", .fallback = 20.0, .symbol = "T"},
                   {.name = "d0",
                    .quantity = Quantity::position,
                    .kind = Parameter::Kind::initial,
                    .lower = -std::numeric_limits<double>::infinity()}},
    .summary = "a damper",
    .law = "f = B w^n",
};

const Declaration drive{
    .type = "drive",
    .rotational_type = "motor",
    .ports = Declaration::Ports::at,
    .parameters = {{.name = "position", .quantity = Quantity::position, .kind = Parameter::Kind::signal},
                   {.name = "velocity", .quantity = Quantity::velocity, .kind = Parameter::Kind::signal},
                   {.name = "mass", .quantity = Quantity::mass, .rotational_name = "inertia"}},
    .one_of = {"position", "velocity"},
    .summary = "a drive",
    .law = "x(t)",
};

const json& schema() {
  static const Declaration* const declarations[] = {&damper, &drive};
  static const json made = json::parse(json_schema(declarations));
  return made;
}

json required(std::initializer_list<const char*> keys) {
  json alternatives = json::array();
  for (const char* key : keys) alternatives.push_back({{"required", {key}}});
  return {{"oneOf", alternatives}};
}

void collect_references(const json& node, std::set<std::string>& references) {
  if (node.is_object() && node.contains("$ref")) references.insert(node["$ref"]);
  if (!node.is_structured()) return;
  for (const json& child : node) collect_references(child, references);
}

}  // namespace

TEST_CASE("the schema is of draft 2020-12 and knows the top-level keys and no others") {
  CHECK(schema()["$schema"] == "https://json-schema.org/draft/2020-12/schema");
  CHECK(schema()["additionalProperties"] == false);
  for (const char* key : {"title", "domain", "include", "parameters", "nodes", "elements", "models", "simulate", "effects"})
    CHECK(schema()["properties"].contains(key));
  CHECK(schema()["properties"].size() == 15);
  CHECK_FALSE(schema().contains("required"));  // a library has models only
}

TEST_CASE("all references of the schema lead somewhere") {
  std::set<std::string> references;
  collect_references(schema(), references);
  CHECK(references.size() > 10);
  for (const std::string& reference : references) {
    CAPTURE(reference);
    CHECK(schema().contains(json::json_pointer(reference.substr(1))));
  }
}

TEST_CASE("a parameter has its description, units, default and bounds") {
  const json& properties = schema()["$defs"]["damper"]["properties"];
  CHECK(properties["damping"]["description"] ==
        "B: force at unit velocity [N*(s/m)^index, in a rotational scene N*m*(s/rad)^index]; may be \"inf\"");
  CHECK(properties["damping"]["minimum"] == 0);
  CHECK_FALSE(properties["damping"].contains("exclusiveMinimum"));
  CHECK(properties["index"]["exclusiveMinimum"] == 0);
  CHECK(properties["index"]["maximum"] == 20);
  CHECK(properties["index"]["default"] == 1.5);
  CHECK(properties["index"]["description"] == "n [no unit]; 1.5 if absent");
  CHECK_FALSE(properties["d0"].contains("minimum"));
  CHECK(properties["d0"]["$ref"] == "#/$defs/value");
  CHECK(properties["temperature"]["description"] == "T [no unit]; 20 if absent");
}

TEST_CASE("an element type requires what has no default, and takes nothing unknown") {
  const json& element = schema()["$defs"]["damper"];
  CHECK(element["additionalProperties"] == false);
  CHECK(element["allOf"] == json::array({required({"damping"})}));
  CHECK(element["properties"].contains("between"));
  CHECK_FALSE(element["properties"].contains("at"));
  const json& driven = schema()["$defs"]["drive"];
  CHECK(driven["allOf"] == json::array({required({"mass", "inertia"}), required({"position", "velocity"})}));
  CHECK(driven["properties"]["velocity"]["$ref"] == "#/$defs/signal");
  CHECK(driven["properties"].contains("at"));
  CHECK_FALSE(driven["properties"].contains("between"));
  CHECK(driven["properties"]["type"]["enum"] == json::array({"drive", "motor"}));
}

TEST_CASE("known types are offered by name, and any other may be a model") {
  const json& body = schema()["$defs"]["body"];
  const json& types = body["properties"]["type"]["anyOf"];
  CHECK(types.size() == 4);
  CHECK(types[0]["const"] == "damper");
  CHECK(types[0]["description"] == "a damper: f = B w^n");
  CHECK(types[1]["const"] == "drive");
  CHECK(types[2]["const"] == "motor");
  CHECK(types[3]["type"] == "string");
  CHECK_FALSE(body.contains("additionalProperties"));
  CHECK(body["allOf"][1]["if"]["properties"]["type"]["enum"] == json::array({"drive", "motor"}));
  CHECK(body["allOf"][1]["if"]["required"] == json::array({"type"}));
  CHECK(body["allOf"][1]["then"]["$ref"] == "#/$defs/drive");
  CHECK(body["allOf"].size() == 4);  // and series, parallel
}

TEST_CASE("an element has a place, a member of a group has none") {
  const json& element = schema()["$defs"]["elements"]["additionalProperties"];
  CHECK(element["oneOf"] == required({"at", "between"})["oneOf"]);
  CHECK(element["properties"]["name"] == false);
  CHECK(schema()["$defs"]["member"]["properties"]["between"] == false);
  const json& group = schema()["$defs"]["group"];
  CHECK(group["oneOf"] == required({"series", "parallel"})["oneOf"]);
  CHECK(group["properties"]["series"]["items"]["$ref"] == "#/$defs/member");
}

TEST_CASE("a signal is a value or one shape with what that needs") {
  const json& alternatives = schema()["$defs"]["signal"]["anyOf"];
  CHECK(alternatives[0]["$ref"] == "#/$defs/value");
  const json& table = alternatives[1];
  CHECK(table["oneOf"] ==
        required({"step", "ramp", "sine", "cosine", "square", "triangle", "chirp", "pulse", "noise", "table"})["oneOf"]);
  CHECK(table["dependentRequired"]["sine"] == json::array({"frequency"}));
  CHECK(table["dependentRequired"]["pulse"] == json::array({"width"}));
  CHECK_FALSE(table["dependentRequired"].contains("step"));
  CHECK(table["additionalProperties"] == false);
}

TEST_CASE("a check is a comparison, alone or with a message for one of two levels") {
  const json& alternatives = schema()["properties"]["check"]["additionalProperties"]["anyOf"];
  CHECK(alternatives[0]["type"] == "string");
  CHECK(alternatives[1]["required"] == json::array({"that"}));
  CHECK(alternatives[1]["not"]["required"] == json::array({"warn", "error"}));
  CHECK(alternatives[1]["additionalProperties"] == false);
}

TEST_CASE("a claim has one figure, and a time where that needs one; a record has one claim or several") {
  const json& alternatives = schema()["$defs"]["expect"]["additionalProperties"]["anyOf"];
  const json& claim = alternatives[0];
  CHECK(alternatives[1]["items"] == claim);
  CHECK(claim["oneOf"] == required({"value", "final", "max", "min", "mean", "rms", "crosses"})["oneOf"]);
  CHECK(claim["dependentRequired"]["crosses"] == json::array({"at"}));
  CHECK(claim["properties"]["max"]["anyOf"][1]["maxItems"] == 2);
  CHECK(claim["additionalProperties"] == false);
}

TEST_CASE("a demo has its four texts, a slider two ends and perhaps a step; a plot with an x has a y") {
  const json& demo = schema()["properties"]["demo"];
  CHECK(demo["required"] == json::array({"question", "change", "see", "why"}));
  CHECK(demo["additionalProperties"] == false);
  const json& slider = demo["properties"]["sliders"]["additionalProperties"];
  CHECK(slider["minItems"] == 2);
  CHECK(slider["maxItems"] == 3);
  CHECK(slider["items"]["$ref"] == "#/$defs/value");
  const json& plot = schema()["properties"]["plot"];
  CHECK(plot["dependentRequired"]["x"] == json::array({"y"}));
  CHECK(plot["properties"]["loop"]["anyOf"][1]["items"]["type"] == "string");
  CHECK(plot["properties"]["log"]["enum"] == json::array({"x", "y", "xy"}));
  CHECK(plot["additionalProperties"] == false);
}

}  // namespace rheonet::test::schema_test
