#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "core/network/component.hpp"
#include "tests/contract/generic.hpp"

namespace rheonet::test::declaration_test {

namespace {

bool within(const Parameter& p, double value) {
  if (std::isinf(value)) return p.may_be_infinite && value > 0;
  return (p.lower_open ? value > p.lower : value >= p.lower) && value <= p.upper;
}

/// Letters, digits and underscores, the first a letter: what a key of a netlist may be without quotes.
bool is_key(const std::string& name) {
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0) return false;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return false;
  }
  return true;
}

const Parameter* find(const Declaration& d, const std::string& name) {
  for (const Parameter& p : d.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

}  // namespace

TEST_CASE("contract: declarations are complete") {
  REQUIRE(!components().empty());
  for (const Component* component : components()) {
    const Declaration& d = component->declaration;
    CAPTURE(d.type);
    CHECK(is_key(d.type));
    CHECK(!d.summary.empty());
    CHECK(d.summary.find('\n') == std::string::npos);
    CHECK(!d.law.empty());
    CHECK(!d.equation.empty());
    CHECK(!d.source.empty());
    CHECK(!d.notes.empty());
    CHECK(!component->drawing.empty());
    const bool block = d.ports == Declaration::Ports::block;
    // A law of motion alone needs no parameter.
    CHECK((block || component->role == Role::slip || !d.parameters.empty()));
    for (const std::string& name : d.one_of) {
      REQUIRE_MESSAGE(find(d, name), name);
      CHECK_MESSAGE(!find(d, name)->fallback, name);
    }
    for (const Parameter& p : d.parameters) {
      CAPTURE(p.name);
      CHECK(is_key(p.name));
      CHECK(!p.symbol.empty());
      CHECK(!p.description.empty());
      CHECK(p.lower < p.upper);
      if (p.kind == Parameter::Kind::value) {
        if (p.fallback) CHECK(within(p, *p.fallback));
      } else {
        CHECK(!p.fallback);
        CHECK(!p.may_be_infinite);
      }
      if (p.optional || p.may_vary) CHECK(p.kind == Parameter::Kind::value);
      if (p.optional) CHECK((!p.fallback && p.same_as.empty()));
      if (p.may_vary) CHECK(((component->role == Role::slip || d.resists || component->varying) && p.unit == Parameter::Unit::quantity));
      if (!p.coefficient_with.empty()) {
        REQUIRE(find(d, p.coefficient_with));
        CHECK(find(d, p.coefficient_with)->optional);
        CHECK(p.quantity != Quantity::number);
      }
      if (!p.not_with.empty()) {
        REQUIRE(find(d, p.not_with));
        CHECK((p.fallback || p.optional));
        CHECK(!find(d, p.not_with)->same_as.empty());
      }
      if (!p.same_as.empty()) {
        REQUIRE(find(d, p.same_as));
        CHECK(find(d, p.same_as)->quantity == p.quantity);
        CHECK(!p.fallback);
      }
      if (!p.flow_index.empty()) {
        REQUIRE(find(d, p.flow_index));
        CHECK(p.quantity == Quantity::damping);
        CHECK(find(d, p.flow_index)->quantity == Quantity::number);
        CHECK(find(d, p.flow_index)->fallback);
      }
    }
    for (const Limit& limit : component->limits) {
      CHECK(!limit.when.empty());
      REQUIRE(limit.applies);
      if (limit.becomes.empty()) continue;
      CHECK(limit.values);
      CHECK_MESSAGE(find_component(limit.becomes), limit.becomes);
    }
    CHECK((component->role == Role::deflection) == static_cast<bool>(component->deflection));
    CHECK((component->role == Role::block) == block);
    CHECK(block == static_cast<bool>(component->block));
    CHECK((component->role == Role::rate) == static_cast<bool>(component->rate));
  }
}

TEST_CASE("contract: names are unique") {
  std::set<std::string> types;
  for (const Component* component : components()) {
    const Declaration& d = component->declaration;
    CAPTURE(d.type);
    CHECK(types.insert(d.type).second);
    if (!d.rotational_type.empty()) CHECK(types.insert(d.rotational_type).second);
    for (const Domain domain : {Domain::translation, Domain::rotation}) {
      std::set<std::string> names, symbols;
      for (const Parameter& p : d.parameters) {
        CHECK_MESSAGE(names.insert(p.name_in(domain)).second, p.name);
        CHECK_MESSAGE(symbols.insert(p.symbol).second, p.symbol);
      }
    }
  }
}

TEST_CASE("contract: the registry is in order, and finds what it lists") {
  REQUIRE_EQ(declarations().size(), components().size());
  for (std::size_t k = 0; k < components().size(); ++k) {
    const Component* component = components()[k];
    CHECK_EQ(declarations()[k], &component->declaration);
    CHECK_EQ(find_component(component->declaration.type), component);
    if (k > 0) CHECK(components()[k - 1]->declaration.type < component->declaration.type);
  }
  CHECK_EQ(find_component("no such component"), nullptr);
}

}  // namespace rheonet::test::declaration_test
