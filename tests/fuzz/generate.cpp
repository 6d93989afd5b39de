#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/netlist/signals.hpp"
#include "core/network/component.hpp"
#include "tests/fuzz/cases.hpp"
#include "tests/fuzz/scene_tree.hpp"

namespace rheonet::test {

namespace {

using Entries = std::vector<std::pair<std::string, TomlValue>>;

std::string node(Random& random) {
  const int n = random.below(6);
  return n == 0 ? "ground" : fmt::format("n{}", n);
}

/// One value in a dozen is odd: enough of them for each network to have some, few enough for most networks to run.
double value(Random& random) {
  if (random.below(12) > 0) return random.around(1, 1e3);
  const double odd = odd_number(random);
  return random.below(4) == 0 ? odd : std::abs(odd);
}

TomlValue signal(Random& random) {
  if (random.below(3) == 0) return number_value(random.sign() * value(random));
  const std::vector<std::string>& shapes = SignalTemplate::shape_names();
  const std::string& shape = shapes[static_cast<std::size_t>(random.below(static_cast<int>(shapes.size())))];
  Entries entries;
  if (shape == "table") {
    std::vector<TomlValue> points;
    double t = 0;
    for (int k = random.below(6); k >= 0; --k) {
      points.push_back(array_value({number_value(t), number_value(random.sign() * value(random))}));
      t += random.below(5) == 0 ? 0 : random.around(0.1, 10);
    }
    entries.emplace_back(shape, array_value(std::move(points)));
  } else {
    entries.emplace_back(shape, number_value(random.sign() * value(random)));
  }
  const auto add = [&](const char* key, double number) { entries.emplace_back(key, number_value(number)); };
  const bool turns = shape == "sine" || shape == "cosine" || shape == "square" || shape == "triangle" || shape == "chirp";
  if (turns) add("frequency", value(random));
  if (turns && random.below(4) == 0) add("phase", random.sign() * value(random));
  if (shape == "chirp") {
    add("end_frequency", value(random));
    add("duration", value(random));
  }
  if (shape == "pulse") add("width", value(random));
  if (shape == "noise") {
    add("interval", value(random));
    add("seed", random.below(1000));
  }
  if (random.below(5) == 0) add("time", random.sign() * random.around(0.1, 10));
  if (random.below(5) == 0) add("offset", random.sign() * value(random));
  return table_value(std::move(entries));
}

TomlValue parameter_value(const Parameter& parameter, const std::vector<std::string>& blocks, Random& random) {
  if (parameter.may_be_curve && random.below(4) == 0) {
    if (random.below(3) == 0) return string_value("1 + exp(-(w/0.1)^2) + 0.1*abs(w)");
    std::vector<TomlValue> points;
    double x = random.below(5) == 0 ? value(random) : 0;
    for (int k = random.below(6); k >= 0; --k, x += std::abs(value(random))) points.push_back(array_value({number_value(x), number_value(value(random))}));
    return array_value(std::move(points));
  }
  if (parameter.kind == Parameter::Kind::signal || (parameter.may_vary && random.below(4) == 0)) {
    if (parameter.from_block && !blocks.empty() && random.below(4) == 0)
      return table_value({{"block", string_value(blocks[static_cast<std::size_t>(random.below(static_cast<int>(blocks.size())))])}});
    return signal(random);
  }
  if (parameter.kind == Parameter::Kind::characteristic) {
    std::vector<TomlValue> points;
    double x = random.sign() * value(random);
    for (int k = random.below(6); k >= 0; --k, x += value(random)) points.push_back(array_value({number_value(x), number_value(random.sign() * value(random))}));
    return random.below(3) == 0 ? table_value({{"table", array_value(std::move(points))}}) : array_value(std::move(points));
  }
  if (parameter.kind == Parameter::Kind::expression) {
    const std::vector<std::string> texts{"u1", "-2*u1", "u1*abs(u1)", "u1 > 0.3 ? 1 : u1", "min(max(u1, -0.5), 2)", "sqrt(u1)", "sign(u1)*u1^2",
                                         "floor(3*u1)", "1/u1", "u1*u2", "sin(t)*u1", "u1 > 0 && u1 < 1 ? -1 : exp(-u1^2)"};
    return string_value(texts[static_cast<std::size_t>(random.below(static_cast<int>(texts.size())))]);
  }
  if (parameter.kind == Parameter::Kind::table) {
    std::vector<TomlValue> points;
    double u = random.sign() * value(random);
    for (int k = random.below(6); k >= 0; --k, u += random.below(5) == 0 ? 0 : random.around(0.1, 10))
      points.push_back(array_value({number_value(u), number_value(random.sign() * value(random))}));
    return array_value(std::move(points));
  }
  if (parameter.kind == Parameter::Kind::coefficients) {
    std::vector<TomlValue> coefficients;
    for (int k = random.below(4); k >= 0; --k) coefficients.push_back(number_value(random.below(4) == 0 ? 0 : random.sign() * value(random)));
    return array_value(std::move(coefficients));
  }
  if (parameter.may_be_infinite && random.below(10) == 0) return string_value("inf");
  if (parameter.quantity == Quantity::number && random.below(2) == 0) return number_value(random.below(4));
  return number_value(value(random));
}

TomlValue element(const Declaration& declaration, const std::vector<std::string>& blocks, const std::vector<std::string>& paths, Domain domain,
                  Random& random) {
  const auto any_of = [&](const std::vector<std::string>& names) {
    return names.empty() ? std::string("n1.velocity") : names[static_cast<std::size_t>(random.below(static_cast<int>(names.size())))];
  };
  const bool renamed = domain == Domain::rotation && !declaration.rotational_type.empty();
  Entries entries{{"type", string_value(renamed ? declaration.rotational_type : declaration.type)}};
  using Ports = Declaration::Ports;
  if (declaration.ports == Ports::block) {
    std::vector<TomlValue> inputs;
    for (int k = 0; k < static_cast<int>(std::min<std::size_t>(declaration.inputs.most, 3)); ++k)
      if (k < static_cast<int>(declaration.inputs.least) || random.below(2) == 0)
        inputs.push_back(string_value((random.below(4) == 0 ? "-" : "") + any_of(random.below(2) == 0 && !blocks.empty() ? blocks : paths)));
    if (declaration.inputs.most == 1 && inputs.size() == 1)
      entries.emplace_back("in", inputs.front());
    else if (declaration.inputs.most > 0)
      entries.emplace_back("in", array_value(std::move(inputs)));
  } else if (declaration.ports == Ports::at || (declaration.ports == Ports::at_or_between && random.below(2) == 0)) {
    entries.emplace_back("at", string_value(node(random)));
  } else {
    const std::string one = node(random);
    std::string other = node(random);
    while (other == one && random.below(20) > 0) other = node(random);
    entries.emplace_back("between", array_value({string_value(one), string_value(other)}));
  }
  const std::vector<std::string>& one_of = declaration.one_of;
  const std::string chosen = one_of.empty() ? "" : one_of[static_cast<std::size_t>(random.below(static_cast<int>(one_of.size())))];
  for (const Parameter& parameter : declaration.parameters) {
    const bool alternative = std::find(one_of.begin(), one_of.end(), parameter.name) != one_of.end();
    const bool optional = parameter.optional || parameter.fallback || !parameter.same_as.empty() || parameter.kind == Parameter::Kind::initial;
    const int seldom = parameter.kind == Parameter::Kind::initial ? 20 : 3;  // start values that contradict each other end it all
    if (alternative ? parameter.name != chosen : optional && random.below(seldom) > 0) continue;
    entries.emplace_back(parameter.name_in(domain), parameter_value(parameter, blocks, random));
  }
  if (random.below(12) == 0 && declaration.ports == Ports::between)
    entries.emplace_back("repeat", table_value({{"count", number_value(1 + random.below(9))},
                                               {"arrange", string_value(random.below(2) ? "series" : "parallel")}}));
  return table_value(std::move(entries));
}

}  // namespace

double odd_number(Random& random) {
  using Limits = std::numeric_limits<double>;
  static const double odd[] = {0, -0.0, 1, -1, 2, -2, 0.5, 3, 10, 100, 1e3, 65536, 1e6, 1e9, 1e12, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e15,
                               1e16, 4503599627370497.0, 9007199254740993.0, 2147483648.0, 4294967296.0, 9223372036854775808.0, 1e20, 1e30,
                               1e50, 1e100, 1e150, 1e155, 1e200, 1e300, Limits::max(), Limits::min(), Limits::denorm_min(), 1e-320, 1e-310,
                               1e-300, 1e-200, 1e-160, 1e-100, 1e-30, Limits::epsilon(), 1 + Limits::epsilon(), Limits::infinity(),
                               Limits::quiet_NaN(), 1 - Limits::epsilon() / 2};
  if (random.below(3) == 0) return random.sign() * std::pow(10, random.uniform(-20, 20));
  const double number = odd[random.below(static_cast<int>(std::size(odd)))];
  return random.below(5) == 0 ? -number : number;
}

TomlValue generated_scene(Random& random) {
  Entries elements;
  std::vector<std::string> blocks, paths;
  const Domain domain = random.below(5) == 0 ? Domain::rotation : Domain::translation;
  const int count = 1 + random.below(9);
  // With a mass its motion is determined.
  for (int k = 1; k <= 5; ++k)
    if (random.below(3) > 0) {
      paths.push_back(fmt::format("n{}.velocity", k));
      paths.push_back(fmt::format("n{}.position", k));
      elements.emplace_back(fmt::format("m{}", k), table_value({{"type", string_value(domain == Domain::rotation ? "inertia" : "mass")},
                                                                {"at", string_value(fmt::format("n{}", k))},
                                                                {domain == Domain::rotation ? "inertia" : "mass", number_value(value(random))}}));
    }
  const Declarations all = declarations();
  for (int k = 0; k < count; ++k) {
    const Declaration& declaration = *all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))];
    const bool block = declaration.ports == Declaration::Ports::block;
    if (block && random.below(2) == 0) continue;  // networks come first
    const std::string name = fmt::format("{}{}", declaration.type, k);
    elements.emplace_back(name, element(declaration, blocks, paths, domain, random));
    block ? blocks.push_back(name) : paths.push_back(name + ".force");
  }
  Entries simulate{{"stop", number_value(random.below(8) == 0 ? odd_number(random) : random.around(1, 30))}};
  if (random.below(8) == 0 && !paths.empty())
    simulate.emplace_back("stop_when", string_value(fmt::format("{} > {:g}", paths[static_cast<std::size_t>(random.below(static_cast<int>(paths.size())))],
                                                                random.sign() * random.around(0.1, 10))));
  if (random.below(2) == 0) simulate.emplace_back("accuracy", number_value(std::pow(10, -1 - random.below(10))));
  if (random.below(4) == 0) simulate.emplace_back("start", number_value(random.below(2) == 0 ? odd_number(random) : random.uniform(-2, 2)));
  if (random.below(4) == 0) simulate.emplace_back("start_from", string_value(random.below(2) == 0 ? "rest" : "steady"));
  if (random.below(4) == 0)
    simulate.emplace_back("output", table_value({{"points", number_value(2 + random.below(50))},
                                                 {"events", [&] {
                                                    TomlValue yes;
                                                    yes.kind = TomlValue::Kind::boolean;
                                                    yes.boolean = random.below(2) == 0;
                                                    return yes;
                                                  }()}}));
  Entries scene{{"elements", table_value(std::move(elements))}, {"simulate", table_value(std::move(simulate))}};
  if (domain == Domain::rotation) scene.insert(scene.begin(), {"domain", string_value("rotation")});
  if (random.below(5) == 0)
    scene.emplace_back("nodes", table_value({{node(random), table_value({{"position", number_value(random.sign() * value(random))},
                                                                        {"velocity", number_value(random.sign() * value(random))}})}}));
  return table_value(std::move(scene));
}

}  // namespace rheonet::test
