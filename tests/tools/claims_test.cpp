// The output of `run` and `check` on [check] and [expect].
#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::claims_test {

namespace {

const std::string checked = oscillator + R"([parameters]
k = "100 N/m"
least = "50 N/m"
[check]
soft = { that = "k < least", warn = "too stiff for the hand" }
)";

}  // namespace

TEST_CASE("a check that fails is a warning of `run` and `check`, at its place; the run goes on") {
  const Folder folder(checked);
  for (const std::string command : {"run -q", "check"}) {
    CAPTURE(command);
    const Finished result = folder.shell("rheonet " + command + " scene.toml", 0);
    CHECK(contains(result.err, "warning: check `soft`: too stiff for the hand\n"));
    CHECK(contains(result.err, "`k < least` does not hold: k = 100 N/m, least = 50 N/m\n"));
    CHECK_FALSE(result.out.empty());
  }
  CHECK(folder.shell("rheonet run -q scene.toml --set parameters.k='49 N/m'", 0).err == "");
  folder.write("strict.toml", std::string(checked).replace(checked.find("warn"), 4, "error"));
  for (const std::string command : {"run", "check"})
    CHECK(contains(folder.shell("rheonet " + command + " strict.toml", 2).err, "error: check `soft`: too stiff"));
}

TEST_CASE("run says of each claim whether it holds, with the figures; status 1 if one fails") {
  const Folder folder(oscillator + R"([expect]
"k1.force" = [ { max = "0.1 N" }, { at = "0.3 s", value = "-0.0989992 N", within = 1e-5 } ]
"block.velocity" = { crosses = "0 m/s", from = "0.1 s", at = "0.314159 s", within = "1 us" }
"block.position" = { rms = ["0.7 mm", "0.8 mm"] }
)");
  const Finished good = folder.shell("rheonet run scene.toml -o out.csv", 0);
  CHECK(contains(good.err, "  holds: largest k1.force is 0.1 N, claimed 0.1 N within 1e-07 N\n"));
  CHECK(contains(good.err, "  holds: k1.force at 0.3 s is -0.0989992"));
  CHECK(contains(good.err, "  holds: time at which block.velocity crosses 0 m/s from 0.1 s is 0.314159"));
  CHECK(contains(good.err, "  holds: root mean square of block.position is 0.000"));
  CHECK(contains(good.err, " m, claimed between 0.0007 m and 0.0008 m\n"));
  // A claim adds no column.
  CHECK(folder.read("out.csv").starts_with("time,block.position,k1.force\n"));
  CHECK(folder.shell("rheonet run -q scene.toml -o out.csv", 0).err == "");
  CHECK(contains(folder.shell("rheonet check scene.toml", 0).out, "no mistake found (2 elements, 1 node, 4 claims)"));

  const std::string stiffer = " --set k1.stiffness='110 N/m'";
  const Finished bad = folder.shell("rheonet run -q scene.toml -o out.csv" + stiffer, 1);
  CHECK(bad.err.starts_with("scene.toml:"));
  CHECK(contains(bad.err,
                 ": error: the claim fails: largest k1.force is 0.11 N, claimed 0.1 N within 1.1e-07 N: it is "
                 "off by 0.01 N\n"));
  CHECK_FALSE(contains(bad.err, "root mean square"));
  CHECK(folder.read("out.csv").find("\n1,") != std::string::npos);        // all rows are there
  CHECK(folder.shell("rheonet check scene.toml" + stiffer).status == 0);  // nothing has been simulated
}

TEST_CASE("a claim that cannot be read has status 2, one on what never comes fails") {
  const Folder folder(oscillator + "[expect]\nk1.force = { crosses = \"1 N\", at = \"0.5 s\" }\n");
  CHECK(contains(folder.shell("rheonet run scene.toml", 1).err,
                 "time at which k1.force crosses 1 N never comes, claimed 0.5 s within 1e-06 s"));
  folder.write("bad.toml", oscillator + "[expect]\n\"k1.force\" = { max = \"1 m\" }\n");
  CHECK(folder.shell("rheonet check bad.toml").status == 2);
  CHECK(contains(folder.shell("rheonet check bad.toml").err, "expected a force (N), found a length (m)"));
}

}  // namespace rheonet::test::claims_test
