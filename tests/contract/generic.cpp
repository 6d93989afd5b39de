#include "tests/contract/generic.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rheonet::test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double draw_number(const Parameter& p, Choice choice, Random& random) {
  if (choice == Choice::lowest && !p.lower_open && std::isfinite(p.lower)) return p.lower;
  if (choice == Choice::highest && std::isfinite(p.upper)) return p.upper;
  const double centre = p.fallback.value_or(1);
  const double drawn = centre == 0 ? random.uniform(-1, 1) : random.around(centre, 2.7);
  if (p.lower_open && drawn < p.lower) return std::min(2 * p.lower - drawn, p.upper);  // next to a bound that it cannot have, a law has no limit
  return std::clamp(drawn, p.lower, p.upper);
}

double draw_value(const Parameter& p, double scale, Random& random) {
  const double drawn = random.around(scale, 2.3) * (p.lower < 0 ? random.sign() : 1);
  return std::clamp(drawn, p.lower, p.upper);
}

/// Positions of a table or a triangle start where the node is before the run.
Signal continuous_table(double scale, double until, bool jumps, Random& random) {
  Signal::Table table{.times = {0}, .values = {jumps ? random.uniform(-scale, scale) : 0}, .time = 0, .offset = 0};
  constexpr int points = 7;
  for (int k = 1; k <= points; ++k) {
    table.times.push_back(until * (k + random.uniform(-0.3, 0.3)) / points);
    table.values.push_back(scale * (k % 2 ? 1 : -1) * random.uniform(0.2, 1.3));
  }
  return Signal(table);
}

}  // namespace

namespace {

std::vector<double> draw_once(const Component& component, Domain domain, Choice choice, Random& random) {
  const Declaration& d = component.declaration;
  std::vector<double> values(d.parameters.size(), not_given);
  const auto draw = [&](std::size_t k) {
    const Parameter& p = d.parameters[k];
    if (p.kind != Parameter::Kind::value) return;
    if (p.optional && (choice == Choice::fallbacks || random.below(2) == 0)) return;
    if (p.may_vary && !component.varying && choice == Choice::random && random.below(2) == 0) return;
    if (choice == Choice::fallbacks && p.fallback) {
      values[k] = p.fallback.value_or(not_given);
    } else if (p.quantity == Quantity::number) {
      values[k] = draw_number(p, choice, random);
    } else {
      values[k] = draw_value(p, typical.of(p.quantity, domain, flow_index(d, p, values)), random);
    }
  };
  // Numbers first: the unit of a damping goes with its flow index.
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (d.parameters[k].quantity == Quantity::number) draw(k);
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (d.parameters[k].quantity != Quantity::number) draw(k);
  }
  for (const Parameter& p : d.parameters) {
    if (p.same_as.empty()) continue;
    const auto index = [&](const std::string& name) {
      return std::find_if(d.parameters.begin(), d.parameters.end(),
                          [&](const Parameter& q) { return q.name == name; }) -
             d.parameters.begin();
    };
    values[static_cast<std::size_t>(index(p.name))] = values[static_cast<std::size_t>(index(p.same_as))];
  }
  return values;
}

}  // namespace

std::vector<double> draw_values(const Component& component, Domain domain, Choice choice, Random& random) {
  const Declaration& d = component.declaration;
  std::vector<double> values = draw_once(component, domain, choice, random);
  for (int drawn = 0; d.check && d.check(values); ++drawn) {
    REQUIRE_MESSAGE(drawn < 60, d.type << " accepts no values");
    // Some values exclude each other: not all of them can be at an end of their range.
    values = draw_once(component, domain, choice == Choice::fallbacks || drawn > 30 ? Choice::random : choice, random);
  }
  if (choice == Choice::fallbacks) return values;

  for (std::size_t k = 0; k < values.size(); ++k) {
    const Parameter& p = d.parameters[k];
    if (p.kind != Parameter::Kind::initial || p.quantity == Quantity::position) continue;
    values[k] = random.uniform(0.5, 2) * random.sign() * typical.of(p.quantity, domain);
    for (int halved = 0; d.check && d.check(values); ++halved) {
      REQUIRE_MESSAGE(halved < 60, d.type << " accepts no value of " << p.name);
      values[k] /= 2;
    }
  }
  if (d.check) REQUIRE_FALSE(d.check(values));
  return values;
}

Signal draw_signal(Quantity quantity, Domain domain, int kind, Random& random, bool jumps) {
  jumps = jumps && quantity != Quantity::position;
  const double amplitude = random.around(1.7, 1.3) * random.sign() * typical.of(quantity, domain);
  const double frequency = random.around(0.6, 1.3) / typical.time;
  const double phase = jumps ? random.uniform(0, 2 * std::numbers::pi) : 0;
  const double time = random.uniform(0.05, 0.3) * typical.time;
  const double width = random.uniform(1.1, 1.9) * typical.time;
  switch (kind % signal_kinds) {
    case 0:
      return Signal(Signal::Sine{amplitude, frequency, phase, 0, 0});
    case 1:
      return Signal(Signal::Triangle{amplitude, frequency, phase, time, 0});
    case 2:
      return Signal(Signal::Chirp{amplitude, 0.5 * frequency, 1.3 * frequency, 3 * typical.time, phase, 0, 0});
    case 3:
      return continuous_table(amplitude, 4 * typical.time, jumps, random);
    case 4:
      if (jumps) return Signal(Signal::Square{amplitude, frequency, phase, 0, 0});
      return Signal(Signal::Sine{amplitude, 0.7 * frequency, 0, time, 0});
    default:
      if (jumps) return Signal(Signal::Pulse{amplitude, width, 0.3 / typical.time, 0, time, -0.4 * amplitude});
      return Signal(Signal::Ramp{amplitude / typical.time, time, 0});
  }
}

std::vector<double> values_at_limit(const Component& component, std::size_t limit, const std::vector<double>& generic) {
  const std::vector<Parameter>& parameters = component.declaration.parameters;
  const auto first = [&](std::span<const double> values) {
    for (std::size_t k = 0; k < component.limits.size(); ++k) {
      if (component.limits[k].applies(values)) return k;
    }
    return component.limits.size();
  };
  // Each parameter stays, or becomes 0, or infinite: the fewest changes come first.
  std::vector<std::vector<double>> tried = {generic};
  for (std::size_t begin = 0, end = 1; begin < end; begin = end, end = tried.size()) {
    for (std::size_t t = begin; t < end; ++t) {
      if (first(tried[t]) == limit && (!component.declaration.check || !component.declaration.check(tried[t]))) return tried[t];
    }
    if (tried.size() > 5000) break;
    for (std::size_t t = begin; t < end; ++t) {
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        const Parameter& p = parameters[k];
        const bool changed = tried[t][k] != generic[k] && !(std::isnan(tried[t][k]) && std::isnan(generic[k]));
        if (p.kind != Parameter::Kind::value || changed) continue;
        for (const double end_value : {0.0, infinity}) {
          if (end_value == 0 ? p.lower > 0 || (p.lower == 0 && p.lower_open) : !p.may_be_infinite) continue;
          tried.push_back(tried[t]);
          tried.back()[k] = end_value;
        }
      }
    }
  }
  return {};
}

}  // namespace rheonet::test
