#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tools/draw/symbol_path.hpp"
#include "tools/report/messages.hpp"

namespace rheonet::report {
namespace {

using nlohmann::json;

json in_both(const auto& of) { return {{"translation", of(Domain::translation)}, {"rotation", of(Domain::rotation)}}; }

std::string unit_in(const Parameter& p, Domain domain) {
  const bool has_one = p.unit == Parameter::Unit::quantity && p.quantity != Quantity::number &&
                       p.kind != Parameter::Kind::expression && p.kind != Parameter::Kind::table && p.kind != Parameter::Kind::coefficients;
  return has_one ? unit_of(p.quantity, domain) : "";
}

/// A value [SI] that is neither tiny nor huge beside those of other quantities: together they give motions of seconds and of
/// centimetres or radians.
double usual(Quantity quantity, Domain domain) {
  switch (quantity) {
    case Quantity::stiffness:
      return domain == Domain::rotation ? 1 : 100;
    case Quantity::velocity:
    case Quantity::position:
      return domain == Domain::rotation ? 1 : 0.01;
    case Quantity::length:
    case Quantity::time:
      return 0.1;
    default:
      return 1;
  }
}

/// A value to begin with, as TOML.
std::string first_value(const Parameter& p, Domain domain) {
  if (p.kind == Parameter::Kind::expression) return "\"u1\"";
  if (p.kind == Parameter::Kind::table) return "[[0, 0], [1, 1]]";
  if (p.kind == Parameter::Kind::coefficients) return "[1]";
  const double value = usual(p.quantity, domain);
  const std::string unit = unit_in(p, domain);
  return unit.empty() ? fmt::format("{:g}", value) : fmt::format("\"{:g} {}\"", value, unit);
}

bool is_given_otherwise(const Parameter& p) {
  return p.fallback || p.optional || p.kind == Parameter::Kind::initial || !p.same_as.empty() || !p.second_of.empty();
}

/// The parameter to give if one of several is required: a velocity, so that a drive moves, or else the first.
std::string chosen(const Declaration& d) {
  for (const Parameter& p : d.parameters)
    if (p.prescribes(Quantity::velocity) && std::find(d.one_of.begin(), d.one_of.end(), p.name) != d.one_of.end()) return p.name;
  return d.one_of.empty() ? "" : d.one_of.front();
}

bool is_alternative(const Parameter& p, const Declaration& d) { return std::find(d.one_of.begin(), d.one_of.end(), p.name) != d.one_of.end(); }

/// The parameters that a new element gives: those that it needs, and one more where they alone do not go together.
std::set<std::string> given_at_first(const Declaration& d) {
  std::set<std::string> given;
  std::vector<double> values;
  for (const Parameter& p : d.parameters) {
    const bool begins = is_alternative(p, d) ? p.name == chosen(d) : !is_given_otherwise(p);
    if (begins) given.insert(p.name);
    values.push_back(begins ? usual(p.quantity, Domain::translation) : p.fallback.value_or(not_given));
  }
  const std::optional<Misfit> misfit = d.check ? d.check(values) : std::nullopt;
  for (const Parameter& p : d.parameters)
    // Give the upper bound rather than the lower one: initial values are above 0.
    if (misfit && p.name == misfit->parameter) given.insert(p.turned.empty() ? p.name : p.turned);
  return given;
}

json parameter(const Parameter& p, const Declaration& d, const std::set<std::string>& given) {
  const bool alternative = is_alternative(p, d);
  return {{"name", in_both([&](Domain domain) { return p.name_in(domain); })},
          {"symbol", p.symbol},
          {"description", p.description},
          {"unit", in_both([&](Domain domain) { return unit_in(p, domain); })},
          {"signal", p.takes_signal()},
          {"source", p.kind == Parameter::Kind::signal},
          {"alternative", alternative},
          {"required", !alternative && !is_given_otherwise(p)},
          {"without", p.fallback ? fmt::format("{:g}", *p.fallback) : p.same_as.empty() ? "" : (p.opposite ? "-" : "") + p.same_as},
          {"first", in_both([&](Domain domain) { return first_value(p, domain); })},
          {"begins", given.contains(p.name)}};
}

const char* group_of(const Component& component) {
  using Ports = Declaration::Ports;
  const Declaration& d = component.declaration;
  if (d.ports == Ports::block) return "Signals";
  if (d.ports != Ports::between) return "At a node";
  return component.ratio || component.role == Role::train ? "Transmissions" : "Between two nodes";
}

const char* name_of(Declaration::Ports ports) {
  using Ports = Declaration::Ports;
  return ports == Ports::between ? "between" : ports == Ports::at ? "at" : ports == Ports::block ? "block" : "at or between";
}

json type(const Component& component) {
  const Declaration& d = component.declaration;
  json parameters = json::array();
  const std::set<std::string> given = given_at_first(d);
  for (const Parameter& p : d.parameters)
    if (p.second_of.empty()) parameters.push_back(parameter(p, d, given));
  json nodes = json::array();
  if (d.ports == Declaration::Ports::between) nodes = d.three.empty() ? json{"a", "b"} : json(d.three);
  if (d.ports == Declaration::Ports::at || d.ports == Declaration::Ports::at_or_between) nodes = json{"node"};
  return {{"type", in_both([&](Domain domain) { return domain == Domain::rotation && !d.rotational_type.empty() ? d.rotational_type : d.type; })},
          {"group", group_of(component)},
          {"ports", name_of(d.ports)},
          {"nodes", nodes},
          {"least_inputs", d.ports == Declaration::Ports::block ? d.inputs.least : 0},
          {"most_inputs", d.ports == Declaration::Ports::block ? d.inputs.most : 0},
          {"summary", d.summary},
          {"tex", d.equation},
          {"law", d.law},
          {"symbol", in_both([&](Domain domain) { return draw::symbol_svg(component, domain); })},
          {"parameters", parameters}};
}

}  // namespace

std::string catalogue_message() {
  json types = json::array();
  for (const Component* component : components()) types.push_back(type(*component));
  return to_line({{"kind", "catalogue"}, {"types", types}, {"schema", json::parse(json_schema(declarations()))}});
}

}  // namespace rheonet::report
