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
  // Where the parameter is there too, its name is no help.
  const ReadResult both = read_scene_text("[elements]\ne = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1, k = 3 }\n[simulate]\nstop = 1\n", "scene.toml", "no-such-folder", declarations(), {});
  CHECK(messages(both).find("unknown key `k` of a `spring`") != std::string::npos);
  CHECK(messages(both).find("called") == std::string::npos);
}

}  // namespace rheonet::test::other_names_test
