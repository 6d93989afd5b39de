// Laws that a netlist defines.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::laws_test {

namespace {

const char* const lugre = R"_(
[laws.lugre]
parameters = { sigma0 = "1e5 N/m", sigma1 = "316.22776601683796 N*s/m", sigma2 = "0.4 N*s/m", Fc = "1 N", Fs = "1.5 N", vs = "1 mm/s" }
where      = { g = "Fc + (Fs - Fc)*exp(-(w/vs)^2)" }
states     = { z = { start = "0 m", rate = "w - sigma0*abs(w)*z/g" } }
force      = "sigma0*z + sigma1*rate(z) + sigma2*w"
stores     = "sigma0*z^2/2"
)_";

}  // namespace

// C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, IEEE Trans. Automat. Control 40 (1995) 419: a mass pulled by a spring,
// with the parameters of Table I. The positions come from an integration at 1e-12 by another program.
TEST_CASE("laws: stick-slip with LuGre") {
  const std::string toml = std::string(lugre) + R"(
[elements]
block = { type = "mass", at = "x", mass = 1 }
pull  = { type = "motion", at = "y", velocity = "0.1 m/s" }
k     = { type = "spring", between = ["y", "x"], stiffness = "2 N/m" }
rub   = { type = "lugre", between = ["x", "ground"] }
[simulate]
stop   = 20
output = { points = 5 }
record = ["x.position", "rub.force", "rub.power", "rub.energy", "rub.dissipated", "rub.z.out"]
)";
  const double known[] = {0, 0.0000164592, 0.6275831290, 0.9182797056, 1.2725964123};
  for (const double accuracy : {1e-5, 1e-7, 1e-9}) {
    Outcome run = outcome(toml, accuracy);
    const RunTable& rows = run.rows;
    for (std::size_t row = 0; row < 5; ++row) {
      CHECK_LE(std::abs(rows["x.position"][row] - known[row]), 10 * accuracy * known[4] + 1e-10);
      CHECK_LE(std::abs(rows["rub.energy"][row] - 1e5 * rows["rub.z.out"][row] * rows["rub.z.out"][row] / 2), 1e-12);
    }
  }
}

// z' = w (1 - z/D) while w > 0: z = D (1 - exp(-x/D)).
TEST_CASE("laws: Bouc-Wen's hysteresis, loaded at a constant velocity") {
  const double k = 3.1, D = 0.7, V = 0.37;
  for (const double s : {1.0, -1.0}) {
    const auto z = [=](double t) { return D * -std::expm1(-V * t / D); };
    const Expectations expected = {{"h.force", [=](double t) { return s * k * z(t); }}, {"h.energy", [=](double t) { return k * z(t) * z(t) / 2; }},
                                   {"h.dissipated", [=](double t) { return k * z(t) * V * (1 - std::exp(-V * t / D)); }},
                                   {"h.power", [=](double t) { return k * z(t) * V; }}};
    const std::string toml = netlist({{"V", s * V}}, R"(
[laws.bouc_wen]
parameters = { k = "1 N/m", D = "1 m" }
states     = { z = { start = "0 m", rate = "w - 0.5*abs(w)*z/D - 0.5*w*abs(z)/D" } }
force      = "k*z"
stores     = "k*z^2/2"
[elements]
m = { type = "motion", at = "x", velocity = "V" }
h = { type = "bouc_wen", between = ["x", "ground"], k = 3.1, D = 0.7 }
)", 2.9);
    check_at_all_accuracies(toml + record(expected), expected);
  }
}

TEST_CASE("laws: one that is a spring and a dashpot behaves as they do, in groups and models too") {
  const auto scene = [](const std::string& definition, const std::string& elements) {
    return simulate(definition + netlist({}, R"(
[nodes]
x = { position = 0.11, velocity = -0.7 }
[elements]
mass  = { type = "mass", at = "x", mass = 1.3 }
other = { type = "mass", at = "y", mass = 0.4 }
push  = { type = "force", at = "y", force = { sine = 3, frequency = 1.7 } }
)" + elements, 2.3) + "record = [\"x.position\", \"y.velocity\", \"e.force\", \"e.power\", \"e.energy\", \"e.dissipated\"]\n", 1e-9);
  };
  const std::string law = "[laws.kelvin]\nparameters = { k = \"40 N/m\", c = \"0.3 N*s/m\" }\nforce = \"k*d + c*w\"\nstores = \"k*d^2/2\"\n";
  const RunTable wired = scene("", "e = { between = [\"x\", \"y\"], parallel = [{ type = \"spring\", stiffness = 55 }, { type = \"dashpot\", damping = 0.3 }] }\n"
                                   "b = { type = \"spring\", between = [\"x\", \"ground\"], stiffness = 40 }\n");
  CHECK_LT(largest_error(scene(law, "e = { type = \"kelvin\", between = [\"x\", \"y\"], k = 55 }\n"
                                    "b = { type = \"kelvin\", between = [\"x\", \"ground\"], c = 0 }\n"), wired), 1e-7);
  CHECK_LT(largest_error(scene(law, "e = { between = [\"x\", \"y\"], parallel = [{ type = \"kelvin\", k = 25, c = 0.1 }, { type = \"kelvin\", k = 30, c = 0.2 }] }\n"
                                    "b = { type = \"spring\", between = [\"x\", \"ground\"], stiffness = 40 }\n"), wired), 1e-7);
}

// The last blocks of the chain begin to move by much less than round-off of the first: their bristles need not be resolved then.
TEST_CASE("laws: a chain of blocks on LuGre, pulled at one end") {
  const std::string toml = std::string(lugre) + R"(
[models.link]
ports = ["a", "b"]
[models.link.elements]
k     = { type = "spring", between = ["a", "b"], stiffness = "2000 N/m" }
block = { type = "mass", at = "b", mass = "0.1 kg" }
rub   = { type = "lugre", between = ["b", "ground"], Fc = "0.01 N", Fs = "0.015 N", sigma0 = "1e3 N/m", sigma1 = "3 N*s/m" }
[elements]
pull  = { type = "motion", at = "hand", velocity = "0.1 m/s" }
chain = { type = "link", between = ["hand", "end"], repeat = { count = 30 } }
[simulate]
stop   = 0.5
output = { points = 6 }
record = ["chain.node1.position", "chain.node15.position", "end.position", "chain.29.rub.force", "chain.0.rub.force"]
)";
  const RunTable fine = simulate(toml, 1e-9);
  CHECK(fine["end.position"].back() == doctest::Approx(0.0358763716).epsilon(1e-8));
  for (const double accuracy : {1e-4, 1e-6}) CHECK_LE(largest_error(simulate(toml, accuracy), fine), 3 * accuracy);
}

// The energy that it stores grows with the given motion, with its state, and with the time.
TEST_CASE("laws: the heat of one whose ends follow given motions") {
  const double k = 3.1, c = 0.7, A = 0.4, b = 0.9;
  const auto d = [=](double t) { return A * std::sin(b * t); };
  const auto w = [=](double t) { return A * b * std::cos(b * t); };
  const auto energy = [=](double t) { return k * d(t) * d(t) / 2 * (1 + t) + k * d(t) * d(t); };
  const Expectations expected = {
      {"e.energy", energy},
      {"e.power", [=](double t) { return (3 * k * d(t) + c * w(t)) * w(t); }},
      {"e.dissipated", [=](double t) { return c * w(t) * w(t) - k * d(t) * w(t) * t - k * d(t) * d(t) / 2; }}};
  for (const char* motion : {"position = { sine = \"A\", frequency = \"b/(2*pi)\" }", "velocity = { cosine = \"A*b\", frequency = \"b/(2*pi)\" }"}) {
    const std::string toml = netlist({{"k", k}, {"c", c}, {"A", A}, {"b", b}}, std::string(R"(
[laws.growing]
parameters = { k = "1 N/m", c = "1 N*s/m", T = "1 s" }
states     = { z = { start = "0 m", rate = "w" } }
force      = "k*d + 2*k*z + c*w"
stores     = "k*d^2/2*(1 + t/T) + k*z^2"
[elements]
e = { type = "growing", between = ["x", "ground"], k = "k", c = "c" }
m = { type = "motion", at = "x", )") + motion + " }\n", 2.9);
    check_at_all_accuracies(toml + record(expected), expected);
  }
}

TEST_CASE("laws: mistakes are told where they stand") {
  const auto says = [](const std::string& law, const std::string& words) {
    const std::string text = refusal(law + "\n[elements]\nm = { type = \"motion\", at = \"x\", velocity = \"1 m/s\" }\nh = { type = \"a\", between = [\"x\", \"ground\"] }\n[simulate]\nstop = 1\n");
    CHECK_MESSAGE(text.find(words) != std::string::npos, text);
  };
  says("[laws.a]\nforc = \"d\"", "scene.toml:2:1: error: unknown key `forc` of a law");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*d + w\"", "scene.toml:3:16: error: `force` of law `a`: `k*d` is a force (N), `w` is a velocity (m/s): they cannot be added (in `h`)");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*q*d\"", "`q`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nstates = { z = { start = \"0 m\" } }\nforce = \"k*z\"", "a state needs `rate`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nstates = { w = { start = \"0 m\", rate = \"w\" } }\nforce = \"k*d\"", "a state cannot be called `w`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*d\"\nstores = \"k*d\"", "energy");
  says("[laws.a]\nparameters = [\"k\", { d = 1 }]\nforce = \"k*d\"", "a parameter of a law cannot be called `d`");
  says("[laws.a]\nparameters = [\"w\"]\nforce = \"w*d\"", "a parameter of a law cannot be called `w`");
  says("[laws.a]\nparameters = [\"k\"]\nforce = \"k*d\"", "an `a` needs `k`");
  says("[laws.a]\ndomain = \"rotation\"\nforce = \"d\"", "scene.toml:2:10: error: the `domain` of a model or a law can only be `both`, but is `rotation`");
  says("[laws.a]\nparameters = { k = \"1 N/m\", d = 1 }\nforce = \"k*d\"", "a parameter of a law cannot be called `d`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nwhere = { k = \"2*d\" }\nforce = \"k*d\"", "`k` is a parameter of law `a`, and a state, an input or a name in `where` too");
  says("[laws.a]\nforce = \"0*d\"\n[laws.unused]\nforce = \"this is ( nonsense\"", "`force` of law `unused`");
  says("[laws.a]\nforce = \"d\"", "scene.toml:2:9: error: `force` of law `a`: expected a force (N), found a length (m) (in `h`)");
  says("[laws.spring]\nforce = \"d\"", "`spring` is an element type already");
}

// An unknown name and a wrong unit are reported once for a law, independent of the number of its elements.
TEST_CASE("laws: names and units in the expressions of a law") {
  const auto told = [](const std::string& law, const std::string& message) {
    CHECK_EQ(refusal("[parameters]\nmu = 0.3\n" + law + R"(
[elements]
m = { type = "motion", at = "x", velocity = "1 m/s" }
h = { type = "a", between = ["x", "ground"], repeat = { count = 3 } }
g = { type = "a", between = ["x", "ground"] }
[simulate]
stop = 1
)"), message);
  };
  const std::string known = "known here are `d`, `w`, `t`, `stiff`, `z` and `rate(z)`, and the [parameters] of the file\n";
  const std::string law = "[laws.a]\nparameters = { stiff = \"1 N/m\" }\nstates = { z = { start = \"0 m\", rate = \"w\" } }\n";
  told(law + "force = \"stiff*z + mu*stif*d\"", "scene.toml:6:23: error: `force` of law `a`: unknown name `stif`\n    6 | force = \"stiff*z + mu*stif*d\"\n      |                       ^\n  did you mean `stiff`? " + known);
  told(law + "force = \"stiff*z + sponge*d\"", "scene.toml:6:20: error: `force` of law `a`: unknown name `sponge`\n    6 | force = \"stiff*z + sponge*d\"\n      |                    ^\n  " + known);
  told(law + "force = \"stiff*z\"\nstores = \"N*z\"", "scene.toml:7:11: error: `stores` of law `a`: there is no parameter `N`, and a unit cannot stand in an expression\n    7 | stores = \"N*z\"\n      |           ^\n  " + known);
  told(law + "force = \"stiff*rate(d)\"", "scene.toml:6:16: error: `force` of law `a`: `rate` takes the name of a state\n    6 | force = \"stiff*rate(d)\"\n      |                ^\n  its states are `z`\n");
  told(law + "force = \"stiff*d + stiff*rate(z)\"", "scene.toml:6:20: error: `force` of law `a`: `stiff*d` is a force (N), `stiff*rate(z)` is a quantity in kg*m*s^-3: they cannot be added (in `h.0`)\n    6 | force = \"stiff*d + stiff*rate(z)\"\n      |                    ^\n");
  told("[laws.a]\nparameters = { stiff = \"1 N/m\" }\nstates = { z = { start = \"0 m\", rate = \"w + d\" } }\nforce = \"stiff*z\"",
       "scene.toml:5:45: error: `rate` of `z` of law `a`: `w` is a velocity (m/s), `d` is a length (m): they cannot be added (in `h.0`)\n    5 | states = { z = { start = \"0 m\", rate = \"w + d\" } }\n      |                                             ^\n");
  told("[laws.a]\nwhere = { p = \"q\", q = \"2*p\" }\nforce = \"p\"", "scene.toml:4:15: error: expressions of law `a` depend on each other in a circle: `p` -> `q` -> `p`\n    4 | where = { p = \"q\", q = \"2*p\" }\n      |               ^\n  one of them must do without the others; a state breaks a circle\n");
}

TEST_CASE("laws: an element by a law shows its motion, its force and its states, and no part of its inside") {
  const Scene scene = scene_of(std::string(lugre) + R"(
[elements]
m = { type = "motion", at = "x", velocity = "1 m/s" }
rub = { type = "lugre", between = ["x", "ground"] }
[simulate]
stop = 1
)");
  std::vector<std::string> paths;
  for (const Record& record : scene.records) paths.push_back(record.path);
  CHECK_EQ(paths, std::vector<std::string>{"x.position", "x.velocity", "m.force", "rub.z.out", "rub.force", "rub.displacement", "rub.velocity"});
}

// m v' = -c u v.
TEST_CASE("laws: inputs that are blocks, quantities of the network, signals and numbers") {
  const double m = 1.3, c = 0.7, v0 = 2.1, a = 3.1, t0 = 0.41;
  const std::string law = "\n[laws.drag]\nparameters = { c = 1 }\ninputs = [\"u\"]\nforce = \"c*u*w\"\n";
  const auto v = [=](double t) { return v0 * std::exp(-c * a * std::max(0.0, t - t0) * std::max(0.0, t - t0) / (2 * m)); };
  const auto u = [=](double t) { return a * std::max(0.0, t - t0); };
  const Expectations expected = {{"x.velocity", v}, {"e.force", [=](double t) { return c * u(t) * v(t); }}, {"e.dissipated", [=](double t) { return c * u(t) * v(t) * v(t); }}};
  const auto scene = [&](const std::string& definitions, const std::string& elements) {
    return netlist({{"m", m}, {"c", c}, {"v0", v0}, {"a", a}, {"t0", t0}}, definitions + R"(
[nodes]
x = { velocity = "v0" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
)" + elements, 2.7) + record(expected);
  };
  const std::string ramp = "{ ramp = \"a\", time = \"t0\" }", block = "b = { type = \"generator\", signal = " + ramp + " }\n";
  const std::string turned = "b = { type = \"generator\", signal = { ramp = \"-a\", time = \"t0\" } }\n";
  const std::string other = "y = { type = \"mass\", at = \"y\", mass = 1 }\np = { type = \"force\", at = \"y\", force = " + ramp + " }\n";
  const std::string drag = "e = { type = \"drag\", between = [\"x\", \"ground\"], c = \"c\", u = ";
  const std::vector<std::string> scenes{block + drag + "{ block = \"b\" } }\n", turned + drag + "{ block = \"-b\" } }\n", drag + ramp + " }\n", other + "e = { type = \"drag\", between = [\"x\", \"ground\"], c = \"0.7 s/m\", u = \"p.force\" }\n",
                                      block + "e = { type = \"drag\", between = [\"x\", \"ground\"], c = \"c/4\", u = { block = \"b\" }, repeat = { count = 4, arrange = \"parallel\" } }\n",
                                      "e = { type = \"drag\", between = [\"x\", \"ground\"], c = \"c/10\", u = { ramp = \"a*(i + 1)\", time = \"t0\" }, repeat = { count = 4, arrange = \"parallel\" } }\n",
                                      block + "e = { between = [\"x\", \"ground\"], parallel = [{ type = \"drag\", c = \"c/2\", u = { block = \"b\" } }, { type = \"drag\", c = \"c/2\", u = " + ramp + " }] }\n"};
  for (const std::string& elements : scenes) {
    CAPTURE(elements);
    check_at_all_accuracies(scene(law, elements), expected);
  }
  // Within a model the wire refers to elements of the model.
  check_at_all_accuracies(scene(law + R"(
[models.servo]
ports      = ["p", "q"]
parameters = { rise = 1, from = 0 }
[models.servo.elements]
b = { type = "generator", signal = { ramp = "rise", time = "from" } }
h = { type = "drag", between = ["p", "q"], c = 0.7, u = { block = "b" } }
)", "e = { type = \"servo\", between = [\"x\", \"ground\"], rise = \"a\", from = \"t0\" }\n"), expected);
}

// The stored energy depends on a prescribed motion and on an input.
TEST_CASE("laws: what is dissipated where the stored energy depends on motions and inputs that are given") {
  const double V = 0.37, k = 3.1, c = 0.7, a = 1.9;
  const Expectations expected = {{"h.force", [=](double t) { return k * V * t + c * V; }}, {"h.dissipated", [=](double t) { return c * V * V + 0 * t; }},
                                 {"g.energy", [=](double t) { return a * t * V * t; }}, {"g.dissipated", [=](double t) { return -a * V * t; }}};
  check_at_all_accuracies(netlist({{"V", V}}, R"(
[laws.kelvin]
parameters = { k = "3.1 N/m", c = "0.7 N*s/m" }
force  = "k*d + c*w"
stores = "k*d^2/2"
[laws.latch]
inputs = ["u"]
force  = "u"
stores = "u*d"
[elements]
m = { type = "motion", at = "x", velocity = "V" }
h = { type = "kelvin", between = ["x", "ground"] }
g = { type = "latch", between = ["x", "ground"], u = { ramp = "1.9 N/s" } }
)", 2.9) + record(expected), expected);
}

// The input jumps, and the force with it.
TEST_CASE("laws: a force jumps with an input of its law") {
  const double V = 0.37, c = 3.1;
  const auto u = [](double t) { return std::fmod(t, 1.0) < 0.5 ? 1.7 : -1.7; };
  const std::string toml = netlist({{"V", V}}, R"(
[laws.a]
parameters = { c = "3.1 N*s/m" }
inputs = ["u", "g"]
force  = "c*w + u*g"
[elements]
m = { type = "motion", at = "x", velocity = "V" }
k = { type = "spring", between = ["x", "ground"], stiffness = 5 }
h = { type = "a", between = ["x", "ground"], u = { square = 1.7, frequency = 1 }, g = "k.force" }
)", 2.9);
  const Expectations expected = {{"h.force", [=](double t) { return c * V + u(t) * 5 * V * t; }}};
  check_between(toml + record(expected), expected, {0.5, 1, 1.5, 2, 2.5});
}

TEST_CASE("laws: mistakes with inputs") {
  const auto told = [](const std::string& law, const std::string& element, const std::string& message) {
    CHECK_EQ(refusal("[laws.a]\nparameters = { k = \"1 N/m\" }\n" + law + "\n[elements]\nm = { type = \"motion\", at = \"x\", velocity = \"1 m/s\" }\nh = { type = \"a\", between = [\"x\", \"ground\"]" + element + " }\n[simulate]\nstop = 1\n"), message);
  };
  const std::string law = "inputs = [\"u\"]\nforce = \"k*d + u\"";
  const std::string line = "    7 | h = { type = \"a\", between = [\"x\", \"ground\"]";
  told(law, "", "scene.toml:7:1: error: an `a` needs `u`\n" + line + " }\n      | ^\n  u = { block = \"current\" }, a quantity of the network (\"motor.force\"), or a signal\n");
  told(law, ", u = \"m.forc\"", "scene.toml:7:53: error: `m` has no `forc`\n" + line + ", u = \"m.forc\" }\n      |                                                     ^\n  did you mean `m.force`?\n");
  told(law, ", u = { block = \"n\" }", "scene.toml:7:60: error: no block is called `n`\n" + line + ", u = { block = \"n\" } }\n      |                                                            ^\n  an input is a block (`controller`) or a quantity of the network (`drum.velocity`)\n");
  told(law, ", u = \"2 kg\"", "scene.toml:4:16: error: `force` of law `a`: `k*d` is a force (N), `u` is a mass (kg): they cannot be added (in `h`)\n    4 | force = \"k*d + u\"\n      |                ^\n");
  told(law, ", u = \"2 N\"", "");
  told(law, ", u = { step = \"2 N\", tim = 1 }", "scene.toml:7:66: error: unknown key `tim` of a `step` signal\n" + line + ", u = { step = \"2 N\", tim = 1 } }\n      |                                                                  ^\n  did you mean `time`?\n");
  told("inputs = \"u\"\nforce = \"k*d\"", "", "scene.toml:3:10: error: `inputs` must be an array, but is the string \"u\"\n    3 | inputs = \"u\"\n      |          ^\n  inputs = [\"u\"]\n");
  told("inputs = [\"w\"]\nforce = \"k*d\"", "", "scene.toml:3:11: error: an input cannot be called `w`\n    3 | inputs = [\"w\"]\n      |           ^\n  d, w, t and law have a meaning in every law\n");
  told("inputs = [\"k\"]\nforce = \"k*d\"", "", "scene.toml:2:16: error: `k` is a parameter of law `a`, and a state, an input or a name in `where` too\n    2 | parameters = { k = \"1 N/m\" }\n      |                ^\n  rename one of them\n");
  told("inputs = [\"type\"]\nforce = \"k*d*type\"", "", "scene.toml:3:11: error: an input cannot be called `type`\n    3 | inputs = [\"type\"]\n      |           ^\n  an element has a key of that name already\n");
}

// A mass that sticks to a moving belt has a relative velocity of exactly 0: its round-off does not switch `max` and `min` on and off.
TEST_CASE("laws: a contact with damping, held by a slider on a belt, switches when the contact closes") {
  const std::string scene = R"toml(
[laws.absorber]
parameters = { c = "1 N*s/m", k = "619 N/m", up = "0.03 m" }
force = "max(0, k*max(d - up, 0) + c*w)"
[elements]
m = { type = "mass", at = "n", mass = 1.0 }
belt = { type = "motion", at = "drv", velocity = { table = [[0, 0.0048], [1, -0.2061], [2, 0.2]] } }
s = { type = "slider", between = ["n", "drv"], coulomb = 1.0 }
b = { type = "sfm", between = ["n", "drv"], stiffness = 144, coulomb = 3 }
l = { type = "absorber", between = ["n", "drv"] }
[simulate]
stop = 2
output = { points = 201 }
record = ["n.velocity", "l.force"]
)toml";
  CHECK(outcome(scene, 1e-6).summary.steps < 500);
}

TEST_CASE("laws: `sgn`, and states called f and E") {
  const std::string toml = R"toml(
[laws.a]
parameters = { F0 = "1.3 N", T = "0.7 s" }
states = { f = { start = "0 N", rate = "(F0*sgn(w) - f)/T" }, E = { start = "0 N*s", rate = "f" } }
force = "f"
[elements]
pull = { type = "motion", at = "x", velocity = 0.4 }
l = { type = "a", between = ["x", "ground"] }
[simulate]
stop = 2
output = { points = 21 }
record = ["l.force", "l.E.out"]
)toml";
  Outcome run = outcome(toml, 1e-9);
  for (std::size_t row = 0; row < 21; ++row) {
    const double t = 0.1 * static_cast<double>(row);
    CHECK(std::abs(run.rows["l.force"][row] - 1.3 * -std::expm1(-t / 0.7)) < 1e-8);
    CHECK(std::abs(run.rows["l.E.out"][row] - 1.3 * (t + 0.7 * std::expm1(-t / 0.7))) < 1e-8);
  }
}

// Each of their wires was sought in the whole scene: 8,192 instances took three minutes to read.
TEST_CASE("six thousand instances of a law with a state are read in a time in proportion to them") {
  const ReadResult read = read_scene_text(R"toml([laws.a]
parameters = { B = "2 N*s/m", T = "0.7 s" }
states = { v = { start = "0 m/s", rate = "(w - v)/T" } }
force = "B*v"
[elements]
body = { type = "mass", at = "x", mass = 1 }
push = { type = "force", at = "x", force = 1 }
l = { type = "a", between = ["x", "ground"], repeat = { count = 6000, arrange = "parallel" } }
[simulate]
stop = 2
record = ["l.5999.force"]
)toml", "scene.toml", "no-such-folder", declarations(), {});
  REQUIRE(read.scene);
  CHECK(read.scene->sensed.size() >= 6000);
  CHECK(read.diagnostics.empty());
}

}  // namespace rheonet::test::laws_test
