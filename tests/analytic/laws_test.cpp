// Laws that a netlist defines.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

using namespace rheonet;
using namespace rheonet::test;

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
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*d + w\"", "scene.toml:3:16: error: the output of `h.f`: `k*d` is a force (N), `w` is a velocity (m/s)");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*q*d\"", "`q`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nstates = { z = { start = \"0 m\" } }\nforce = \"k*z\"", "a state needs `rate`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nstates = { w = { start = \"0 m\", rate = \"w\" } }\nforce = \"k*d\"", "a state cannot be called `w`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*d\"\nstores = \"k*d\"", "energy");
  says("[laws.a]\nparameters = [\"k\", { d = 1 }]\nforce = \"k*d\"", "a parameter of a law cannot be called `d`");
  says("[laws.a]\nparameters = [\"w\"]\nforce = \"w*d\"", "a parameter of a law cannot be called `w`");
  says("[laws.a]\nparameters = [\"k\"]\nforce = \"k*d\"", "an `a` needs `k`");
  says("[laws.a]\ndomain = \"rotation\"\nforce = \"d\"", "scene.toml:2:10: error: the `domain` of a model or a law can only be `both`, but is `rotation`");
  says("[laws.a]\nparameters = { k = \"1 N/m\", d = 1 }\nforce = \"k*d\"", "a parameter of a law cannot be called `d`");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nwhere = { k = \"2*d\" }\nforce = \"k*d\"", "`k` is a parameter of law `a`");
  says("[laws.a]\nforce = \"0*d\"\n[laws.unused]\nforce = \"this is ( nonsense\"", "`f` of law `unused`");
  says("[laws.spring]\nforce = \"d\"", "`spring` is an element type already");
  says("[laws.a]\nparameters = { k = \"1 N/m\" }\nforce = \"k*d\"\ninputs = [\"u\"]", "a law has no `inputs`");
}
