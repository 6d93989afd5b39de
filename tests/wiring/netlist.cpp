#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tests/support/random.hpp"
#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/random_wiring.hpp"

namespace rheonet::test {

namespace {

// 2^64 by the golden ratio: seeds of neighbouring numbers are far apart.
constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15;
constexpr int intervals = 60;

template <std::size_t n>
double one_of(Random& random, const std::array<double, n>& values) {
  return values[static_cast<std::size_t>(random.below(static_cast<int>(n)))];
}

/// The parameters of a law as text for a netlist, in SI.
std::string parameters(Random& random, const std::string& type) {
  std::string text;
  const auto add = [&](const char* name, double value) { text += fmt::format(", {} = {}", name, value); };
  const double stiffness = random.around(20, 3), damping = random.around(1.5, 3), coulomb = random.around(1, 2.5);
  const double exponent = one_of<5>(random, {0, 0.5, 1, 1.5, 2}), index = one_of<5>(random, {0.5, 0.7, 1.4, 1.75, 2});
  if (type == "spring" || type == "sfm" || type == "vfm" || type == "cfm") add("stiffness", stiffness);
  if (type == "dashpot" || type == "vfm" || type == "cfm") add("damping", damping);
  if (type == "slider" || type == "sfm" || type == "cfm") add("coulomb", coulomb);
  if (type == "sfm" || type == "cfm") add("exponent", exponent);
  if (type == "stop") {
    const int bounds = random.below(3);
    if (bounds != 1) add("lower", -random.around(0.03, 3));
    if (bounds != 2) add("upper", random.around(0.03, 3));
    add("stiffness", 3 * stiffness);
    if (random.below(2) == 0) add("damping", 0.5 * damping);
  }
  if (type == "dashpot" && random.below(5) < 2) add("flow_index", index);
  if (type == "slider" && random.below(3) == 0) add("breakaway", coulomb * random.uniform(1.05, 1.6));
  return text;
}

/// Ratio and support of a gear. A gear between a node and ground needs a moving support, otherwise it fixes the node.
std::string gear(Random& random, const Graph& graph, const Graph::Branch& ends) {
  std::string text = fmt::format(", ratio = {}", random.sign() * random.around(1, 2.5));
  std::vector<int> others;
  for (int n = 1; n < graph.nodes; ++n) {
    if (n != ends.a && n != ends.b) others.push_back(n);
  }
  const bool grounded = ends.a == 0 || ends.b == 0;
  if (!others.empty() && (grounded || random.below(3) == 0)) text += fmt::format(", support = \"{}\"", node_name(others[static_cast<std::size_t>(random.below(static_cast<int>(others.size())))]));
  return text;
}

/// Efficiencies in both directions, and perhaps a friction of the bearings.
std::string losses(Random& random) {
  std::string text = fmt::format(", efficiency = [{}, {}]", random.uniform(0.6, 0.97), random.uniform(0.6, 0.97));
  return random.below(3) == 0 ? text + fmt::format(", bearing = {}", random.around(0.2, 2)) : text;
}

/// Sun, carrier and ring of a planetary gear: those of the branch are the sun and the ring.
std::string planetary(Random& random, const Graph& graph, const Graph::Branch& ends) {
  int carrier = random.below(graph.nodes);
  while (carrier == ends.a || carrier == ends.b) carrier = (carrier + 1) % graph.nodes;
  return fmt::format("between = [\"{}\", \"{}\", \"{}\"], ratio = {}", node_name(ends.a), node_name(carrier), node_name(ends.b), random.around(1.5, 2));
}

/// A slider with Stribeck's curve.
std::string stribeck(Random& random) {
  const double coulomb = random.around(1, 2.5);
  return fmt::format(", coulomb = {}, breakaway = {}, stribeck = {}, shape = {}", coulomb, coulomb * random.uniform(1.1, 1.8),
                     random.around(0.3, 3), one_of<4>(random, {1, 2, 2, 3}));
}

std::string periodic(const char* shape, double amplitude, double frequency) {
  return fmt::format("{{ {} = {}, frequency = {} }}", shape, amplitude, frequency);
}

/// A piecewise linear table from `first` at 0, with extremes of alternating sign; `jumps`: one segment is a step.
std::string table(Random& random, double amplitude, double first, double stop, bool jumps) {
  std::string points = fmt::format("[0, {}]", first);
  const int count = 5;
  for (int k = 1; k <= count; ++k) {
    const double t = stop * (k - random.uniform(0.1, 0.5)) / count;
    const double x = amplitude * (k % 2 == 0 ? -1 : 1) * random.uniform(0.4, 1);
    if (jumps && k == 3) points += fmt::format(", [{}, {}]", t, -0.37 * x);
    points += fmt::format(", [{}, {}]", t, x);
  }
  return "{ table = [" + points + "] }";
}

std::string signal(Random& random, Wiring::Drive drive, double stop) {
  const double frequency = random.uniform(1.5, 3) / stop, sign = random.sign();
  const int shape = random.below(5);
  if (drive == Wiring::Drive::position) {
    // No steps: a dashpot would respond to a step of a position with an impulse.
    const double reach = sign * random.around(0.12, 2);
    if (shape < 2) return periodic("sine", reach, frequency);
    if (shape < 4) return periodic("triangle", reach, frequency);
    return table(random, reach, 0, stop, false);
  }
  const double amplitude = sign * random.around(1, 2);
  if (shape == 0) return periodic("sine", amplitude, frequency);
  if (shape == 1) return periodic("cosine", amplitude, frequency);
  if (shape == 2) return periodic("square", amplitude, frequency);
  if (shape == 3) return periodic("triangle", amplitude, frequency);
  return table(random, amplitude, -0.3 * amplitude, stop, true);
}

}  // namespace

namespace {

/// A varying bound of about `size`, which may fall below 0.
std::string bound(Random& random, double size, double stop) {
  const double mean = size * random.uniform(0.3, 1.2), swing = size * random.uniform(0.3, 1) * random.sign(), frequency = random.uniform(1, 3) / stop;
  const int shape = random.below(4);
  if (shape == 3) return table(random, size, size * random.uniform(0, 1), stop, true);
  return fmt::format("{{ {} = {}, frequency = {}, offset = {} }}", shape == 0 ? "sine" : shape == 1 ? "triangle" : "square", swing, frequency, mean);
}

/// Parameters of a slider whose bounds vary.
std::string brake(Random& random, double stop) {
  const double coulomb = random.around(1, 2.5), coefficient = random.uniform(0.2, 0.9), peak = random.uniform(1.05, 1.6);
  std::string text;
  switch (random.below(4)) {
    case 0:
      text = fmt::format(", coulomb = {}", bound(random, coulomb, stop));
      break;
    case 1:
      text = fmt::format(", coulomb = {}, breakaway = {}", coulomb, bound(random, 2 * coulomb, stop));
      break;
    case 2:
      text = fmt::format(", coulomb = {}, normal = {}", coefficient, bound(random, coulomb / coefficient, stop));
      break;
    default:
      text = fmt::format(", coulomb = {}", bound(random, coefficient, stop));
      text += fmt::format(", normal = {}", bound(random, coulomb / coefficient, stop));
  }
  return random.below(3) == 0 && text.find("breakaway") == std::string::npos ? text + fmt::format(", peak = {}", peak) : text;
}

}  // namespace

std::string netlist_of(const Wiring& wiring) { return netlist_of(wiring, wiring.graph); }

std::string netlist_of(const Wiring& wiring, const Graph& graph) {
  Random random(golden_ratio * static_cast<std::uint64_t>(wiring.number + 1));
  const double stop = random.uniform(0.8, 1.2);
  std::string text = fmt::format("title = \"wiring {}: {}\"\n", wiring.number, wiring.name);
  // If the driven node turns, all do.
  const bool turned = !wiring.rotating.empty() && wiring.rotating[1];
  if (turned) text += "domain = \"rotation\"\n";
  text += "\n[elements]\n";
  const bool by_force = wiring.drive == Wiring::Drive::force || wiring.drive == Wiring::Drive::force_on_mass;
  text += fmt::format("drive = {{ type = \"{}\", at = \"end\", {} = {} }}\n", !by_force ? "motion" : turned ? "torque" : "force",
                      by_force                                  ? (turned ? "torque" : "force")
                      : wiring.drive == Wiring::Drive::velocity ? "velocity"
                                                                : "position",
                      signal(random, wiring.drive, stop));
  for (std::size_t k = 0; k < wiring.types.size(); ++k) {
    const bool varies = wiring.types[k] == "brake";
    // Two sliders that hold a gear break away together, but in the reference each breaks away at its own bound. So do two of which
    // one has Stribeck's curve, where a drive jumps.
    const bool plain = std::any_of(wiring.types.begin(), wiring.types.end(), [](const std::string& type) {
      return type == "gear" || type == "lossy" || type == "stribeck" || type == "planetary" || type == "rack" || type == "screw";
    });
    std::string type = wiring.types[k];
    auto [a, b] = graph.branches[k];
    if (type == "planetary") {
      text += fmt::format("e{} = {{ type = \"planetary\", {} }}\n", k + 1, planetary(random, graph, graph.branches[k]));
      continue;
    }
    if (type == "rack" || type == "screw") {
      const std::string size = type == "rack" ? fmt::format("radius = {}", random.around(0.8, 2)) : fmt::format("lead = {}", random.sign() * random.around(5, 2));
      text += fmt::format("e{} = {{ type = \"{}\", between = [\"{}\", \"{}\"], {} }}\n", k + 1, type, node_name(a), node_name(b), size);
      continue;
    }
    std::string values = varies              ? brake(random, stop)
                         : type == "gear"    ? gear(random, graph, graph.branches[k])
                         : type == "lossy"   ? gear(random, graph, graph.branches[k]) + losses(random)
                         : type == "stribeck" ? stribeck(random)
                                             : parameters(random, type);
    if (plain && type != "stribeck") values = values.substr(0, values.find(", breakaway"));
    if (random.below(2) == 0) std::swap(a, b);
    if (varies || type == "stribeck") type = "slider";
    if (type == "lossy") type = "gear";
    text += fmt::format("e{} = {{ type = \"{}\", between = [\"{}\", \"{}\"]{} }}\n", k + 1, type, node_name(a), node_name(b), values);
  }
  for (std::size_t n = 1; n < wiring.massive.size(); ++n) {
    const double mass = random.around(0.03, 3);
    if (wiring.massive[n]) {
      const char* kind = !wiring.rotating.empty() && wiring.rotating[n] ? "inertia" : "mass";
      text += fmt::format("m_{0} = {{ type = \"{1}\", at = \"{0}\", {1} = {2} }}\n", node_name(static_cast<int>(n)), kind, mass);
    }
  }
  return text + fmt::format("\n[simulate]\nstop = {}\naccuracy = 1e-6\noutput = {{ points = {} }}\n", stop, intervals + 1);
}

}  // namespace rheonet::test
