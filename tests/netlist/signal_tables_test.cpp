#include <doctest/doctest.h>

#include <numbers>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::signal_tables_test {

namespace {

constexpr double pi = std::numbers::pi;

/// The shape of a velocity given as `signal`.
template <class Shape>
Shape shape_of(const std::string& signal, const std::string& domain = "translation",
               const std::filesystem::path& folder = ".") {
  const Scene scene = sound_scene(
      "domain = \"" + domain + "\"\n[elements]\nm = { type = \"motion\", at = \"a\", velocity = " + signal + " }\n", {},
      folder);
  const auto* shape = std::get_if<Shape>(&scene.elements.at(0).signals.at(0).shape());
  REQUIRE(shape);
  return *shape;
}

}  // namespace

TEST_CASE("signals: each shape, in SI") {
  CHECK(shape_of<Signal::Constant>("\"3 mm/s\"").value == 0.003);
  CHECK(shape_of<Signal::Constant>("-2").value == -2);

  const auto step =
      shape_of<Signal::Step>("{ step = \"10 rad/s\", time = \"100 ms\", offset = \"1 rpm\" }", "rotation");
  CHECK(step.height == 10);
  CHECK(step.time == 0.1);
  CHECK(step.offset == doctest::Approx(pi / 30));

  const auto ramp = shape_of<Signal::Ramp>("{ ramp = \"3 mm/s^2\", time = 1 }");
  CHECK(ramp.slope == 0.003);
  CHECK(ramp.time == 1);

  const auto sine =
      shape_of<Signal::Sine>("{ sine = 2, frequency = \"2 kHz\", phase = \"90 deg\", time = 3, offset = 4 }");
  CHECK(sine.amplitude == 2);
  CHECK(sine.frequency == 2000);
  CHECK(sine.phase == doctest::Approx(pi / 2));
  CHECK(sine.time == 3);
  CHECK(sine.offset == 4);

  const auto cosine = shape_of<Signal::Sine>("{ cosine = 2, frequency = \"3 rad/s\", phase = 0.5 }");
  CHECK(cosine.frequency == doctest::Approx(3 / (2 * pi)));
  CHECK(cosine.phase == doctest::Approx(0.5 + pi / 2));

  const auto square = shape_of<Signal::Square>("{ square = \"150 deg/s\", frequency = \"3 Hz\" }", "rotation");
  CHECK(square.amplitude == doctest::Approx(150 * pi / 180));
  CHECK(square.frequency == 3);

  CHECK(shape_of<Signal::Triangle>("{ triangle = 2, frequency = \"30 rpm\" }").frequency == doctest::Approx(0.5));

  const auto chirp =
      shape_of<Signal::Chirp>("{ chirp = 1, frequency = 0, end_frequency = 5, duration = \"1 min\", phase = 1 }");
  CHECK(chirp.frequency == 0);
  CHECK(chirp.end_frequency == 5);
  CHECK(chirp.duration == 60);
  CHECK(chirp.phase == 1);

  const auto noise = shape_of<Signal::Noise>("{ noise = \"3 mm/s\", interval = \"10 ms\", seed = 12, time = 1, offset = 2 }");
  CHECK(noise.amplitude == 0.003);
  CHECK(noise.interval == 0.01);
  CHECK(noise.seed == 12);
  CHECK(noise.time == 1);
  CHECK(noise.offset == 2);

  const auto pulse = shape_of<Signal::Pulse>("{ pulse = 7, width = 0.25 }");
  CHECK(pulse.height == 7);
  CHECK(pulse.width == 0.25);
  CHECK(pulse.frequency == 0);
  CHECK(pulse.phase == 0);
  const auto pulses = shape_of<Signal::Pulse>("{ pulse = 7, width = 0.25, frequency = 2, phase = \"180 deg\" }");
  CHECK(pulses.frequency == 2);
  CHECK(pulses.phase == doctest::Approx(std::numbers::pi));
}

TEST_CASE("signals: the amplitude is a factor, and may carry the unit") {
  CHECK(shape_of<Signal::Sine>("{ sine = 3, amplitude = \"2 mm/s\", frequency = 1 }").amplitude == 0.006);
  CHECK(shape_of<Signal::Sine>("{ sine = \"3 mm/s\", amplitude = 2, frequency = 1 }").amplitude == 0.006);
  CHECK(shape_of<Signal::Step>("{ step = \"3 m\", amplitude = \"2 Hz\" }").height == 6);
  CHECK(shape_of<Signal::Ramp>("{ ramp = \"3 1/s\", amplitude = \"2 m/s\" }").slope == 6);
}

TEST_CASE("signals: tables, inline and from a file") {
  const auto inline_table =
      shape_of<Signal::Table>("{ table = [[0, 0], [\"500 ms\", \"1 mm/s\"], [1, 2]], time = 3, amplitude = 10 }");
  CHECK(inline_table.times == std::vector<double>{0, 0.5, 1});
  CHECK(inline_table.values == std::vector<double>{0, 0.01, 20});
  CHECK(inline_table.time == 3);

  const Folder folder;
  folder.write("data/comma.csv", "\xEF\xBB\xBFtime [s],value\r\n0,0\r\n0.5,+1e-3\r\n0.5 , -2\r\n");
  folder.write("semicolon.csv", "# measured\n\n0;1\n2;3");
  folder.write("decimal-comma.csv", "Zeit [s];Weg\n0,0;1,0\n2;3,0e0\n");
  folder.write("blank.txt", "0 1\n 2\t3 \n");
  const auto comma =
      shape_of<Signal::Table>("{ table = \"data/comma.csv\", amplitude = \"1 mm/s\" }", "translation", folder.path());
  CHECK(comma.times == std::vector<double>{0, 0.5, 0.5});
  CHECK(comma.values == std::vector<double>{0, 1e-6, -0.002});
  for (const char* name : {"semicolon.csv", "decimal-comma.csv", "blank.txt"}) {
    const auto table =
        shape_of<Signal::Table>("{ table = \"" + std::string(name) + "\" }", "translation", folder.path());
    CHECK(table.times == std::vector<double>{0, 2});
    CHECK(table.values == std::vector<double>{1, 3});
  }
}

TEST_CASE("signals: a file with units, and in quotes") {
  const Folder folder;
  const auto read = [&](const std::string& text, const std::string& keys = "",
                        const std::string& domain = "translation") {
    folder.write("t.csv", text);
    return shape_of<Signal::Table>("{ table = \"t.csv\"" + keys + " }", domain, folder.path());
  };
  for (const char* header :
       {"time [ms],speed [mm/s]", "time (ms) ; v_x (mm/s)", "\"t [ms]\",\"speed (top) [ mm s^-1 ]\""}) {
    const std::string separator = std::string(header).find(';') == std::string::npos ? "," : ";";
    const auto table = read(std::string(header) + "\n1.1" + separator + "2.3\n\"200\"" + separator + "\"-4\"\n");
    CHECK(table.times == std::vector<double>{0.0011, 0.2});
    CHECK(table.values == std::vector<double>{0.0023, -0.004});
  }
  CHECK(read("\"1\",\"2\"\n\"3\",\"4\"\n").times == std::vector<double>{1, 3});
  CHECK(read("t [s],speed [rpm]\n0,60\n", "", "rotation").values == std::vector<double>{2 * pi});
  // The file and the amplitude together make the unit.
  CHECK(read("t,speed [mm]\n0,60\n", ", amplitude = \"2 Hz\"").values == std::vector<double>{0.12});
  CHECK(read("t,speed [mm/s]\n0,60\n", ", amplitude = 2").values == std::vector<double>{0.12});
}

TEST_CASE("signals: two columns of a file with more, by their names") {
  const Folder folder;
  folder.write("rows.csv", "time [ms],k1.force [N],\"a.velocity [mm/s]\"\n0,7,1\n500,8,3\n");
  const auto table = shape_of<Signal::Table>("{ table = \"rows.csv\", columns = [\"time\", \"a.velocity\"] }", "translation", folder.path());
  CHECK(table.times == std::vector{0.0, 0.5});
  CHECK(table.values == std::vector{0.001, 0.003});
  const auto told = [&](const std::string& signal) {
    const ReadResult result = read("[elements]\nm = { type = \"motion\", at = \"a\", velocity = { " + signal + " } }\n", {}, folder.path());
    REQUIRE_FALSE(result.diagnostics.empty());
    const Diagnostic& first = result.diagnostics.front();
    return std::to_string(first.spot.line) + ":" + std::to_string(first.spot.column) + ": " + first.message + "; " + first.hint;
  };
  CHECK(told("table = \"rows.csv\"") == "1:1: a table of a signal has two columns, time and value; this row has 3; say which two are meant: "
                                        "columns = [\"time\", \"k1.force\"]");
  CHECK(told("table = \"rows.csv\", columns = [\"time\", \"a.velocitie\"]") == "2:86: the table has no column `a.velocitie`; did you mean `a.velocity`?");
  CHECK(told("table = \"rows.csv\", columns = [\"t\", \"force\"]") ==
        "2:78: the table has no column `t`; its columns are `time`, `k1.force` and `a.velocity`");
  CHECK(told("table = \"rows.csv\", columns = [\"time\"]") ==
        "2:77: `columns` names two columns, of the times and of the values; columns = [\"time\", \"force\"]");
  CHECK(told("table = [[0, 0], [1, 1]], columns = [\"time\", \"force\"]") ==
        "2:73: `columns` names columns of a CSV file, but `table` names none; table = \"measured.csv\", columns = [\"time\", \"force\"]");
  folder.write("rows.csv", "t,x,y\n0,1,2\n1,2\n");
  CHECK(told("table = \"rows.csv\", columns = [\"t\", \"y\"]") == "3:1: the header has 3 columns, this row has 2; ");
}

TEST_CASE("signals: a parameter that is constant is told from those that vary") {
  const ReadResult result = read("[elements]\ns = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = { ramp = \"1 N/s\" } }\n");
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(messages(result) == "scene.toml:2:61: error: `coulomb` is constant in time, but is a table\n"
                            "    2 | s = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = { ramp = \"1 N/s\" } }\n"
                            "      |                                                             ^\n"
                            "  no parameter of a `slider` may vary in time; types with such parameters are `motion` and `force`\n");
}

TEST_CASE("signals: within a repeat and a model") {
  const Scene scene = sound_scene(R"~(
[models.pusher]
ports = ["a"]
parameters = { F = "2 N", f = "3 Hz" }
elements = { f = { type = "force", at = "a", force = { sine = "F", frequency = "f" } } }
[elements]
p = { type = "pusher", at = "a", F = "5 N" }
q = { type = "pusher", at = "a", f = 4 }
r = { type = "force", at = "a", force = { step = "i+1", time = "i" }, repeat = { count = 3, arrange = "parallel" } }
)~");
  const auto sine = [&](std::size_t i) { return std::get<Signal::Sine>(scene.elements.at(i).signals.at(0).shape()); };
  CHECK(sine(0).amplitude == 5);
  CHECK(sine(0).frequency == 3);
  CHECK(sine(1).amplitude == 2);
  CHECK(sine(1).frequency == 4);
  const auto last = std::get<Signal::Step>(scene.elements.at(4).signals.at(0).shape());
  CHECK(last.height == 3);
  CHECK(last.time == 2);
}

}  // namespace rheonet::test::signal_tables_test
