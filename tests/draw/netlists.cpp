#include "tests/draw/netlists.hpp"

#include <fmt/format.h>

#include <random>

namespace rheonet::test {

std::string random_network(std::uint64_t seed, int nodes, int branches) {
  static const char* const types[] = {"\"spring\", stiffness = \"120 N/m\"",
                                      "\"dashpot\", damping = \"3 N*s/m\"",
                                      "\"slider\", coulomb = \"2 N\"",
                                      "\"sfm\", stiffness = \"35 N/m\", coulomb = \"4 N\", exponent = 2",
                                      "\"vfm\", stiffness = \"35 N/m\", damping = \"4 N*s/m\"",
                                      "\"force\", force = { sine = \"2 N\", frequency = \"3 Hz\" }"};
  std::mt19937_64 random(seed);
  const auto pick = [&random](int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); };
  const auto node = [](int n) { return n == 0 ? std::string("ground") : fmt::format("node_{}", n); };
  std::string text = "[elements]\n";
  for (int i = 0; i < branches; ++i) {
    const int a = i < nodes ? i + 1 : 1 + pick(nodes);
    int b = i < nodes ? pick(i + 1) : pick(nodes + 1);
    if (b == a) b = 0;
    const bool turned = pick(2) == 0;
    text += fmt::format("e{} = {{ between = [\"{}\", \"{}\"], type = {} }}\n", i, node(turned ? b : a),
                        node(turned ? a : b), types[pick(6)]);
  }
  for (int n = 1; n <= nodes; ++n) {
    if (pick(3) == 0)
      text += fmt::format("m{} = {{ type = \"mass\", at = \"node_{}\", mass = \"{} kg\" }}\n", n, n, 1 + pick(9));
    if (pick(6) == 0) text += fmt::format("f{} = {{ type = \"force\", at = \"node_{}\", force = \"2 N\" }}\n", n, n);
    if (pick(12) == 0)
      text += fmt::format("v{} = {{ type = \"motion\", at = \"node_{}\", velocity = \"2 m/s\" }}\n", n, n);
  }
  return text;
}

std::string random_blocks(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  const auto pick = [&random](int of) { return static_cast<int>(random() % static_cast<std::uint64_t>(of)); };
  const auto source = [&] {
    const int which = pick(count + 1);
    return (pick(4) == 0 ? "\"-" : "\"") + (which == count ? "sensor" : fmt::format("block_{}", which)) + '"';
  };
  std::string text =
      "[elements]\nm = { type = \"mass\", at = \"a\", mass = \"1 kg\" }\n"
      "sensor = { type = \"gain\", in = \"-a.position\", gain = 2 }\n";
  for (int i = 0; i < count; ++i) {
    static const char* const types[] = {"\"integrator\"", "\"lag\", time_constant = \"2 s\"", "\"gain\", gain = 3",
                                        "\"delay\", delay = \"1 s\"", "\"sum\""};
    const int kind = pick(6);
    if (kind == 5) {
      text += fmt::format("block_{} = {{ type = \"generator\", signal = 2 }}\n", i);
      continue;
    }
    std::string in = source();
    if (kind == 4) {
      in = "[" + in;
      for (int more = 1 + pick(3); more > 0; --more) in += ", " + source();
      in += "]";
    }
    text += fmt::format("block_{} = {{ type = {}, in = {} }}\n", i, types[kind], in);
  }
  for (int i = 0; i < pick(3); ++i)
    text +=
        fmt::format("f{} = {{ type = \"force\", at = \"a\", force = {{ block = \"block_{}\" }} }}\n", i, pick(count));
  return text;
}

std::string chain(int count) {
  return fmt::format(R"([elements]
chain = {{ type = "cell", between = ["a", "ground"], repeat = {{ count = {} }} }}
[models.cell]
ports = ["a", "b"]
[models.cell.elements]
m = {{ type = "mass", at = "a", mass = "1 kg" }}
k = {{ type = "spring", between = ["a", "b"], stiffness = "100 N/m" }}
)",
                     count);
}

std::string bundle(int count) {
  return fmt::format(R"([elements]
k = {{ type = "spring", between = ["a", "ground"], stiffness = "100 N/m", repeat = {{ count = {}, arrange = "parallel" }} }})",
                     count);
}

}  // namespace rheonet::test
