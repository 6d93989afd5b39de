// Keys of elements by the names that they have elsewhere.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "core/network/component.hpp"
#include "tests/netlist/reading.hpp"

namespace rheonet::test::other_names_test {

TEST_CASE("a parameter that is given by another name, or by the symbol of its law, is named") {
  struct Called { const char *element, *key, *name; };
  for (const auto& [element, key, name] : {Called{R"(type = "spring", between = ["a", "ground"])", "k", "stiffness"},
                                           {R"(type = "dashpot", between = ["a", "ground"])", "c", "damping"},
                                           {R"(type = "dashpot", between = ["a", "ground"])", "d", "damping"},
                                           {R"(type = "mass", at = "a")", "m", "mass"},
                                           {R"(type = "inertia", at = "a")", "J", "inertia"},
                                           {R"(type = "slider", between = ["a", "ground"], normal = 2)", "mu", "coulomb"},
                                           {R"(type = "slider", between = ["a", "ground"], coulomb = 2)", "static", "breakaway"},
                                           {R"(type = "sfm", between = ["a", "ground"], stiffness = 1)", "Fc", "coulomb"}}) {
    CAPTURE(element);
    const ReadResult result = read_scene_text(fmt::format("[elements]\ne = {{ {}, {} = 3 }}\n[simulate]\nstop = 1\n", element, key), "scene.toml", "no-such-folder", declarations(), {});
    CHECK(messages(result).find(fmt::format("`{}` is called `{}` here", key, name)) != std::string::npos);
    CHECK(messages(result).find(fmt::format("needs `{}`", name)) == std::string::npos);
  }
  const ReadResult both = read_scene_text("[elements]\ne = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1, k = 3 }\n[simulate]\nstop = 1\n", "scene.toml", "no-such-folder", declarations(), {});
  CHECK(messages(both).find("unknown key `k` of a `spring`") != std::string::npos);
  CHECK(messages(both).find("`k` is called `stiffness` here, which is given too") != std::string::npos);
}

TEST_CASE("a key of [simulate], of a signal or of the scene that is given by another name is named") {
  const ReadResult result = read_scene_text(R"([elements]
pull = { type = "force", at = "a", force = { sine = 1, frequency = 3, start = 2 } }
body = { type = "mass", at = "a", mass = 3 }
[initial]
a = { position = 1 }
[simulate]
end = 4
tolerance = 1e-4
output = { dt = 0.1 }
)", "scene.toml", "no-such-folder", declarations(), {});
  for (const auto& [key, name] : {std::pair{"start", "time"}, {"initial", "nodes"}, {"end", "stop"}, {"tolerance", "accuracy"}, {"dt", "every"}})
    CHECK(messages(result).find(fmt::format("`{}` is called `{}` here", key, name)) != std::string::npos);
  CHECK(messages(result).find("needs") == std::string::npos);
}

TEST_CASE("elements without the line [elements] are told once") {
  const ReadResult result = read_scene_text("a = { type = \"mass\", at = \"x\", mass = 1 }\nb = { type = \"mass\", at = \"y\", mass = 1 }\n[simulate]\nstop = 1\n", "scene.toml", "no-such-folder", declarations(), {});
  CHECK(messages(result) == "scene.toml:1:1: error: `a` is an element, but no line [elements] stands above it\n"
                            "    1 | a = { type = \"mass\", at = \"x\", mass = 1 }\n      | ^\n  write [elements] above the elements\n");
}

TEST_CASE("a CSV file that is given as a scene is named as one") {
  const ReadResult result = read_scene_text("time,x\n0,1\n", "rows.csv", "no-such-folder", declarations(), {});
  CHECK(messages(result).find("this is a CSV file") != std::string::npos);
}

}  // namespace rheonet::test::other_names_test
