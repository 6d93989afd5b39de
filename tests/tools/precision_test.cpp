#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::precision_test {

TEST_CASE("precision prints what accuracy costs, writes it as CSV and draws it") {
  const Folder folder(oscillator);
  const Finished result =
      folder.shell("rheonet precision scene.toml --accuracies 1e-3,1e-8 --runs 3 -o prices.csv --plot prices.svg", 0);
  CAPTURE(result.out);
  CHECK(result.out.starts_with("scene.toml: 0 s to 1 s, asks for an accuracy of 1e-06\n"));
  CHECK(contains(result.out, "errors are measured by a run to 1e-12 of order up to 5; one of order up to 4 is "));
  CHECK(contains(result.out, "next digit: CPU"));
  CHECK(contains(result.out, "\n  0.001 "));
  CHECK(contains(result.out, "\n  1e-06 "));  // the scene's own is always among them
  CHECK(contains(result.out, "\n  1e-08 "));
  CHECK(contains(result.out, "the cheapest that meets the 1e-06 asked for: accuracy = "));
  CHECK(result.err == "");

  std::istringstream rows(folder.read("prices.csv"));
  std::string line;
  std::getline(rows, line);
  CHECK(line.starts_with("order,accuracy,error,record,time,cpu_median,"));
  CHECK(line.ends_with(",error block.position,error k1.force"));
  for (const std::string row : {"5,0.001,", "5,1e-06,", "5,1e-08,", "5,1e-08,"}) {
    std::getline(rows, line);
    CHECK(line.starts_with(row));
  }
  CHECK(contains(line, ",exact arcs,"));
  CHECK_FALSE(std::getline(rows, line));
  CHECK(contains(folder.read("prices.svg"), "CPU time [s]"));
  CHECK(contains(folder.read("prices.svg"), "order up to 5"));
  CHECK(contains(result.out, "\nexact arcs\n"));

  const Finished piped = folder.shell("rheonet precision scene.toml --accuracies 1e-2 --runs 1 --accuracy 1e-2 -o -", 0);
  CHECK(piped.out.starts_with("order,accuracy,"));
  CHECK(contains(piped.err, "accuracy = 0.01"));
}

TEST_CASE("precision --variants limits the order; `run --order` does the same") {
  const Folder folder(oscillator);
  const Finished result = folder.shell("rheonet precision scene.toml --variants --accuracies 1e-5 --runs 1 -o prices.csv", 0);
  for (const std::string order : {"4", "3", "2"}) {
    CAPTURE(order);
    CHECK(contains(result.out, "\norder up to " + order + "\n"));
    CHECK(contains(folder.read("prices.csv"), "\n" + order + ",1e-05,"));
  }
  const std::string usual = folder.shell("rheonet run -q scene.toml", 0).out;
  CHECK(folder.shell("rheonet run -q scene.toml --order 5", 0).out == usual);
  CHECK(folder.shell("rheonet run -q scene.toml --order 2", 0).out != usual);
}

TEST_CASE("precision --variants: what it costs to smooth sliders and not to look for events, and what that gets wrong") {
  const Folder folder(pulled_slider + short_run);
  const Finished result = folder.shell("rheonet precision scene.toml --variants --accuracies 1e-4,1e-6 --runs 1 -o prices.csv", 0);
  std::map<std::string, double> error;
  std::istringstream rows(folder.read("prices.csv"));
  std::string line;
  std::getline(rows, line);
  CHECK(contains(line, ",starts,manner,error k1.force"));
  while (std::getline(rows, line)) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (cells[1] == "0.0001") error[cells[cells.size() - 2]] = std::stod(cells[2]);
  }
  CHECK(error.at("order up to 5") <= 1e-4);
  CHECK(error.at("every slider smoothed below 0.01 of its fastest motion") > 1e-3);
  CHECK(error.at("every slider smoothed below 0.0001 of its fastest motion") < error.at("every slider smoothed below 0.01 of its fastest motion"));
  CHECK(contains(result.out, "\nevents at the ends of steps\n"));
  CHECK(contains(result.out, "the cheapest that meets the 1e-06 asked for: "));
}

namespace {

/// Rows of a list of prices as CSV: of each manner the error, at the tightest accuracy.
std::map<std::string, double> errors_in(const std::string& csv) {
  std::map<std::string, double> error;
  std::istringstream rows(csv);
  std::string line;
  std::getline(rows, line);
  const auto columns = std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(line.find(",manner")), ',') + 1;
  while (std::getline(rows, line)) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    error[cells[static_cast<std::size_t>(columns)]] = std::stod(cells[2]);
  }
  return error;
}

/// Each of these words is refused, and it says why.
void check_refused(const Folder& folder, const std::vector<std::pair<std::string, std::string>>& refused) {
  for (const auto& [words, why] : refused) {
    CAPTURE(words);
    CHECK(contains(folder.shell("timeout 20 rheonet precision scene.toml " + words, 2).err, why));
  }
}

// A spring in parallel with a spring and a slider in series, driven by x = a sin(w t).
const std::string bundle = R"([elements]
drive = { type = "motion", at = "p", position = { sine = "0.31 m", frequency = "1.7 Hz" } }
m = { type = "mass", at = "a", mass = 0.7 }
k = { type = "spring", between = ["p", "a"], stiffness = "K" }
k1 = { type = "spring", between = ["a", "b"], stiffness = 130 }
s1 = { type = "slider", between = ["b", "ground"], coulomb = 2.3 }
k2 = { type = "spring", between = ["a", "c"], stiffness = 70 }
s2 = { type = "slider", between = ["c", "ground"], coulomb = 3.1 }
[parameters]
K = 400
[simulate]
stop = 1.3
output = { points = 101 }
record = ["a.position", "k.force"]
)";

}  // namespace

TEST_CASE("precision --variants prices closed forms against states, and tells no difference beyond the accuracy") {
  const Folder folder(bundle);
  const Finished result = folder.shell("rheonet precision scene.toml --variants --accuracies 1e-5 --accuracy 1e-5 --runs 1 -o prices.csv", 0);
  const auto error = errors_in(folder.read("prices.csv"));
  CHECK(contains(result.out, "\nwithout the reduction `bundles`\n"));
  CHECK(error.at("without the reduction `bundles`") <= 1e-5);
  CHECK(error.at("order up to 5") <= 1e-5);
  CHECK_FALSE(contains(result.out, "reduction `chains`"));  // there is none to make
}

TEST_CASE("precision --variant: another scene, other values, and what they get wrong") {
  const Folder folder(bundle);
  // The same, wired otherwise: with the names turned about.
  std::string other = bundle;
  for (const auto& [from, to] : {std::pair{"\"a\"", "\"mass\""}, {"a.position", "mass.position"}}) {
    for (std::size_t at = 0; (at = other.find(from, at)) != other.npos; at += std::string(to).size()) other.replace(at, std::string(from).size(), to);
  }
  folder.write("other.toml", other);
  const std::string words = "rheonet precision scene.toml --accuracies 1e-6 --runs 1 -o prices.csv ";
  const Finished result = folder.shell(words + "--variant other.toml --pair a.position=mass.position --variant 'parameters.K=404' "
                                               "--variant 'other.toml; parameters.K=440; m.mass=0.8' --variant simulate.stop=1.1", 0);
  auto error = errors_in(folder.read("prices.csv"));
  CHECK(contains(result.out, "scene.toml: 0 s to 1.1 s,"));
  CHECK(contains(result.out, "\nparameters.K=404\n"));
  CHECK(error.at("order up to 5") <= 1e-6);
  CHECK(error.at("other.toml") <= 1e-6);
  CHECK(error.at("simulate.stop=1.1") <= 1e-6);
  CHECK(error.at("parameters.K=404") > 1e-3);
  CHECK(error.at("parameters.K=404") < 0.1);
  CHECK(error.at("\"other.toml; parameters.K=440; m.mass=0.8\"") > error.at("parameters.K=404"));
}

TEST_CASE("precision --variant refuses what cannot be priced beside the scene") {
  const Folder folder(bundle);
  folder.write("oscillator.toml", oscillator);
  check_refused(folder, {{"--variant no.toml", "in the variant `no.toml`"},
                         {"--variant something", "`something` is neither a scene nor a value"},
                         {"--variant parameters.Q=3", "in the variant `parameters.Q=3`"},
                         {"--variant oscillator.toml", "it has to have all that the scene records, or what `--pair` names"},
                         {"--variant oscillator.toml --pair a.position=k1.force --pair k.force=k1.force", "are different quantities"},
                         {"--variant scene.toml --pair b.position=a.position", "the scene does not record `b.position`"},
                         {"--variant scene.toml --pair k.force", "`--pair k.force` names 1 records, not two"},
                         {"--variant simulate.start=0.1", "the runs start at different times"}});
}

TEST_CASE("precision says when a closed form and the scene do not fit") {
  const Folder folder(oscillator + "[exact]\n\"block.position\" = \"1e-3*cos(10*t)\"\n");
  const std::string words = "rheonet precision scene.toml --accuracies 1e-3 --runs 1";
  const Finished fits = folder.shell(words, 0);
  CHECK(contains(fits.out, "errors of one record are measured by closed forms, from which a run to 1e-12 is off by up to "));
  CHECK_FALSE(contains(fits.out, "note:"));
  const Finished misfits = folder.shell(words + " --set k1.stiffness='\"101 N/m\"'", 0);
  CHECK(contains(misfits.out, "note: that is too much for rounding, first at "));
}

TEST_CASE("precision refuses what it cannot do before it simulates") {
  const Folder folder(endless);
  check_refused(folder, {{"--accuracies 1e-3,1e-13", "`--accuracies` takes numbers from 1e-12 to 0.1, not `1e-13`"},
                         {"--accuracies some", "`--accuracies` takes a number such as 1e-6, not `some`"},
                         {"--runs 0", "`--runs` takes a whole number from 1 to 1000, not `0`"},
                         {"--runs 2.5", "`--runs` takes a whole number"},
                         {"--plot prices.pdf", "neither an .svg nor a .png"},
                         {"-o scene.toml", "would overwrite the scene itself"}});
  CHECK(contains(folder.shell("rheonet run scene.toml --order 6", 2).err, "`--order` takes a whole number from 1 to 5, not `6`"));
  CHECK(contains(folder.shell("rheonet precision --help", 0).out, "Exit status"));
}

TEST_CASE("precision of a scene that fails or is interrupted has status 1") {
  const Folder folder(overcome);
  CHECK(contains(folder.shell("rheonet precision scene.toml", 1).err, "nothing resists the force at node `end`"));
  folder.write("endless.toml", endless);
  CHECK(contains(folder.shell("timeout --foreground --preserve-status -s INT 1 rheonet precision endless.toml", 1).err, "interrupted"));
  folder.write("short.toml", oscillator);
  CHECK(contains(folder.shell("rheonet precision short.toml --accuracies 1e-2 --runs 1 -o /dev/full", 1).err, "No space left"));
}

}  // namespace rheonet::test::precision_test
