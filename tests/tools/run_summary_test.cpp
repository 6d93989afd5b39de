// The summary of `run` as JSON.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::run_summary_test {

namespace {

nlohmann::json summary_of(const Folder& folder, const std::string& options, int status = 0) {
  CAPTURE(options);
  folder.shell("rheonet run scene.toml -q -o out.csv --summary s.json " + options, status);
  return nlohmann::json::parse(folder.read("s.json"));
}

}  // namespace

TEST_CASE("--summary has cost, energies, events, claims and notes as JSON") {
  const Folder folder(oscillator + R"([expect]
"k1.force" = { max = "0.1 N" }
"block.position" = { crosses = "1 m", at = "1 s" }
)");
  const auto summary = summary_of(folder, "", 1);
  CHECK(summary["scene"] == "scene.toml");
  CHECK(summary["start"] == 0);
  CHECK(summary["stop"] == 1);
  CHECK(summary["rows"] == 11);
  CHECK(summary["steps"] > 0);
  CHECK(summary["ended"] == nullptr);
  // A spring of 100 N/m that is let go from 1 mm.
  CHECK(std::abs(summary["energy_missing"].get<double>()) < 1e-10);
  REQUIRE(summary["claims"].size() == 2);
  CHECK(summary["claims"][0]["name"] == "largest k1.force");
  CHECK(summary["claims"][0]["found"].get<double>() == doctest::Approx(0.1));
  CHECK(summary["claims"][0]["unit"] == "N");
  CHECK(summary["claims"][0]["holds"] == true);
  CHECK(summary["claims"][1]["found"] == nullptr);  // it never crosses
  CHECK(summary["claims"][1]["holds"] == false);
  CHECK_FALSE(summary.contains("certificate"));
  CHECK_FALSE(summary.contains("sensitivities"));
  CHECK(folder.shell("rheonet run scene.toml -q -o out.csv --summary -", 1).out.starts_with("{\n"));
}

TEST_CASE("--summary counts the events of each element, and says when `stop_when` ended the run") {
  const Folder folder(switching);
  const auto summary = summary_of(folder, "--set simulate.stop_when='hand.velocity < 0'");
  CHECK(summary["ended"].get<double>() == doctest::Approx(0.25));
  CHECK(summary["switched"]["s1"] == 2);
}

TEST_CASE("--summary has the certificate and the derivatives, where they are asked for") {
  const Folder folder(oscillator);
  const auto certified = summary_of(folder, "--certify");
  CHECK(certified["certificate"]["holds"] == true);
  CHECK(certified["certificate"]["errors"]["k1.force"]["relative"] < 1e-4);
  const auto derived = summary_of(folder, "--sensitivities k1.stiffness");
  const auto& force = derived["sensitivities"]["k1.stiffness"]["k1.force"];
  CHECK(force["unit"] == "N");
  CHECK(force["largest"] > 0.1);
  CHECK(force["error"].get<double>() < 1e-5 * force["largest"].get<double>());
}

TEST_CASE("--summary: wrong names are refused, and an earlier file stays if the run fails") {
  const Folder folder(oscillator);
  folder.write("s.json", "earlier");
  const auto refused = [&](const std::string& options, const std::string& why) {
    CAPTURE(options);
    CHECK(contains(folder.shell("rheonet run scene.toml " + options, 2).err, why));
    CHECK(folder.read("s.json") == "earlier");
  };
  refused("--summary s.csv", "`--summary s.csv` is not a .json");
  refused("--summary no/s.json", "cannot write to");
  refused("--summary -", "`--output` and `--summary` both write to standard output");
  refused("--summary s.json --set simulate.accuracy=0", "accuracy");
  CHECK(contains(folder.shell("rheonet run scene.toml -q -o /dev/full --summary s.json", 1).err, "no summary is written to `s.json`"));
  CHECK(folder.read("s.json") == "earlier");
}

}  // namespace rheonet::test::run_summary_test
