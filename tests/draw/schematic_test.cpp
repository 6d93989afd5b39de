#include "tools/draw/schematic.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "core/network/component.hpp"
#include "tests/analytic/random_tree.hpp"
#include "tests/draw/drawn.hpp"
#include "tests/draw/netlists.hpp"
#include "tests/support/program.hpp"
#include "tests/support/xml.hpp"
#include "tools/plot/mistake.hpp"

namespace rheonet::test::schematic_test {

using namespace rheonet::draw;

namespace {

Picture drawn(const Scene& scene) { return schematic(scene, {.title = scene.title}); }

/// The symbols of some elements.
std::vector<Mark> marks_of(const Picture& picture, const Scene& scene, const std::vector<std::string>& names) {
  std::vector<Mark> marks;
  for (const std::string& name : names)
    for (const Mark& mark : picture.marks)
      if (scene.elements[static_cast<std::size_t>(mark.element)].name == name) marks.push_back(mark);
  REQUIRE(marks.size() == names.size());
  return marks;
}

double height(const Mark& mark) { return (mark.box.top + mark.box.bottom) / 2; }

double middle(const Mark& mark) { return (mark.box.left + mark.box.right) / 2; }

const std::string zener = R"([elements]
pull = { type = "force", at = "end", force = { pulse = "3 N", width = "1 s" } }
k  = { type = "spring", between = ["end", "ground"], stiffness = "2.5 kN/m" }
k1 = { type = "spring", between = ["end", "mid"], stiffness = "1 kN/m" }
c1 = { type = "dashpot", between = ["ground", "mid"], damping = "30 N*(s/m)^0.5", flow_index = 0.5 }
)";

const std::string servo = R"(command = { type = "generator", signal = { square = "1 m/s", frequency = "3 Hz" } }
error = { type = "sum", in = ["command", "-end.velocity", "-part"] }
I = { type = "integrator", in = "error", gain = "1.2 N/m" }
part = { type = "gain", in = "I", gain = "0.1 m/N/s" }
motor = { type = "force", at = "end", force = { block = "-I" } }
)";

/// From where a minus sign is written to the tips of the lines that come in beside it, the nearest first.
std::vector<double> distances_of_minus(const Picture& picture, const Label& minus) {
  std::vector<double> distances;
  const double height_of_dash = 3.5;  // above the baseline
  for (const SignalLine& line : picture.signals)
    if (const Point tip = line.points.back(); std::abs(tip.x - 10 - minus.at.x) < 0.1)
      distances.push_back(std::abs(minus.at.y - height_of_dash - tip.y));
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace

TEST_CASE("every scene that comes with the project is drawn without a fault") {
  REQUIRE(scene_files().size() > 30);
  for (const std::string& file : scene_files()) {
    CAPTURE(file);
    const Scene scene = scene_from_file(file);
    CHECK(faults_of(drawn(scene), scene) == "");
    CHECK(faults_of(schematic(scene, {.title = "", .all = true}), scene) == "");
  }
}

TEST_CASE("a minus sign is beside the line that it belongs to") {
  for (const std::string in : {R"("-x.velocity", "y.velocity")", R"("x.velocity", "-y.velocity")",
                               R"("x.velocity", "-y.velocity", "c.velocity")", R"("x.velocity", "c.velocity", "-y.velocity")"}) {
    CAPTURE(in);
    const Scene scene = scene_from(R"([elements]
x = { type = "motion", at = "x", velocity = 1 }
y = { type = "motion", at = "y", velocity = 2 }
c = { type = "dashpot", between = ["x", "y"], damping = 2 }
e = { type = "sum", in = [)" + in + "] }\n");
    const Picture picture = drawn(scene);
    CHECK(faults_of(picture, scene) == "");
    const auto minus = std::find_if(picture.labels.begin(), picture.labels.end(), [](const Label& l) { return l.text == "−"; });
    REQUIRE(minus != picture.labels.end());
    const std::vector<double> distances = distances_of_minus(picture, *minus);
    REQUIRE(distances.size() >= 2);
    CHECK(distances[0] < 0.75 * distances[1]);
    // The line that ends there comes from the text of the input with a negative sign.
    const auto line = std::find_if(picture.signals.begin(), picture.signals.end(), [&](const SignalLine& l) {
      return std::abs(std::abs(minus->at.y - 3.5 - l.points.back().y) - distances[0]) < 1e-9;
    });
    const std::string sensed = in.find("-x") != in.npos ? "x.velocity" : "y.velocity";
    const auto from = std::find_if(picture.labels.begin(), picture.labels.end(), [&](const Label& l) { return l.text == sensed; });
    REQUIRE(from != picture.labels.end());
    CHECK(std::abs(line->points.front().y - from->at.y) < 6);
  }
}

TEST_CASE("trees of up to 30 elements are drawn without a fault, however they are written, and alike") {
  int trees = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const RandomTree tree = random_tree(seed);
    if (tree.elements.size() > 30) continue;
    ++trees;
    std::size_t walls = 0;
    for (const std::string& netlist : {tree.composed, "[elements]\n" + tree.wired, "[elements]\n" + tree.shuffled}) {
      const Scene scene = scene_from(netlist);
      const Picture picture = drawn(scene);
      CHECK(faults_of(picture, scene) == "");
      if (walls > 0) CHECK(picture.walls.size() == walls);
      walls = picture.walls.size();
    }
  }
  CHECK(trees > 30);
}

TEST_CASE("any wiring of up to 30 elements is drawn without a fault") {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    const int nodes = 1 + static_cast<int>(seed % 9);
    const std::string netlist = random_network(seed, nodes, nodes + static_cast<int>(seed * 7 % 11));
    CAPTURE(netlist);
    const Scene scene = scene_from(netlist);
    CHECK(faults_of(drawn(scene), scene) == "");
  }
}

TEST_CASE("random blocks and the lines between them are drawn without a fault, loops too") {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const std::string netlist = random_blocks(seed, 2 + static_cast<int>(seed % 12));
    CAPTURE(netlist);
    const Scene scene = scene_from(netlist);
    CHECK(faults_of(drawn(scene), scene) == "");
  }
}

TEST_CASE("the inspection of drawings sees what is wrong") {
  const Scene scene = scene_from(zener + servo);
  const Picture good = drawn(scene);
  REQUIRE(faults_of(good, scene) == "");
  const auto faults = [&](auto spoil) {
    Picture spoilt = good;
    spoil(spoilt);
    return faults_of(spoilt, scene);
  };
  CHECK(contains(faults([](Picture& p) { p.marks.pop_back(); }), "0 symbols"));
  const auto spring = [&](Picture& p) -> Mark& {
    return *std::find_if(p.marks.begin(), p.marks.end(), [&](const Mark& mark) {
      return scene.elements[static_cast<std::size_t>(mark.element)].name == "k1";
    });
  };
  CHECK(contains(faults([&](Picture& p) { spring(p).ends[0].at.y += 1; }), "is not joined to"));
  CHECK(contains(faults([&](Picture& p) { spring(p).mirrored = true; }), "the wrong way round"));
  CHECK(contains(faults([&](Picture& p) { spring(p).ends[0].node = ground; }), "ends at other nodes"));
  CHECK(contains(faults([](Picture& p) { p.labels[0].at = p.labels[1].at; }), "overlaps"));
  CHECK(contains(faults([](Picture& p) { p.labels[1].at = p.wires[0].points[0]; }), "runs through"));
  CHECK(contains(faults([](Picture& p) { p.walls.clear(); }), "lacks a wall"));
  CHECK(contains(faults([](Picture& p) { p.width /= 2; }), "outside"));
  CHECK(contains(faults([](Picture& p) { p.signals[0].points.back().x += 30; }), "ends nowhere"));
  CHECK(contains(faults([](Picture& p) {
                   p.wires.push_back({p.wires[0].node == 1 ? 2 : 1, p.wires[0].points, {}});
                 }),
                 "meet"));
  for (std::size_t i = 0; i < good.wires.size(); ++i)
    if (good.wires[i].node != ground)  // two of them may be joined by a wall as well
      CHECK(faults([i](Picture& p) { p.wires.erase(p.wires.begin() + static_cast<std::ptrdiff_t>(i)); }) != "");
}

TEST_CASE("in series in a row, in parallel above each other, the drive to the left and ground to the right") {
  const Scene scene = scene_from(zener);
  const Picture picture = drawn(scene);
  const std::vector<Mark> marks = marks_of(picture, scene, {"pull", "k", "k1", "c1"});
  CHECK(height(marks[2]) == doctest::Approx(height(marks[3])));
  CHECK(height(marks[1]) < height(marks[2]) - 30);  // as the file has them
  CHECK(marks[0].box.right <= marks[2].box.left);
  CHECK(marks[2].box.right <= marks[3].box.left);
  CHECK(middle(marks[1]) == doctest::Approx((marks[2].box.left + marks[3].box.right) / 2).epsilon(0.1));
  CHECK(!marks[1].mirrored);
  CHECK(marks[3].mirrored);  // it is written from ground to mid
  REQUIRE(picture.walls.size() == 1);
  const Wall& wall = picture.walls.front();
  CHECK(wall.right);
  CHECK(wall.x > marks[3].box.right);
  CHECK(wall.top < height(marks[1]));
  CHECK(wall.bottom > height(marks[2]));
}

TEST_CASE("a stop with one bound stands on the side where it strikes: positions increase to the right") {
  for (const bool lower : {true, false}) {
    for (const bool swapped : {true, false}) {
      CAPTURE(lower);
      CAPTURE(swapped);
      // With its ends exchanged a stop strikes at the other bound.
      const Scene scene = scene_from(fmt::format(R"([elements]
ball   = {{ type = "mass", at = "ball", mass = "0.2 kg" }}
weight = {{ type = "force", at = "ball", force = "{}2 N" }}
floor  = {{ type = "stop", between = [{}], {} = 0, stiffness = "inf" }}
)", lower ? "-" : "", swapped ? R"("ground", "ball")" : R"("ball", "ground")", lower != swapped ? "lower" : "upper"));
      const auto marks = marks_of(drawn(scene), scene, {"ball", "floor"});
      CHECK((middle(marks[1]) < middle(marks[0])) == lower);
    }
  }
}

TEST_CASE("a chain of masses is a row between walls, its dampers to ground hang below") {
  const Scene scene = scene_from(R"([elements]
k1 = { type = "spring", between = ["ground", "a"], stiffness = "100 N/m" }
ma = { type = "mass", at = "a", mass = "1 kg" }
k2 = { type = "spring", between = ["a", "b"], stiffness = "100 N/m" }
mb = { type = "mass", at = "b", mass = "1 kg" }
cb = { type = "dashpot", between = ["b", "ground"], damping = "3 N*s/m" }
k3 = { type = "spring", between = ["b", "c"], stiffness = "100 N/m" }
mc = { type = "mass", at = "c", mass = "1 kg" }
k4 = { type = "spring", between = ["c", "ground"], stiffness = "100 N/m" }
push = { type = "force", at = "b", force = "2 N" })");
  const Picture picture = drawn(scene);
  CHECK(faults_of(picture, scene) == "");
  const std::vector<Mark> row = marks_of(picture, scene, {"k1", "ma", "k2", "mb", "k3", "mc", "k4"});
  for (std::size_t i = 0; i + 1 < row.size(); ++i) CHECK(row[i].box.right <= row[i + 1].box.left);
  const std::vector<Mark> others = marks_of(picture, scene, {"cb", "push"});
  CHECK(height(others[0]) > height(row[4]) + 20);
  CHECK(others[0].box.left > row[3].box.right);
  CHECK(height(others[1]) < row[3].box.top);     // in the middle of a row a drive comes from above
  CHECK(row[3].box.bottom > height(others[0]));  // the mass reaches over all that it carries
  REQUIRE(picture.walls.size() == 3);
}

TEST_CASE("what is at ground, or between ground and ground, has a wall of its own") {
  const Scene scene = scene_from(R"([elements]
f = { type = "force", at = "ground", force = "1 N" }
m = { type = "mass", at = "ground", mass = "1 kg" }
thing = { type = "thing", between = ["ground", "x"] }
mx = { type = "mass", at = "x", mass = "1 kg" }
[models.thing]
ports = ["a", "b"]
[models.thing.elements]
k = { type = "spring", between = ["a", "ground"], stiffness = "3 N/m" }
k2 = { type = "spring", between = ["a", "b"], stiffness = "4 N/m" })");
  const Picture picture = drawn(scene);
  CHECK(faults_of(picture, scene) == "");
  CHECK(picture.walls.size() == 4);
}

TEST_CASE("what is not series-parallel is drawn between bars, crossing wires hop") {
  std::string five = "[elements]\n";
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < a; ++b)
      five += fmt::format("k{}{} = {{ type = \"spring\", between = [\"n{}\", \"n{}\"], stiffness = \"1 N/m\" }}\n", a,
                          b, a, b);
  five += "f = { type = \"force\", at = \"n3\", force = \"1 N\" }\n";
  const Scene scene = scene_from(five);
  const Picture picture = drawn(scene);
  CHECK(faults_of(picture, scene) == "");
  std::size_t hops = 0;
  for (const Wire& wire : picture.wires) hops += wire.hops.size();
  CHECK(hops >=
        1);  // the complete graph of five is not planar; one crossing would do, were its nodes free to go anywhere
  CHECK(hops <= 2);
  const Mark drive = marks_of(picture, scene, {"f"}).front();
  for (const Mark& mark : picture.marks) CHECK(mark.box.left >= drive.box.left);
}

TEST_CASE("a long row goes on below, and hundreds of elements are an overview") {
  const Scene fifty = scene_from(chain(50));
  const Picture named = schematic(fifty, {.title = "", .all = true});
  CHECK(faults_of(named, fifty) == "");
  CHECK(named.labels.size() == 100);
  CHECK(named.width < 2000);
  CHECK(named.width > named.height);

  const Scene many = scene_from(chain(250));
  const Picture overview = schematic(many, {.title = "", .all = true});
  CHECK(faults_of(overview, many) == "");
  CHECK(overview.labels.empty());
  CHECK(overview.width < 2000);
  CHECK(overview.marks[2].box.right - overview.marks[2].box.left <
        0.6 * (named.marks[2].box.right - named.marks[2].box.left));

  const Scene several = scene_from(bundle(300));
  const Picture columns = schematic(several, {.title = "", .all = true});
  CHECK(faults_of(columns, several) == "");
  CHECK(columns.height < 2 * columns.width);

  CHECK_THROWS_AS(schematic(scene_from(chain(2501)), {.title = "", .all = true}), plot::Mistake);
}

TEST_CASE("any wiring of hundreds of elements is drawn without a fault, with names and without") {
  for (const int branches : {70, 110, 300})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Scene scene = scene_from(random_network(seed, branches / 2, branches));
      CAPTURE(seed);
      CHECK(faults_of(schematic(scene, {.title = "", .all = true}), scene) == "");
      CHECK(faults_of(drawn(scene), scene) == "");
    }
}

TEST_CASE("beyond 45 elements what repeats itself is drawn twice, and its last time") {
  const auto names = [](const Picture& picture, const Scene& scene) {
    std::string all;
    for (const Mark& mark : picture.marks) all += scene.elements[static_cast<std::size_t>(mark.element)].name + '|';
    return all;
  };
  const Scene row = scene_from(chain(40));
  const Picture abridged = drawn(row);
  CHECK(faults_of(abridged, row) == "");
  // The mass at the begin of the omitted part is drawn, and so are the elements after that part.
  for (const char* kept : {"chain.0.k|", "chain.0.m|", "chain.1.k|", "chain.2.m|", "chain.39.m|", "chain.39.k|"})
    CHECK_MESSAGE(contains(names(abridged, row), kept), kept);
  CHECK(abridged.marks.size() == 7);
  CHECK(abridged.omitted == 73);
  const auto says = [](const Picture& picture, const std::string& text) {
    return std::any_of(picture.labels.begin(), picture.labels.end(), [&](const Label& l) { return l.text == text; });
  };
  CHECK(says(abridged, "37 more"));
  CHECK(says(abridged, "100 N/m"));  // what remains has room for its values

  const Scene parallel = scene_from(bundle(100));
  const Picture few = drawn(parallel);
  CHECK(faults_of(few, parallel) == "");
  CHECK(names(few, parallel) == "k.0|k.1|k.99|");
  CHECK(says(few, "97 more"));

  const Scene small = scene_from(chain(22));
  CHECK(drawn(small).omitted == 0);
  const Scene large = scene_from(chain(50000));
  CHECK(drawn(large).omitted == 100000 - 7);

  // Where something else stands between them they are not the same.
  std::string wired = "[elements]\nf = { type = \"force\", at = \"n20\", force = 1 }\n";
  for (int i = 0; i < 40; ++i)
    wired += fmt::format(R"(k{0} = {{ type = "spring", between = ["n{0}", "n{1}"], stiffness = {1} }}
m{0} = {{ type = "mass", at = "n{0}", mass = 1 }}
)",
                         i, i + 1);
  const Scene pushed = scene_from(wired);
  const Picture two = drawn(pushed);
  CHECK(faults_of(two, pushed) == "");
  CHECK(contains(names(two, pushed), "f|"));
  CHECK(contains(names(two, pushed), "m20|"));
  CHECK(two.omitted == 81 - (7 + 3 + 7));
}

TEST_CASE("a drawing has values up to 45 elements, unless they are not wanted; node names that somebody gave") {
  const Scene scene = scene_from(zener);
  const auto texts = [&](const Look& look) {
    std::string all;
    for (const Label& label : schematic(scene, look).labels) all += label.text + '|';
    return all;
  };
  const std::string full = texts({.title = "Zener's solid"});
  for (const char* said :
       {"Zener's solid|", "|k1|", "|2.5 kN/m|", "|B = 30 N·(s/m)^0.5|", "|n = 0.5|", "|mid|", "|pulse 3 N, 1 s|"})
    CHECK_MESSAGE(contains(full, said), said << " in " << full);
  const std::string names = texts({.title = "", .values = false});
  CHECK(contains(names, "|k1|"));
  CHECK(!contains(names, "kN/m"));
}

TEST_CASE("a limiter says that it limits to both sides, or to one") {
  const auto texts = [](const char* limits) {
    std::string all;
    const Scene scene = scene_from(std::string("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                                               "lim = { type = \"limiter\", in = \"m.velocity\", ") + limits +
                                   " }\ng = { type = \"gain\", in = \"lim\", gain = \"-2 N*s/m\" }\n"
                                   "f = { type = \"force\", at = \"a\", force = { block = \"g\" } }\n");
    for (const Label& label : schematic(scene, {}).labels) all += label.text + '|';
    return all;
  };
  CHECK(contains(texts("upper = 0.3"), "|±300 mm/s|"));
  CHECK(contains(texts("upper = 0.3, lower = 0.1"), "|U = 300 mm/s|"));
}

TEST_CASE("the wires of a node are straight pieces that meet at corners and branches alone") {
  // A row that goes on below, parallel parts, and what hangs from a node.
  const Scene scene = scene_from(zener + "long = { type = \"spring\", between = [\"mid\", \"tail\"], stiffness = 3 }\nweight = { type = \"mass\", at = \"tail\", mass = 1 }\n" + servo);
  const std::string text = svg(drawn(scene), scene);
  const std::regex wire("data-node=\"([^\"]*)\" d=\"M([-0-9.]+) ([-0-9.]+)L([-0-9.]+) ([-0-9.]+)\"");
  struct Piece { std::string node; bool horizontal; double at, low, high; };
  std::vector<Piece> pieces;
  for (std::sregex_iterator found(text.begin(), text.end(), wire), end; found != end; ++found) {
    const double x1 = std::stod((*found)[2]), y1 = std::stod((*found)[3]), x2 = std::stod((*found)[4]), y2 = std::stod((*found)[5]);
    CHECK((x1 == x2) != (y1 == y2));
    pieces.push_back(y1 == y2 ? Piece{(*found)[1], true, y1, std::min(x1, x2), std::max(x1, x2)} : Piece{(*found)[1], false, x1, std::min(y1, y2), std::max(y1, y2)});
  }
  REQUIRE(pieces.size() >= 8);
  for (const Piece& a : pieces)
    for (const Piece& b : pieces)
      if (&a != &b && a.node == b.node && a.horizontal == b.horizontal && std::abs(a.at - b.at) < 0.05) {
        CAPTURE(a.node);
        CHECK((a.high < b.low || b.high < a.low));
      }
}

TEST_CASE("a force or motion stands in the middle of its texts") {
  for (const char* domain : {"translation", "rotation"}) {
    const Scene scene = scene_from(domain == std::string("rotation")
      ? "domain = \"rotation\"\n[elements]\ndrive_with_a_long_name = { type = \"torque\", at = \"end\", torque = \"40 N*m\" }\nm = { type = \"inertia\", at = \"end\", inertia = 1 }\n"
      : "[elements]\ndrive_with_a_long_name = { type = \"force\", at = \"end\", force = \"40 N\" }\nm = { type = \"mass\", at = \"end\", mass = 1 }\n");
    const Picture picture = drawn(scene);
    const Mark mark = marks_of(picture, scene, {"drive_with_a_long_name"}).front();
    for (const Label& label : picture.labels)
      if (label.text.starts_with("drive_with") || label.text.starts_with("40 N")) CHECK(label.at.x == doctest::Approx(middle(mark)));
  }
}

TEST_CASE("the arrow of what acts in the negative direction points backward, and its value has no sign") {
  const auto arrow = [](const std::string& drive) {
    const Scene scene = scene_from("[elements]\nk = { type = \"spring\", between = [\"x\", \"ground\"], stiffness = 1 }\ndrive = { at = \"x\", " + drive + " }\n");
    const Picture picture = drawn(scene);
    std::string texts;
    for (const Label& label : picture.labels)
      if (label.kind == Label::Kind::value && label.text != "1 N/m") texts += label.text + ';';
    return std::string(marks_of(picture, scene, {"drive"}).front().mirrored ? "<- " : "-> ") + texts;
  };
  CHECK(arrow("type = \"force\", force = \"-10 N\"") == "<- 10 N;");
  CHECK(arrow("type = \"force\", force = \"10 N\"") == "-> 10 N;");
  CHECK(arrow("type = \"force\", force = 0") == "-> 0 N;");
  CHECK(arrow("type = \"motion\", velocity = \"-20 mm/s\"") == "<- 20 mm/s;");
  CHECK(arrow("type = \"force\", force = { step = \"-3 N\", offset = \"-1 N\" }") == "<- 1 N → 4 N;");
  CHECK(arrow("type = \"force\", force = { step = \"3 N\", offset = \"-1 N\" }") == "-> −1 N → 2 N;");
  CHECK(arrow("type = \"force\", force = { ramp = \"-3 N/s\" }") == "<- ramp 3 N per s;");
  CHECK(arrow("type = \"force\", force = { ramp = \"-3 N/s\", offset = \"-1 N\" }") == "<- ramp 3 N per s + 1 N;");
  CHECK(arrow("type = \"force\", force = { pulse = \"-3 N\", width = \"1 s\" }") == "<- pulse 3 N, 1 s;");
  CHECK(arrow("type = \"force\", force = { sine = \"-3 N\", frequency = \"1 Hz\" }").starts_with("-> sine −3 N"));
}

TEST_CASE("an SVG is well-formed XML that names each element and each node, and is the same each time") {
  const Scene scene = scene_from(zener + servo);
  const std::string text = svg(schematic(scene, {.title = "a < b & \"c\"\x01\xff"}), scene);
  CHECK(what_is_wrong_with_xml(text) == "");
  CHECK(contains(text, "<title>a &lt; b &amp; &quot;c&quot;</title>"));
  for (const SceneElement& element : scene.elements) {
    const std::string named = " data-element=\"" + element.name + "\"";
    REQUIRE(contains(text, named));
    CHECK(text.find(named) == text.rfind(named));
  }
  for (const SceneNode& node : scene.nodes) CHECK(contains(text, " data-node=\"" + node.name + "\""));
  CHECK(text == svg(schematic(scene, {.title = "a < b & \"c\"\x01\xff"}), scene));
}

}  // namespace rheonet::test::schematic_test
