#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::explain_test {

TEST_CASE("explain says what is solved, what is left out and why") {
  const Folder folder(pulled_slider + short_run);
  const std::string text = folder.shell("rheonet explain scene.toml", 0).out;
  CHECK(contains(text, "  dry friction `s1`\n"));
  CHECK(contains(text, "nothing here brings inertia, viscosity, contact, delay, feedback\n"));
  CHECK(contains(text, "node `mid`: nothing but a spring and a slider touch it"));
  CHECK(contains(text, "(--keep bundles)"));
  CHECK(contains(text, "  `s1`: stick, slip, reversal\n"));
  const std::string kept = folder.shell("rheonet explain scene.toml --keep bundles", 0).out;
  CHECK(contains(kept, "deflection of `k1`"));
  CHECK_FALSE(contains(kept, "node `mid`: nothing but"));
}

TEST_CASE("explain --json has the same for a program") {
  const Folder folder(oscillator);
  const nlohmann::json json = nlohmann::json::parse(folder.shell("rheonet explain scene.toml --json --without elasticity", 0).out);
  CHECK_EQ(json["title"], "let go");
  CHECK_EQ(json["effects"][0]["effect"], "inertia");
  CHECK_EQ(json["effects"][0]["brought_by"], nlohmann::json{"block_mass"});
  CHECK_EQ(json["effects"][1]["left_out_of"], nlohmann::json{"k1"});
  CHECK_EQ(json["structure"]["parts"], 1);
  CHECK_EQ(json["cost"]["unknowns"], 0);
}

TEST_CASE("effects and reductions on the command line") {
  const Folder folder(oscillator);
  // Without inertia the spring comes to its length at once.
  CHECK(contains(folder.shell("rheonet run scene.toml -q --without inertia", 0).out, "\n1,0,0\n"));
  CHECK(contains(folder.shell("rheonet run scene.toml -q --only elasticity", 0).out, "\n1,0,0\n"));
  const Finished none = folder.shell("rheonet run scene.toml --only none");
  CHECK_EQ(none.status, 0);
  const Finished wrong = folder.shell("rheonet run scene.toml --keep postions", 2);
  CHECK(contains(wrong.err, "`--keep`: there is no reduction `postions`\n  did you mean `positions`?"));
  CHECK(contains(folder.shell("rheonet run scene.toml --without inertai", 2).err, "did you mean `inertia`?"));
  CHECK(contains(folder.shell("rheonet run scene.toml --without inertia:k9", 2).err, "nothing is called `k9`"));
}

TEST_CASE("explain --numerics lists every numerical parameter once, with value, unit, meaning and reason") {
  const Folder folder(oscillator);
  std::istringstream text(folder.shell("rheonet explain --numerics", 0).out);
  const std::regex first("  ([a-z_]+) = ([-+.e0-9, ]+) \\[([^\\]]+)\\]"), sentence("    [A-Z(0-9].*[^ ]");
  std::map<std::string, std::string> value;
  std::map<std::string, int> count;
  for (std::string line; std::getline(text, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, first)) continue;  // a heading
    const std::string name = found[1], unit = found[3];
    INFO(name);
    ++count[name];
    value[name] = std::string(found[2]) + " " + unit;
    for (const char* field : {"meaning", "reason"}) {
      INFO(field);
      REQUIRE(std::getline(text, line));
      CHECK(std::regex_match(line, sentence));
    }
  }
  // The names as the list writes them.
  std::ifstream list(RHEONET_SOURCE_DIR "/core/base/numerics.def");
  const std::regex entry("NUMBER(?:\\([^,]*, |S\\()([a-z_]+),.*");
  std::size_t entries = 0;
  for (std::string line; std::getline(list, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, entry)) continue;
    ++entries;
    INFO(line);
    CHECK_EQ(count[found[1]], 1);
  }
  CHECK_GT(entries, 100);
  CHECK_EQ(count.size(), entries);
  CHECK_EQ(value["equal_velocities"], "1e-14 1");
  CHECK_EQ(value["torn_link_times"], "0.37, 0.83 1");
  CHECK_EQ(value["chatter_events"], "500 events");

  const nlohmann::json json = nlohmann::json::parse(folder.shell("rheonet explain --numerics --json", 0).out);
  CHECK_EQ(json.size(), entries);
  for (const nlohmann::json& one : json) {
    INFO(one["name"]);
    CHECK_GE(one["values"].size(), 1);
    for (const char* field : {"name", "unit", "meaning", "reason", "heading"}) CHECK_FALSE(one[field].get<std::string>().empty());
  }
  CHECK(contains(folder.shell("rheonet explain", 2).err, "SCENE"));
}

}  // namespace rheonet::test::explain_test
