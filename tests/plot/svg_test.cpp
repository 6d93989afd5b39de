#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "tests/support/program.hpp"
#include "tests/support/xml.hpp"
#include "tools/plot/compose.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/plot/text.hpp"

namespace rheonet::test::svg_test {

using namespace rheonet::plot;

namespace {

Measured curve(const std::string& name, const Measure& x, const Measure& y, const std::vector<Point>& points) {
  Measured measured{name, {"x of " + name, x}, {name, y}, {}};
  for (const Point& p : points) measured.trace.add(p);
  return measured;
}

const Measure seconds = measure("time", "s"), force = measure("force", "N"), torque = measure("torque", "N*m");
const Measure velocity = measure("velocity", "m/s"), position = measure("position", "m");

std::string drawn(std::vector<Measured> curves, const Look& look = {}) {
  std::vector<std::string> notes;
  return svg(compose(std::move(curves), look, notes));
}

std::string mistake(std::vector<Measured> curves, const Look& look = {}) {
  try {
    drawn(std::move(curves), look);
  } catch (const Mistake& wrong) {
    return wrong.what();
  }
  return "";
}

std::vector<std::string> notes_of(std::vector<Measured> curves, const Look& look) {
  std::vector<std::string> notes;
  compose(std::move(curves), look, notes);
  return notes;
}

}  // namespace

TEST_CASE("an SVG is well-formed XML, whatever a curve is called, and names everything") {
  Look look;
  look.title = "a < b & \"c\"\x01\xff";
  const std::string text =
      drawn({curve("k<1>.force", seconds, force, {{0, 1}, {1, -2}}), curve("v&w", seconds, velocity, {{0, 1}, {1, 5}})},
            look);
  CHECK(what_is_wrong_with_xml(text) == "");
  for (const char* said : {"k&lt;1&gt;.force", "v&amp;w", "force [N]", "velocity [m/s]", "time [s]",
                           "<title>a &lt; b &amp; &quot;c&quot;</title>"}) {
    CAPTURE(said);
    CHECK(contains(text, said));
  }
  // The judge can say no.
  CHECK(what_is_wrong_with_xml("<a><b></a>") != "");
  CHECK(what_is_wrong_with_xml("<a>x < y</a>") != "");
  CHECK(what_is_wrong_with_xml("<a>x & y</a>") != "");
}

TEST_CASE("quantities have a panel each, with its unit and multiple; curves that coincide in dimension share one") {
  std::vector<std::string> notes;
  const Figure figure =
      compose({curve("f1", seconds, force, {{0, 1}, {0.01, 2000}}), curve("v", seconds, velocity, {{0, 1}, {0.01, 3}}),
               curve("f2", seconds, force, {{0, -3}, {0.01, 1}})},
              {}, notes);
  REQUIRE(figure.panels.size() == 2);
  CHECK(figure.x.label == "time [ms]");
  CHECK(figure.panels[0].y.label == "force [kN]");
  REQUIRE(figure.panels[0].curves.size() == 2);
  CHECK(figure.panels[0].curves[0].points[1].x == doctest::Approx(10));
  CHECK(figure.panels[0].curves[0].points[1].y == doctest::Approx(2));
  CHECK(figure.panels[0].curves[1].points[0].y == doctest::Approx(-0.003));
  CHECK(figure.panels[1].y.label == "velocity [m/s]");
  CHECK(notes.empty());
}

TEST_CASE("what cannot share an axis, or be drawn at all, is refused") {
  CHECK(mistake({}) == "there is nothing to draw");
  CHECK(mistake({curve("a", position, force, {{0, 1}, {1, 2}}),
                 curve("b", measure("angle", "rad"), force, {{0, 1}, {1, 2}})}) ==
        "`x of a` is position [m], and `x of b` is angle [rad]: the two cannot share the horizontal axis");
  Look look;
  look.units = {"kg"};
  CHECK(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}})}, look) ==
        "no axis shows a mass (kg), as the unit `kg` would need");
  look.units = {"ms", "in*oozf"};
  CHECK(contains(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}})}, look), "`in*oozf` is no unit: "));
  look = {};
  look.logarithmic_y = true;
  CHECK(mistake({curve("a", seconds, force, {{0, 0}, {1, -2}})}, look) ==
        "`a` has no value above 0 for a logarithmic axis");
  look.y_range = {0, 1};
  CHECK(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}})}, look) ==
        "the range of the vertical axis begins at 0, but a logarithmic axis begins above 0");
  look = {};
  look.x_range = {1, 1 + 1e-10};
  CHECK(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}})}, look) ==
        "1 to 1.0000000001 is no range for the numbers of the horizontal axis");
  look.x_range = {1, 1 + 1e-8};
  CHECK(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}})}, look) == "");
  look.x_range = {3, 1};
  CHECK(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}})}, look) ==
        "3 to 1 is no range for the numbers of the horizontal axis");
  look = {};
  look.y_label = "both";
  CHECK(mistake({curve("a", seconds, force, {{0, 1}, {1, 2}}), curve("b", seconds, velocity, {{0, 1}, {1, 2}})},
                look) == "a range or a label of the vertical axis, but there are 2: force [N], velocity [m/s]");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(mistake({curve("a", seconds, force, {{0, nan}, {1, nan}})}) == "`a` has no value to draw: all are not finite");
  CHECK(mistake({curve("a", seconds, force, {{0, 1e308}, {1, -1e308}})}) == "`a` has no value to draw: all are beyond 1e290");
}

TEST_CASE("what is left out is noted") {
  Look look;
  look.logarithmic_y = true;
  const std::vector<Point> falling{{0, 10}, {1, 1}, {2, 0}, {3, -1}};
  CHECK(notes_of({curve("a", seconds, force, falling)}, look) ==
        std::vector<std::string>{"`a`: 2 of 4 points are not above 0 and left out of the logarithmic axis"});
  look.magnitudes = true;
  CHECK(notes_of({curve("a", seconds, force, falling)}, look).front() ==
        "`a`: 1 of 4 points are not above 0 and left out of the logarithmic axis");
  CHECK(contains(drawn({curve("a", seconds, force, falling)}, look), "magnitude of force [N]"));
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(notes_of({curve("a", seconds, force, {{0, 1}, {1, infinite}, {2, 3}, {3, 1e300}})}, {}) ==
        std::vector<std::string>{"`a`: 2 of 4 points are not finite or beyond 1e290 and left out"});
}

TEST_CASE("a decay on a logarithmic axis is a straight line of two points") {
  std::vector<Point> decay;
  for (int i = 0; i <= 1000; ++i) decay.push_back({1e-3 * i, 5 * std::exp(-8e-3 * i)});
  Look look;
  look.logarithmic_y = true;
  const std::string text = drawn({curve("a", seconds, torque, decay)}, look);
  CHECK(std::regex_search(text,
                          std::regex(R"(<path d="M0 [0-9.]+L[0-9.]+ [0-9.]+" stroke="#000000" stroke-width="1.6"/>)")));
  CHECK(contains(text, ">0.01<"));
}

TEST_CASE("a curve all of whose points are one is drawn as a mark, and others are not") {
  const auto marks = [](const std::vector<Point>& points) {
    Look look;
    look.logarithmic_x = look.logarithmic_y = true;
    const std::string text = drawn({curve("a", velocity, force, points)}, look);
    return contains(text, "<circle");
  };
  CHECK(marks({{2.6, 0.013}}));
  CHECK(marks({{2.6, 0.013}, {2.6, 0.013}, {2.6, 0.013}}));
  CHECK_FALSE(marks({{2.6, 0.013}, {2.6, 0.013}, {2.7, 0.013}}));
}

TEST_CASE("curves of one quantity with different numbers of a panel share none") {
  Measured a = curve("a", seconds, position, {{0, 1}, {1, 2}}), b = curve("b", seconds, position, {{0, 1}, {1, 2}});
  std::vector<std::string> notes;
  CHECK(compose({a, b}, {}, notes).panels.size() == 1);
  b.panel = 1;
  CHECK(compose({a, b}, {}, notes).panels.size() == 2);
}

TEST_CASE("a curve has the style and the units that it is given") {
  Measured angle = curve("a", seconds, measure("angular velocity", "rad/s"), {{0, 1}, {0.5, 104.719755}});
  CHECK(contains(drawn({angle}), "angular velocity [rad/s]"));
  angle.style = Style{"#123456", "9 4"};
  angle.x_unit = Shown{"ms", 1e-3};
  angle.y_unit = Shown{"rpm", 0.104719755};
  const std::string text = drawn({angle});
  for (const char* said : {"stroke=\"#123456\"", "stroke-dasharray=\"9 4\"", "time [ms]", "angular velocity [rpm]", ">1000<", ">500<"}) {
    CAPTURE(said);
    CHECK(contains(text, said));
  }
}

TEST_CASE("a constant, a single point and a range far from 0 have axes too") {
  for (const std::vector<Point>& points : {std::vector<Point>{{0, 4}, {1, 4}},
                                           {{2, 0}},
                                           {{1e9, 1}, {1e9 + 1, 2}},
                                           {{0, 1e-290}, {1, 1e290}},
                                           {{0, 5e-324}, {1, 1e-310}},
                                           {{0, -1e289}, {1e-320, 1e289}}}) {
    for (const bool logarithmic : {false, true}) {
      if (logarithmic && points[0].y <= 0) continue;
      Look look;
      look.logarithmic_y = logarithmic;
      const std::string text = drawn({curve("a", measure("ratio", "1"), measure("level", "1"), points)}, look);
      CHECK(what_is_wrong_with_xml(text) == "");
      CHECK_FALSE(contains(text, "nan"));
      CHECK_FALSE(contains(text, "inf"));
    }
  }
}

TEST_CASE("no two numbers of an axis touch each other, and none leaves the figure") {
  // Where the numbers are: the middles of those across, the right ends of those that go up.
  struct Number {
    double x, y;
    std::string text;
  };
  const auto numbers = [](const std::string& svg, const char* anchor) {
    std::vector<Number> found;
    const std::regex pattern(std::string("<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" text-anchor=\"") + anchor + "\">([^\n]*)</text>");
    for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it)
      found.push_back({std::stod((*it)[1]), std::stod((*it)[2]), std::regex_replace((*it)[3].str(), std::regex("<[^>]*>"), "")});
    return found;
  };
  for (const double width : {200.0, 300.0, 640.0})
    for (const auto& [low, high] : {std::pair(0.0, 1.0), std::pair(1e6 + 1e-5, 1e6 + 5e-5), std::pair(-123456.7, 654321.8), std::pair(1.0, 1.0000001),
                                    std::pair(3e-9, 7e8), std::pair(2e-3, 0.15)})
      for (const bool logarithmic : {false, true}) {
        if (logarithmic && low <= 0) continue;
        CAPTURE(width);
        CAPTURE(low);
        CAPTURE(logarithmic);
        Figure figure;
        figure.width = width;
        figure.height = 160;
        figure.x = {.label = "x", .logarithmic = logarithmic, .range = std::pair(low, high)};
        Panel panel;
        panel.y = {.label = "y", .logarithmic = logarithmic, .range = std::pair(low, high)};
        panel.curves.push_back({"c", {{low, low}, {high, high}}});
        figure.panels.push_back(panel);
        figure.panels.push_back(panel);
        const std::string text = svg(figure);
        std::vector<Number> across = numbers(text, "middle");
        REQUIRE(!across.empty());
        across.pop_back();  // The label of the axis.
        REQUIRE(!across.empty());
        for (std::size_t k = 0; k < across.size(); ++k) {
          const double half = width_of(across[k].text, 12) / 2;
          CHECK(across[k].x + half <= width);
          if (k > 0) CHECK(across[k].x - half >= across[k - 1].x + width_of(across[k - 1].text, 12) / 2 + 4);
        }
        const std::vector<Number> up = numbers(text, "end");
        REQUIRE(up.size() > 1);
        for (std::size_t k = 1; k < up.size(); ++k) CHECK(std::abs(up[k].y - up[k - 1].y) >= 12);
      }
}

TEST_CASE("a million rows make a small figure that has their extremes") {
  std::vector<Point> rows;
  for (int i = 0; i < 1'000'000; ++i)
    rows.push_back({1e-6 * i, std::sin(0.01 * i) * std::cos(7e-6 * i) + (i == 765'432 ? 4 : i == 345'678 ? -2.5 : 0)});
  const std::string text = drawn({curve("a", seconds, force, rows)});
  CHECK(text.size() < 100'000);
  // The box is 340 px high; the margins are 1/20 of the range of 6.5 each: the peaks are at their distance from the
  // ends.
  double top = 1e9, bottom = -1e9;
  const std::regex number("[ML ]?([0-9.]+) ([0-9.]+)");
  const std::size_t begin = text.find("<path d=\"M", text.find("fill=\"none\" stroke-linejoin")) + 9;
  const std::string path = text.substr(begin, text.find('"', begin) - begin);
  for (std::sregex_iterator i(path.begin(), path.end(), number), end; i != end; ++i) {
    top = std::min(top, std::stod((*i)[2]));
    bottom = std::max(bottom, std::stod((*i)[2]));
  }
  CHECK(top == doctest::Approx(340 * 0.05 / 1.1).epsilon(1e-3));
  CHECK(bottom == doctest::Approx(340 * (1 - 0.05 / 1.1)).epsilon(1e-3));
}

}  // namespace rheonet::test::svg_test
