#include "tests/contract/situation.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/network/error.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test {

namespace {

const char* name_of(Wiring wiring) {
  switch (wiring) {
    case Wiring::held:
      return "between a prescribed and a massive node";
    case Wiring::free:
      return "between massive nodes";
    case Wiring::series:
      return "in series with a spring";
    case Wiring::given:
      return "between prescribed nodes";
  }
  return "";
}

/// The network around the element, and the element where it belongs.
class Surroundings {
 public:
  Surroundings(const Component& component, Place place, std::uint64_t seed)
      : component_(component), place_(place), random_(seed), builder_(place.domain) {
    const Declaration::Ports ports = component.declaration.ports;
    ends_ = ports == Declaration::Ports::between || (ports == Declaration::Ports::at_or_between && seed % 2);
  }

  Situation build(const std::vector<double>& values, std::uint64_t seed) {
    if (place_.moving_base) {
      builder_.motion("rest", far(), place_.velocities ? "velocity" : "position", Signal());
      if (place_.velocities) builder_.start(far(), 0);
    }
    switch (place_.wiring) {
      case Wiring::held:
        drive("a");
        put(values, "a", "b", "b");
        mass("b");
        if (!ends_) spring("a", "b");
        spring("b", far());
        dashpot("b", far());
        break;
      case Wiring::free:
        mass("a");
        mass("b");
        put(values, "a", "b", "b");
        if (!ends_) spring("a", "b");
        spring("a", far());
        spring("b", far());
        dashpot("b", far());
        builder_.force("push", "a", draw_signal(Quantity::force, place_.domain, random_.below(6), random_));
        break;
      case Wiring::series:
        drive("a");
        spring("a", "mid");
        begin_mid(values);
        put(values, "mid", far(), "mid");
        if (needs_mass(values)) {
          builder_.at(next("mass"), "mass", "mid", {{"mass", 0.3 * draw(Quantity::mass)}});
          begin("mid");
        }
        if (!ends_) dashpot("mid", far());
        break;
      case Wiring::given:
        drive("a");
        if (!motion()) drive("b");
        if (forbids(values)) {
          // Motions that it forbids are refused: something gives way.
          begin_mid(values);
          put(values, "a", "mid", "mid");
          spring("mid", "b");
        } else {
          put(values, "a", "b", "b");
        }
        dashpot("a", "b");
        break;
    }
    constexpr int intervals = 47;
    Situation result{builder_.finish(3.71 * typical.time, intervals, accuracy), element_, ""};
    result.text = fmt::format("{}, {}, seed {}{}", component_.declaration.type, name_of(place_.wiring), seed,
                              place_.domain == Domain::rotation ? ", in rotation" : "");
    for (std::size_t k = 0; k < values.size(); ++k) {
      result.text += fmt::format(", {} = {:.17g}", component_.declaration.parameters[k].name, values[k]);
    }
    return result;
  }

 private:
  std::string far() const { return place_.moving_base ? "base" : "ground"; }
  bool forbids(const std::vector<double>& values) const {
    SceneElement e = SceneBuilder::element("element", component_.declaration.type);
    e.values = values;
    return one_way(e);
  }
  /// Its force depends on its velocity in a way that no balance of forces may determine.
  bool needs_mass(const std::vector<double>& values) const {
    return over_velocity(component_, {values}) || (component_.beside && component_.beside(values));
  }
  bool motion() const { return component_.role == Role::motion; }
  double scale(Quantity quantity) const { return typical.of(quantity, place_.domain); }
  double start() { return random_.uniform(-0.7, 0.7) * scale(Quantity::position); }
  double draw(Quantity quantity) { return random_.around(scale(quantity), 1.6); }
  std::string next(const char* what) { return fmt::format("{}{}", what, ++count_); }

  void spring(const std::string& a, const std::string& b) {
    builder_.between(next("spring"), "spring", a, b,
                     {{"stiffness", draw(Quantity::stiffness)}, {"rest", 0.3 * start()}});
  }
  void dashpot(const std::string& a, const std::string& b) {
    builder_.between(next("dashpot"), "dashpot", a, b, {{"damping", 0.4 * draw(Quantity::damping)}});
  }
  void mass(const std::string& node) {
    builder_.at(next("mass"), "mass", node, {{"mass", 0.3 * draw(Quantity::mass)}});
    if (!(motion() && node == "b")) begin(node);
  }
  void begin(const std::string& node) {
    const double x = start();
    builder_.start(node, x, random_.uniform(-1, 1) * scale(Quantity::velocity));
  }

  /// Where the element's own start says what force is at a massless node, the node's place follows: another would
  /// contradict it.
  void begin_mid(const std::vector<double>& values) {
    const double x = start(), v = random_.uniform(-1, 1) * scale(Quantity::velocity);
    bool follows = component_.role == Role::force;
    for (std::size_t k = 0; k < values.size() && component_.role == Role::deflection; ++k) {
      const Parameter& p = component_.declaration.parameters[k];
      if (p.kind != Parameter::Kind::initial) continue;
      follows = follows || p.quantity == Quantity::position || !std::isnan(values[k]);
    }
    builder_.start("mid", ends_ && follows ? not_given : x, v);
  }

  /// A motion of a node, one half of them by position. The element under test takes its place if it is one.
  void drive(const std::string& node) {
    const bool by_position = random_.below(2) == 0 && !place_.velocities;
    const Quantity quantity = by_position ? Quantity::position : Quantity::velocity;
    const Signal signal = draw_signal(quantity, place_.domain, random_.below(signal_kinds), random_);
    const double x = start();
    builder_.motion(next("drive"), node, by_position ? "position" : "velocity", signal);
    if (!by_position) builder_.start(node, x);
  }

  void put(const std::vector<double>& values, const std::string& a, const std::string& b, const std::string& at) {
    SceneElement e = SceneBuilder::element("element", component_.declaration.type);
    e.values = values;
    e.at = !ends_;
    add_signals(e);
    const auto given_by = [&](Quantity quantity) {
      return motion() && e.signal_parameters.size() == 1 &&
             component_.declaration.parameters[static_cast<std::size_t>(e.signal_parameters[0])].quantity == quantity;
    };
    element_ = builder_.add(e, e.at ? at : a, b);
    if (!motion()) return;
    if (given_by(Quantity::acceleration)) {
      begin(at);
    } else {
      builder_.start(at, given_by(Quantity::velocity) ? start() : not_given);
    }
  }

  /// Adds the required signals, and one of several if exactly one must be given.
  void add_signals(SceneElement& e) {
    const Declaration& d = component_.declaration;
    const auto alternative = [&](const Parameter& p) {
      return std::find(d.one_of.begin(), d.one_of.end(), p.name) != d.one_of.end();
    };
    const auto varies = [&](std::size_t k) {
      const Parameter& p = d.parameters[k];
      if (!p.may_vary || !std::isnan(e.values[k]) || !p.same_as.empty()) return false;
      return !p.optional || random_.below(2) == 0;
    };
    const auto possible = [&](const Parameter& p) {
      return p.kind == Parameter::Kind::signal && !(place_.velocities && p.quantity == Quantity::position);
    };
    int alternatives = 0;
    for (const Parameter& p : d.parameters) alternatives += possible(p) && alternative(p);
    int chosen = alternatives > 0 ? random_.below(alternatives) : 0;
    for (std::size_t k = 0; k < d.parameters.size(); ++k) {
      const Parameter& p = d.parameters[k];
      if (!varies(k) && (!possible(p) || (alternative(p) && chosen-- != 0))) continue;
      e.signal_parameters.own().push_back(static_cast<int>(k));
      e.signals.own().push_back(draw_signal(p.quantity, place_.domain, random_.below(signal_kinds), random_));
    }
  }

  const Component& component_;
  Place place_;
  Random random_;
  SceneBuilder builder_;
  bool ends_ = false;  ///< the element stands between two nodes
  int element_ = -1;
  int count_ = 0;
};

}  // namespace

Situation situate(const Component& component, const std::vector<double>& values, Place place, std::uint64_t seed) {
  return Surroundings(component, place, seed).build(values, seed);
}

void for_each(const std::vector<Case>& cases, const std::function<void(const Case&, const Situation&)>& check) {
  for (const Case& c : cases) {
    const Situation situation = c.situation();
    CAPTURE(situation.text);
    try {
      check(c, situation);
    } catch (const SimulationError& refused) {
      FAIL_CHECK(std::string(refused.what()));
    }
  }
}

std::vector<Case> cases(bool moving_base, bool velocities) {
  constexpr Choice order[] = {Choice::fallbacks, Choice::random, Choice::lowest, Choice::random};
  std::vector<Case> result;
  for (const Component* component : components()) {
    if (component->role == Role::block) continue;  // no law between nodes
    if (component->ratio) continue;                // no two nodes of one domain and ratio: transmission_test.cpp
    // By name, so that a new element leaves the values of all others as they are.
    const std::string& type = component->declaration.type;
    std::uint64_t seed = std::accumulate(type.begin(), type.end(), std::uint64_t{0}, [](std::uint64_t sum, char c) { return 31 * sum + static_cast<unsigned char>(c); });
    for (const Wiring wiring : wirings) {
      for (const Choice choice : order) {
        ++seed;
        const Place place{wiring, seed % 3 == 1 ? Domain::rotation : Domain::translation, moving_base, velocities};
        Random random(1000 + seed);
        result.push_back({component, draw_values(*component, place.domain, choice, random), place, seed});
      }
    }
  }
  return result;
}

}  // namespace rheonet::test
