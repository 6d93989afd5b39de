#include <doctest/doctest.h>

#include <cctype>
#include <set>
#include <stdexcept>

#include "core/network/component.hpp"
#include "tests/draw/drawn.hpp"
#include "tools/draw/caption.hpp"
#include "tools/draw/symbol_path.hpp"

namespace rheonet::test::symbol_test {

using namespace rheonet::draw;

namespace {

/// The points that a path names, in its box of 1 x 1: those of M, L and the ends of curves, with H and V followed.
std::vector<Point> points_of(const std::string& path) {
  std::vector<Point> points;
  std::vector<double> numbers;
  char command = 0;
  const auto finish = [&] {
    if (command == 0 || command == 'Z') return;
    Point p = points.empty() ? Point{} : points.back();
    if (command == 'H') p.x = numbers.at(0);
    if (command == 'V') p.y = numbers.at(0);
    if (command != 'H' && command != 'V') p = {numbers.at(numbers.size() - 2), numbers.back()};
    points.push_back(p);
  };
  for (std::size_t at = 0; at < path.size();) {
    if (std::isalpha(static_cast<unsigned char>(path[at])) != 0) {
      finish();
      command = path[at++];
      numbers.clear();
    } else if (path[at] == ' ') {
      ++at;
    } else {
      std::size_t used = 0;
      numbers.push_back(std::stod(path.substr(at), &used));
      at += used;
    }
  }
  finish();
  return points;
}

std::string all_of(const Symbol& symbol) { return symbol.outline + symbol.lines + symbol.thin + symbol.solid; }

bool has_point(const Symbol& symbol, double x, double y) {
  for (const std::string* path : {&symbol.outline, &symbol.lines, &symbol.thin, &symbol.solid})
    for (const Point& p : points_of(*path))
      if (p.x == x && p.y == y) return true;
  return false;
}

}  // namespace

TEST_CASE("each component has a symbol of its own, within its box, that reaches its ports") {
  std::set<std::string> seen;
  for (const Component* component : components()) {
    const Declaration& declaration = component->declaration;
    CAPTURE(declaration.type);
    CHECK(seen.insert(all_of(component->drawing)).second);
    for (const Domain domain : {Domain::translation, Domain::rotation}) {
      const Symbol& symbol = symbol_of(*component, domain);
      for (const std::string* path : {&symbol.outline, &symbol.lines, &symbol.thin, &symbol.solid}) {
        CAPTURE(*path);
        if (path->empty()) continue;
        CHECK(path->starts_with("M"));
        CHECK_NOTHROW(fitted(*path, {0, 0, 1, 1}, false));
        for (const Point& p : points_of(*path)) {
          CHECK(p.x >= 0);
          CHECK(p.x <= 1);
          CHECK(p.y >= 0);
          CHECK(p.y <= 1);
        }
      }
      const bool arrow = component->role == Role::motion || component->role == Role::force;
      if (declaration.ports == Declaration::Ports::between || arrow) {
        CHECK(has_point(symbol, 0, 0.5));
        CHECK(has_point(symbol, 1, 0.5));
      }
    }
  }
}

TEST_CASE("a component that declares no symbol is drawn as a plain box") {
  const Component plain;
  const Symbol& symbol = symbol_of(plain, Domain::translation);
  CHECK(!symbol.outline.empty());
  CHECK(has_point(symbol, 0, 0.5));
  CHECK(has_point(symbol, 1, 0.5));
}

TEST_CASE("rotation has symbols of its own where they are declared") {
  const Component &force = *find_component("force"), &spring = *find_component("spring");
  CHECK(all_of(symbol_of(force, Domain::rotation)) != all_of(symbol_of(force, Domain::translation)));
  CHECK(&symbol_of(spring, Domain::rotation) == &symbol_of(spring, Domain::translation));
}

TEST_CASE("a generator shows what it generates, each shape as another one, within its box") {
  std::set<std::string> seen;
  for (const char* signal : {"2", "{ step = 1, time = 1 }", "{ ramp = 1 }", "{ sine = 1, frequency = 1 }", "{ square = 1, frequency = 1 }",
                             "{ triangle = 1, frequency = 1 }", "{ chirp = 1, frequency = 1, end_frequency = 2, duration = 1 }",
                             "{ pulse = 1, width = 1 }", "{ pulse = 1, width = 0.1, frequency = 1 }", "{ table = [[0, 0], [1, 2]] }"}) {
    CAPTURE(signal);
    const Scene scene = test::scene_from(std::string("[elements]\nsource = { type = \"generator\", signal = ") + signal +
                                         " }\npush = { type = \"force\", at = \"a\", force = { block = \"source\" } }\n"
                                         "c1 = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1 }\n");
    const Symbol symbol = symbol_of(scene, 0);
    CHECK(seen.insert(symbol.lines).second);
    CHECK_NOTHROW(fitted(symbol.lines, {0, 0, 1, 1}, false));
    for (const Point& p : points_of(symbol.lines)) {
      CHECK(p.x >= 0.14);
      CHECK(p.x <= 0.86);
      CHECK(p.y >= 0.1);
      CHECK(p.y <= 0.9);
    }
  }
  CHECK(symbol_of(test::scene_from("[elements]\nk1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }\n"
                                   "m1 = { type = \"mass\", at = \"a\", mass = 1 }\n"),
                  0).lines == find_component("spring")->drawing.lines);
}

TEST_CASE("a path is mapped to a box, mirrored or not; arcs turn the other way in a mirror") {
  const rheonet::draw::Box box{100, 10, 300, 50};
  CHECK(fitted("M0 .5 H.25 L.5 .75 V1 Z", box, false) == "M100 30H150L200 40V50Z");
  CHECK(fitted("M0 .5 H.25 L.5 .75 V1 Z", box, true) == "M300 30H250L200 40V50Z");
  CHECK(fitted("M0 0 A.1 .5 0 0 1 1 1", box, false) == "M100 10A20 20 0 0 1 300 50");
  CHECK(fitted("M0 0 A.1 .5 0 0 1 1 1", box, true) == "M300 10A20 20 0 0 0 100 50");
  CHECK(fitted("M0 0 C.1 0 .2 .5 1 1 Q.5 .5 0 1", box, false) == "M100 10C120 10 140 30 300 50Q200 30 100 50");
  CHECK(fitted("M.1 .5 L0 .9 H1", {0, 0, 200, 60}, false, 50) == "M5 30L0 55H200");  // near an edge it stays so
  CHECK_THROWS_AS(fitted("m0 0", box, false), std::invalid_argument);
  CHECK_THROWS_AS(fitted("M0 0 L1", box, false), std::invalid_argument);
}

TEST_CASE("values are written as engineers do") {
  CHECK(engineering(2500, "N/m") == "2.5 kN/m");
  CHECK(engineering(200, "N*s/m") == "200 N·s/m");
  CHECK(engineering(5e-5, "m") == "50 µm");
  CHECK(engineering(-0.003, "s") == "−3 ms");
  CHECK(engineering(7200, "s") == "7200 s");
  CHECK(engineering(999.96, "N") == "1000 N");
  CHECK(engineering(1000, "N") == "1 kN");
  CHECK(engineering(0.25, "kg") == "250 g");
  CHECK(engineering(5.675e-5, "kg*m^2") == "5.675·10⁻⁵ kg·m²");
  CHECK(engineering(1e12, "N*m/rad") == "10¹² N·m/rad");
  CHECK(engineering(0.5, "1") == "0.5");
  CHECK(engineering(0, "N") == "0 N");
  CHECK(engineering(std::numeric_limits<double>::infinity(), "N") == "∞");
  CHECK(in_print("sigma") == "σ");
  CHECK(in_print("Fc") == "Fc");
  CHECK(in_print("eta_b") == "ηb");
}

}  // namespace rheonet::test::symbol_test
