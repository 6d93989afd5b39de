#include "tools/bench/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <vector>

namespace rheonet::bench {
namespace {

std::string simulate(const char* stop, int points, const char* record, const char* accuracy = "1e-6") {
  return fmt::format("[simulate]\nstop = \"{}\"\naccuracy = {}\noutput = {{ points = {} }}\nrecord = [\"{}\"]\n", stop, accuracy,
                     points, record);
}

/// Portable, unlike the distributions of the standard library: below `count`.
int draw(std::mt19937& random, int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); }

/// A group of so many elements, or one of them, as a member of a group.
void member(std::string& text, std::mt19937& random, int elements, bool series) {
  const auto out = std::back_inserter(text);
  if (elements == 1) {
    const int size = 1 + draw(random, 9);
    if (draw(random, 2) == 0)
      fmt::format_to(out, "{{ type = \"spring\", stiffness = \"{} kN/m\" }}", size);
    else
      fmt::format_to(out, "{{ type = \"dashpot\", damping = \"{} kN*s/m\" }}", size);
    return;
  }
  const int parts = std::min(elements, 2 + draw(random, 4));
  std::vector<int> cuts{0, elements};
  while (static_cast<int>(cuts.size()) <= parts) {
    const int cut = 1 + draw(random, elements - 1);
    if (std::find(cuts.begin(), cuts.end(), cut) == cuts.end()) cuts.push_back(cut);
  }
  std::sort(cuts.begin(), cuts.end());
  fmt::format_to(out, "{{ {} = [", series ? "series" : "parallel");
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    if (k > 1) text += ", ";
    member(text, random, cuts[k] - cuts[k - 1], !series);
  }
  text += "] }";
}

}  // namespace

std::string maxwell() {
  return R"([elements]
hand = { type = "motion", at = "a", velocity = { sine = "1 m/s", frequency = "1 Hz" } }
k = { type = "spring", between = ["a", "mid"], stiffness = "1000 N/m" }
c = { type = "dashpot", between = ["mid", "ground"], damping = "50 N*s/m" }
)" + simulate("10 s", 101, "k.force");
}

std::string stick_slip() {
  return R"([elements]
hand = { type = "motion", at = "a", velocity = "0.1 m/s" }
k = { type = "spring", between = ["a", "x"], stiffness = "10 N/m" }
m = { type = "mass", at = "x", mass = "1 kg" }
s = { type = "slider", between = ["x", "ground"], coulomb = "1 N", breakaway = "1.5 N" }
)" + simulate("100 s", 101, "x.position");
}

std::string ladder(int masses) {
  return fmt::format(R"([elements]
push = {{ type = "force", at = "x0", force = "1 N" }}
[elements.chain]
type = "cell"
between = ["x0", "ground"]
repeat = {{ count = {}, as = "i", arrange = "series" }}
[models.cell]
ports = ["a", "b"]
[models.cell.elements]
m = {{ type = "mass", at = "a", mass = "1 g" }}
k = {{ type = "spring", between = ["a", "b"], stiffness = "1 kN/m" }}
c = {{ type = "dashpot", between = ["a", "b"], damping = "1 N*s/m" }}
)", masses) + simulate("0.1 s", 101, "x0.position");
}

std::string written_out(int elements) {
  std::string text = "[elements]\npush = { type = \"force\", at = \"x0\", force = \"1 N\" }\n";
  const auto out = std::back_inserter(text);
  for (int i = 0; i < elements / 2; ++i) {
    const std::string next = i + 1 < elements / 2 ? fmt::format("x{}", i + 1) : "ground";
    fmt::format_to(out, "m{} = {{ type = \"mass\", at = \"x{}\", mass = \"1 g\" }}\n", i, i);
    fmt::format_to(out, "k{} = {{ type = \"spring\", between = [\"x{}\", \"{}\"], stiffness = \"{} N/m\" }}\n", i, i, next, 1000 + i % 7);
  }
  return text + simulate("1 us", 2, "x0.position");
}

std::string iwan(int pairs) {
  return fmt::format(R"([elements]
m = {{ type = "mass", at = "x", mass = "1 kg" }}
f = {{ type = "force", at = "x", force = {{ sine = "8 N", frequency = "1 Hz" }} }}
[elements.bundle]
between = ["x", "ground"]
repeat = {{ count = {}, as = "i", arrange = "parallel" }}
series = [
  {{ name = "k", type = "spring", stiffness = "400/n" }},
  {{ name = "s", type = "slider", coulomb = "20*(i + 0.5)/n^2" }},
]
)", pairs) + simulate("3 s", 101, "x.position");
}

std::string couette(int layers) {
  return fmt::format(R"([parameters]
n = {}
[elements]
plate = {{ type = "motion", at = "top", velocity = {{ sine = "1 m/s", frequency = "1 Hz" }} }}
oil = {{ type = "layer", between = ["top", "ground"], c = "2*n", m = "1/n", repeat = {{ count = "n", arrange = "series" }} }}
[models.layer]
ports = ["a", "b"]
parameters = {{ c = "1 N*s/m", m = "1 kg" }}
[models.layer.elements]
c1 = {{ type = "dashpot", between = ["a", "mid"], damping = "c" }}
m1 = {{ type = "mass", at = "mid", mass = "m" }}
c2 = {{ type = "dashpot", between = ["mid", "b"], damping = "c" }}
)", layers) + simulate("2 s", 101, "plate.force");
}

std::string tree(int elements) {
  std::mt19937 random(7);
  std::string group;
  member(group, random, elements, true);
  group.front() = ' ';
  return "[elements]\nhand = { type = \"motion\", at = \"a\", velocity = { sine = \"1 mm/s\", frequency = \"1 Hz\" } }\n"
         "net = { between = [\"a\", \"ground\"], " + group + "\n" + simulate("2 s", 101, "hand.force");
}

std::string grid(int side) {
  std::mt19937 random(1);
  std::string text = "[elements]\nhand = { type = \"motion\", at = \"hand\", velocity = { sine = \"0.1 m/s\", frequency = \"1 Hz\" } }\n";
  const auto out = std::back_inserter(text);
  const auto join = [&](const std::string& name, const std::string& a, const std::string& b) {
    fmt::format_to(out, "k{} = {{ type = \"spring\", between = [\"{}\", \"{}\"], stiffness = \"1 kN/m\" }}\n", name, a, b);
    fmt::format_to(out, "c{} = {{ type = \"dashpot\", between = [\"{}\", \"{}\"], damping = \"5 N*s/m\" }}\n", name, a, b);
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const std::string here = fmt::format("x{}-{}", i, j);
      fmt::format_to(out, "m{}-{} = {{ type = \"mass\", at = \"{}\", mass = \"1 kg\" }}\n", i, j, here);
      fmt::format_to(out, "s{}-{} = {{ type = \"slider\", between = [\"{}\", \"ground\"], coulomb = \"{} mN\" }}\n", i, j, here,
                     500 + draw(random, 1000));
      if (j == 0) join(fmt::format("h{}", i), "hand", here);
      if (j + 1 < side) join(fmt::format("r{}-{}", i, j), here, fmt::format("x{}-{}", i, j + 1));
      if (i + 1 < side) join(fmt::format("d{}-{}", i, j), here, fmt::format("x{}-{}", i + 1, j));
    }
  return text + simulate("1 s", 11, "hand.force", "1e-4");
}

}  // namespace rheonet::bench
