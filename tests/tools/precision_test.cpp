#include <doctest/doctest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

using namespace rheonet::test;

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
  for (const std::string row : {"5,0.001,", "5,1e-06,", "5,1e-08,"}) {
    std::getline(rows, line);
    CHECK(line.starts_with(row));
  }
  CHECK_FALSE(std::getline(rows, line));
  CHECK(contains(folder.read("prices.svg"), "CPU time [s]"));
  CHECK(contains(folder.read("prices.svg"), "order up to 5"));

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
  const auto run = [&folder](const std::string& words) { return folder.shell("timeout 20 rheonet precision scene.toml " + words, 2).err; };
  CHECK(contains(run("--accuracies 1e-3,1e-13"), "`--accuracies` takes numbers from 1e-12 to 0.1, not `1e-13`"));
  CHECK(contains(run("--accuracies some"), "`--accuracies` takes a number such as 1e-6, not `some`"));
  CHECK(contains(run("--runs 0"), "`--runs` takes a whole number from 1 to 1000, not `0`"));
  CHECK(contains(run("--runs 2.5"), "`--runs` takes a whole number"));
  CHECK(contains(run("--plot prices.pdf"), "neither an .svg nor a .png"));
  CHECK(contains(run("-o scene.toml"), "would overwrite the scene itself"));
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
