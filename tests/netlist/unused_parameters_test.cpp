// Warnings of parameters that no expression uses.

#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::unused_parameters_test {

namespace {

/// The warnings for a scene with a spring of stiffness `k` on a mass, with more tables after it.
std::string told(const std::string& parameters, const std::string& stiffness = "k", const std::string& more = "") {
  const ReadResult result = test::read("title = \"q and more\"\n[parameters]\n" + parameters + "\n[elements]\ns = { type = \"spring\", between = [\"q\", \"ground\"], stiffness = \"" +
                                       stiffness + "\" }\nm = { type = \"mass\", at = \"q\", mass = 1 }\n" + more);
  CHECK(result.scene);
  std::string text;
  for (const Diagnostic& d : result.diagnostics) {
    CHECK(d.severity == Severity::warning);
    text += std::to_string(d.spot.line) + ": " + d.message + "\n";
  }
  return text;
}

const char* const unused = "4: no expression uses parameter `q`: its value changes nothing\n";

}  // namespace

TEST_CASE("a warning names each parameter that no expression uses; names, titles and units are not expressions") {
  CHECK_EQ(told("k = 5\nq = 3"), unused);
  CHECK_EQ(told("k = \"5 N/m\"\nq = 3", "k", "[nodes]\nq = { velocity = \"3 m/s\" }\n[simulate]\nstop = 1\nrecord = [\"q.velocity\"]\n"), unused);
  CHECK_EQ(told("k = 5\nN = 3"), "4: no expression uses parameter `N`: its value changes nothing\n");
  CHECK_EQ(told("q = 5\nk = \"2*q\""), "");
  CHECK_EQ(told("k = 5\nq = 3", "k + q"), "");
  CHECK_EQ(told("k = 5\nq = 3", "k", "[check]\nsmall = { that = \"q < k\", warn = \"large\" }\n"), "");
  CHECK_EQ(told("k = 5\nq = 3", "k", "[check]\nsmall = { that = \"k > 0\", warn = \"q is large\" }\n"), unused);
  CHECK_EQ(told("k = 5\nq = 3", "k", "[simulate]\nstop = \"q\"\n"), "");
  CHECK_EQ(told("k = 5\nq = 3", "k", "[expect]\n\"m.force\" = { at = \"q/10\", value = 0, within = 1 }\n"), "");
}

TEST_CASE("an expression on the command line uses a parameter") {
  const std::string scene = "[parameters]\nk = 3\n[elements]\ns = { type = \"spring\", between = [\"q\", \"ground\"], stiffness = 2 }\n"
                            "m = { type = \"mass\", at = \"q\", mass = 1 }\n";
  ReadOptions options;
  CHECK(test::read(scene, options).diagnostics.size() == 1);
  options.overrides = {"s.stiffness=2*k"};
  CHECK(test::messages(test::read(scene, options)) == "");
  options.overrides = {};
  options.measures = {"time of crossing(s.force, k)"};
  CHECK(test::messages(test::read(scene, options)) == "");
}

TEST_CASE("a warning names each parameter of a model that its elements do not use") {
  const auto model = [](const std::string& parameters, const std::string& rest) {
    return "[models.post]\nports = [\"a\"]\nparameters = " + parameters + "\n[models.post.elements]\nk = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"" + rest + "\" }\n";
  };
  CHECK_EQ(told("k = 5", "k", model("{ s = 1, r = 2 }", "s")), "9: no expression of model `post` uses parameter `r`: its value changes nothing\n");
  CHECK_EQ(told("k = 5", "k", model("[\"s\", \"r\"]", "s")), "9: no expression of model `post` uses parameter `r`: its value changes nothing\n");
  CHECK_EQ(told("k = 5", "k", model("[\"s\", { r = 2 }]", "s")), "9: no expression of model `post` uses parameter `r`: its value changes nothing\n");
  CHECK_EQ(told("k = 5", "k", model("[\"s\", { r = \"2*s\" }]", "r")), "");
  CHECK_EQ(told("k = 5", "k", model("{ s = 1, r = 2 }", "s*r")), "");
  CHECK_EQ(told("k = 5", "k", model("{ s = \"2*r\", r = 2 }", "s")), "");
}

}  // namespace rheonet::test::unused_parameters_test
