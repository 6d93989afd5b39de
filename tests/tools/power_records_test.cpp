#include <doctest/doctest.h>

#include "tests/support/program.hpp"

namespace rheonet::test::power_records_test {

namespace {

/// A dashpot and a spring in a drive of 2 m/s for 3 s.
const char* const dragged = R"([elements]
drive = { type = "motion", at = "a", velocity = "2 m/s" }
c = { type = "dashpot", between = ["a", "ground"], damping = "3 N*s/m" }
k = { type = "spring", between = ["a", "ground"], stiffness = "5 N/m" }
[simulate]
stop = "3 s"
output = { points = 4 }
record = ["a.acceleration", "c.dissipated", "k.energy", { name = "drag", value = "drive.force - k.force" }]
[expect]
drag = { max = "6 N" }
"k.energy" = { final = "90 J" }
[exact]
drag = "F"
"k.energy" = "K*v^2*t^2/2"
[parameters]
F = "6 N"
K = "5 N/m"
v = "2 m/s"
[plot]
y = ["drag", "k.energy"]
)";

}  // namespace

TEST_CASE("powers, energies and expressions by the command line") {
  const Folder folder(dragged);
  const Finished check = folder.shell("rheonet check scene.toml", 0);
  CHECK(contains(check.out + check.err, "no mistake found"));

  const Finished run = folder.shell("rheonet run scene.toml", 0);
  CHECK(contains(run.out, "time,a.acceleration,c.dissipated,k.energy,drag\n0,0,12,0,6\n1,0,12,10,6\n2,0,12,40,6\n3,0,12,90,6\n"));

  folder.shell("rheonet plot scene.toml -o figure.svg", 0);
  CHECK(contains(folder.read("figure.svg"), "energy"));
  folder.shell("rheonet run scene.toml -q -o rows.csv", 0);
  folder.shell("rheonet plot rows.csv -y k.energy -o rows.svg", 0);

  std::string stiffer = dragged;
  stiffer.replace(stiffer.find("5 N/m"), 1, "8");
  folder.write("stiffer.toml", stiffer);
  const Finished compare = folder.shell("rheonet compare scene.toml stiffer.toml", 0);
  CHECK(contains(compare.out, "k.energy                      54 J  3.75e-01  3 s"));
  CHECK(contains(compare.out, "drag                           0 N         0"));

  const Finished sweep = folder.shell("rheonet sweep scene.toml --vary k.stiffness=5:10:2 --measure 'max(k.energy)' --measure 'final(drag)' --measure 'mean(k.power)'", 0);
  CHECK(contains(sweep.out, "max(k.energy) [J]"));
  CHECK(contains(sweep.out, "final(drag) [N]"));
  CHECK(contains(sweep.out, "mean(k.power) [W]"));
  CHECK(contains(sweep.out, "1,5,90,6,"));
  CHECK(contains(sweep.out, "2,10,180,6,"));

  const Finished wrong = folder.shell("rheonet run scene.toml --set 'simulate.record=[{name=\"drag\", value=\"drive.force - k.energy\"}]'", 2);
  CHECK(contains(wrong.err, "they cannot be added"));
}

}  // namespace rheonet::test::power_records_test
