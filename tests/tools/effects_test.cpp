#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace rheonet::test::effects_test {

namespace {

// A light cart is drawn through oil by a stiff spring: its mass hardly matters, the oil does.
const std::string cart = R"([elements]
hand = { type = "motion", at = "hand", velocity = { sine = "0.2 m/s", frequency = "0.5 Hz" } }
k1 = { type = "spring", between = ["hand", "cart"], stiffness = 900 }
m1 = { type = "mass", at = "cart", mass = "1 g" }
oil = { type = "dashpot", between = ["cart", "ground"], damping = 30 }
[simulate]
stop = 4
output = { points = 41 }
record = ["k1.force"]
)";

}  // namespace

TEST_CASE("effects says what each effect contributes and what the scene can do without") {
  const Folder folder(cart);
  const Finished result = folder.shell("rheonet effects scene.toml --runs 1 -o effects.csv", 0);
  CHECK(contains(result.out, "with inertia, elasticity, viscosity\n"));
  CHECK(contains(result.out, "each effect left out by itself\n"));
  CHECK(contains(result.out, "to 1 % this scene needs elasticity, viscosity. Without inertia every record stays within 0."));
  const std::string csv = folder.read("effects.csv");
  CHECK(csv.starts_with("without,record,unit,largest_difference,time,rms_difference,largest_magnitude,cpu_median,steps,failure\n,k1.force,N,0,"));
  CHECK(contains(csv, "\ninertia,k1.force,N,"));
  CHECK(contains(csv, "\nviscosity,k1.force,N,"));
  CHECK(contains(csv, "\ninertia elasticity,k1.force,N,"));
  // Which effects matter depends on the accepted error.
  CHECK(contains(folder.shell("rheonet effects scene.toml --runs 1 --within 1e-9", 0).out, "this scene needs all that it has"));
}

TEST_CASE("effects says why a model cannot be simulated") {
  const Folder free(R"([elements]
pull = { type = "force", at = "cart", force = { sine = "1 N", frequency = "1 Hz" } }
m1 = { type = "mass", at = "cart", mass = "20 g" }
oil = { type = "dashpot", between = ["cart", "ground"], damping = 3 }
[simulate]
stop = 1
record = ["cart.velocity"]
)");
  const Finished result = free.shell("rheonet effects scene.toml --runs 1 -o -", 0);
  CHECK(contains(result.err, "without inertia, viscosity: nothing determines the motion of node `cart`"));
  CHECK(contains(result.out, "inertia viscosity,,,,,,,,,\"nothing determines the motion of node `cart`"));
}

TEST_CASE("a scene without any effect has nothing to weigh") {
  const Folder folder("[elements]\nhand = { type = \"motion\", at = \"hand\", velocity = 1 }\n[simulate]\nstop = 1\n");
  CHECK(contains(folder.shell("rheonet effects scene.toml", 0).out, "nothing in it brings an effect that could be left out"));
}

}  // namespace rheonet::test::effects_test
