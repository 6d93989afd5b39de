#include <doctest/doctest.h>

#include <iterator>
#include <sstream>

#include "tests/support/figure.hpp"
#include "tests/support/program.hpp"
#include "tests/support/xml.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::plot_test {

namespace {

const std::string scene = R"(title = "Relaxation"
[elements]
hand = { type = "motion",  at = "grip", position = { step = "1 cm", time = "0.1 s" } }
k1   = { type = "spring",  between = ["grip", "mid"],   stiffness = "200 N/m" }
c1   = { type = "dashpot", between = ["mid", "ground"], damping = "100 N*s/m" }
[simulate]
stop   = "3 s"
record = ["grip.position", "k1.force"]
)";

}  // namespace

TEST_CASE("plot draws the records of a scene, and whatever else is named; its claims are none of its business") {
  const Folder folder(scene + "[expect]\n\"k1.force\" = { max = \"3 N\" }\n");  // it is 2 N
  CHECK(folder.shell("rheonet plot scene.toml -o a.svg", 0).err == "");
  const std::string all = folder.read("a.svg");
  CHECK(what_is_wrong_with_xml(all) == "");
  for (const char* said :
       {"<title>Relaxation</title>", ">position [mm]<", ">force [N]<", ">time [s]<", ">k1.force<", ">grip.position<"}) {
    CAPTURE(said);
    CHECK(contains(all, said));
  }
  folder.shell("rheonet plot scene.toml -o b.svg --loop c1 --title Loop --unit cm --set k1.stiffness='20 N/m'", 0);
  const std::string loop = folder.read("b.svg");
  CHECK(contains(loop, "<desc>force [N] against displacement [cm]: c1.force</desc>"));
  CHECK(contains(loop, "<title>Loop</title>"));
  CHECK(contains(folder.shell("rheonet plot scene.toml -o - --flow k1,c1", 0).out,
                 "<desc>force [N] against velocity [mm/s]: k1.force, c1.force</desc>"));
  CHECK(contains(folder.shell("rheonet plot scene.toml -o - --phase mid", 0).out,
                 "<desc>velocity [mm/s] against position [mm]: mid.velocity</desc>"));
  const Finished decay =
      folder.shell("rheonet plot scene.toml -o - --decay k1 --name pull --x-range 0.2:2 --y-range 0.001:10", 0);
  CHECK(contains(decay.out, "<desc>force [N] against time [s]: pull</desc>"));
  CHECK(contains(decay.out, ">0.001<"));
  CHECK(contains(decay.err, "note: `pull`: 18 of 503 points are not above 0 and left out of the logarithmic axis"));
}

TEST_CASE("jumps are upright and corners sharp, wherever the rows are, in a plot and in the figure of a run") {
  // Rows at 0, 1.5 and 3 s; the jump is between two of them, or at one.
  const Folder folder(scene + "[simulate.output]\npoints = 3\n");
  const auto points = [](const std::string& svg) {
    std::vector<std::vector<double>> curves;
    for (std::string path : matches(svg, "<path d=\"([^\"]*)\" stroke=\"[^\"]*\" stroke-width=\"1.6\"")) {
      for (char& c : path) c = c == 'M' || c == 'L' ? ' ' : c;
      std::istringstream numbers(path);
      curves.push_back({});
      for (double number = 0; numbers >> number;) curves.back().push_back(number);
    }
    return curves;
  };
  folder.shell("rheonet run scene.toml -q -o rows.csv", 0);
  for (const std::string time : {"0.75 s", "1.5 s"}) {
    CAPTURE(time);
    const std::string set = " --set hand.position.time='" + time + "'";
    folder.shell("rheonet run scene.toml -q -o rows.csv --plot run.svg" + set, 0);
    CHECK(folder.read("rows.csv") == folder.shell("rheonet run scene.toml -q -o -" + set, 0).out);
    for (const std::string& svg : {folder.shell("rheonet plot scene.toml -o -" + set, 0).out, folder.read("run.svg")}) {
      const auto curves = points(svg);
      REQUIRE(curves.size() == 2);
      // Along the bottom, up, along the top; the width is that of 3 s.
      const std::vector<double>& hand = curves[0];
      REQUIRE(hand.size() == 8);
      CHECK(hand[2] == hand[4]);
      CHECK(hand[2] / hand[6] == doctest::Approx(std::stod(time) / 3).epsilon(1e-4));
      CHECK(hand[1] == hand[3]);
      CHECK(hand[5] == hand[7]);
      CHECK(hand[5] < hand[3]);
      // The force jumps with it, and falls from there.
      const std::vector<double>& force = curves[1];
      REQUIRE(force.size() >= 8);
      CHECK(force[2] == force[4]);
      CHECK(force[5] < force[3]);
      CHECK(force[7] > force[5]);
    }
  }
}

TEST_CASE("jumps are upright in the figure of a run in parts and of one that is certified, whose rows stay what they are") {
  const Folder folder(two_blocks + R"(push = { type = "motion", at = "a", velocity = { step = 1, time = 0.503 } }
c1 = { type = "dashpot", between = ["a", "ground"], damping = 1 }
[simulate]
stop = 1
output = { points = 5 }
record = ["c1.force", "one.position", "two.position"]
)");
  for (const std::string option : {"", " --certify"}) {
    CAPTURE(option);
    folder.shell("rheonet run scene.toml -q -o rows.csv" + option, 0);
    const Finished drawn = folder.shell("rheonet run scene.toml -o again.csv --plot run.svg" + option, 0);
    if (option.empty()) CHECK(contains(drawn.err, "independent parts"));
    CHECK(folder.read("again.csv") == folder.read("rows.csv"));
    const std::string svg = folder.read("run.svg");
    // The first curve goes along, up at once and along again: the jump is at 0.503 of the width.
    const std::vector<std::string> force = matches(svg, "<path d=\"([^\"]*)\" stroke=\"[^\"]*\" stroke-width=\"1.6\"");
    REQUIRE(!force.empty());
    std::string path = force.front();
    for (char& c : path) c = c == 'M' || c == 'L' ? ' ' : c;
    std::istringstream numbers(path);
    const std::vector<double> at{std::istream_iterator<double>(numbers), {}};
    REQUIRE(at.size() == 8);
    CHECK(at[2] == at[4]);
    CHECK(at[2] / at[6] == doctest::Approx(0.503).epsilon(1e-3));
    CHECK(at[5] < at[3]);
  }
}

TEST_CASE("of several scenes each says once what is doubtful") {
  const Folder folder(scene);
  std::string loose = scene;
  loose.replace(loose.find("\"ground\""), 8, "\"grund\"");
  folder.write("loose.toml", loose);
  const std::string said = folder.shell("rheonet plot scene.toml loose.toml -y k1.force -o both.svg", 0).err;
  CHECK(contains(said, "nothing but `c1` is at node `grund`"));
  CHECK(said.find("warning") == said.rfind("warning"));
}

TEST_CASE("a scene says what is worth drawing, unless the command line does") {
  const Folder folder(scene + "[plot]\nloop = [\"c1\", \"k1\"]\nunit = \"cm\"\n");
  const std::string own = folder.shell("rheonet plot scene.toml -o -", 0).out;
  CHECK(contains(own, "<desc>force [N] against displacement [cm]: c1.force, k1.force</desc>"));
  CHECK_FALSE(contains(own, "grip.position"));
  CHECK(contains(folder.shell("rheonet plot scene.toml -o - --unit mm", 0).out, "displacement [mm]"));
  CHECK(contains(folder.shell("rheonet plot scene.toml -o - -y k1.force", 0).out,
                 "<desc>force [N] against time [s]: k1.force</desc>"));
  // A run plots only its records: here none for the loops, so all records over time.
  folder.shell("rheonet run scene.toml -q -o a.csv --plot run.svg", 0);
  CHECK(contains(folder.read("run.svg"), "force [N] against time [s]: k1.force"));
  folder.shell("rheonet run scene.toml -q -o a.csv --plot run.svg --set simulate.record='[\"c1.force\",\"c1.displacement\"]'", 0);
  CHECK(contains(folder.read("run.svg"), "<desc>force [N] against displacement [cm]: c1.force</desc>"));
  folder.shell("rheonet plot scene.toml -o decay.svg --set plot='{ y = \"k1.force\", log = \"y\" }'", 0);
  CHECK(contains(folder.read("decay.svg"), ">0.01<"));
}

TEST_CASE("what a block puts out has the unit that follows from its inputs, and the axis of others that have it") {
  const Folder folder(R"(domain = "rotation"
[elements]
command = { type = "generator",  signal = { step = "150 deg/s", time = "0.1 s" } }
error   = { type = "sum",        in = ["command", "-shaft.velocity"] }
turned  = { type = "integrator", in = "error" }
amp     = { type = "gain",       in = "error", gain = "0.2 N*m*s/rad" }
swing   = { type = "integrator", in = "amp" }
bare    = { type = "gain",       in = "error", gain = 0.3 }
motor   = { type = "torque",  at = "shaft", torque = { block = "amp" } }
rotor   = { type = "inertia", at = "shaft", inertia = "0.05 kg*m^2" }
[simulate]
stop = "1 s"
)");
  const auto described = [&](const char* curves) {
    const std::string svg = folder.shell(std::string("rheonet plot scene.toml -o - -y ") + curves, 0).out;
    return svg.substr(svg.find("<desc>"), svg.find("</desc>") - svg.find("<desc>"));
  };
  CHECK(described("shaft.velocity,command.out") ==
        "<desc>angular velocity [rad/s] against time [s]: shaft.velocity, command.out");
  CHECK(described("amp.out,motor.force") == "<desc>torque [N·m] against time [s]: amp.out, motor.force");
  CHECK(described("turned.out,shaft.position") == "<desc>angle [rad] against time [s]: turned.out, shaft.position");
  CHECK(described("swing.out") == "<desc>signal [kg·m²·s^-1] against time [s]: swing.out");
  CHECK(described("bare.out") == "<desc>bare.out against time [s]: bare.out");
}

TEST_CASE("plot overlays runs and other files, each called by its name") {
  const Folder folder(scene);
  folder.shell(
      "rheonet run -q scene.toml -o soft.csv && rheonet run -q scene.toml -o stiff.csv --set k1.stiffness='400 N/m'",
      0);
  folder.write("measured.csv", "\xEF\xBB\xBF" "time [ms],k1.force [gf]\n200,150\n500,90\n");  // with a byte order mark, as from Excel
  const Finished both = folder.shell("rheonet plot soft.csv stiff.csv -y k1.force -o - --domain translation", 0);
  CHECK(contains(both.out, "<desc>force [N] against time [s]: soft, stiff</desc>"));
  CHECK(both.err == "");
  const Finished unknown = folder.shell("rheonet plot soft.csv -y k1.force -o -", 0);
  CHECK(contains(unknown.out, ">force [SI]<"));
  CHECK(unknown.err ==
        "note: a CSV file does not say whether `k1.force` is of translation or rotation; `--domain` puts its unit on "
        "the axis\n");
  const Finished mixed = folder.shell("rheonet plot scene.toml measured.csv -y k1.force --marks --unit gf,ms -o -", 0);
  CHECK(contains(mixed.out, "[gf] against time [ms]: scene, measured</desc>"));
  CHECK(contains(mixed.out, "<circle "));
}

TEST_CASE("run --plot draws the records over time, beside the rows") {
  const Folder folder(scene);
  folder.shell("rheonet run -q scene.toml -o rows.csv --plot a.svg", 0);
  CHECK(contains(folder.read("a.svg"),
                 "<desc>position [mm] against time [s]: grip.position; force [N] against time [s]: k1.force</desc>"));
  CHECK(contains(folder.read("rows.csv"), "time,grip.position,k1.force\n"));
  CHECK(folder.shell("rheonet run -q scene.toml -o rows.csv --plot a.pdf", 2).err ==
        "error: `--plot a.pdf` is neither an .svg nor a .png\n");
}

TEST_CASE("the figure of a run has a file of its own") {
  const Folder folder(scene);
  CHECK(folder.shell("rheonet run -q scene.toml -o a.svg --plot ./a.svg", 2).err ==
        "error: `--output a.svg`: rows are written as CSV, NetCDF or MAT, and `.svg` is another format\n"
        "  name the file .csv (or .txt, .dat, or without an ending), .nc or .mat\n");
  CHECK(folder.shell("rheonet run -q scene.toml --plot -", 2).err ==
        "error: `--output` and `--plot` both write to standard output; give one of them another file\n");
  CHECK_FALSE(folder.has("a.svg"));
}

TEST_CASE("a figure does not overwrite what it is drawn from") {
  const Folder folder(scene);
  folder.write("scene.svg", scene);
  CHECK(folder.shell("rheonet run -q scene.svg -o rows.csv --plot ./scene.svg", 2).err ==
        "error: `--plot ./scene.svg` would overwrite the scene itself\n");
  CHECK(folder.shell("rheonet precision scene.svg --plot scene.svg", 2).err ==
        "error: `--plot scene.svg` would overwrite the scene itself\n");
  CHECK(folder.shell("rheonet plot scene.svg -o ./scene.svg", 2).err ==
        "error: `--output ./scene.svg` would overwrite what it draws, `scene.svg`\n");
  CHECK(folder.read("scene.svg") == scene);
}

TEST_CASE("of a table nobody chose columns of, those without numbers are left out; of one that is chosen it is told") {
  const Folder folder(scene);
  folder.write("r.csv", "run,k [N/m],error,note\n1,10,,good\n2,20,\"does, not\",\n3,,,bad\n");
  const Finished drawn = folder.shell("rheonet plot r.csv -o a.svg", 0);
  CHECK(drawn.err == "note: `error` has no numbers, and is left out\nnote: `note` has no numbers, and is left out\n"
                     "note: `k`: 1 of 3 points are not finite and left out\n");
  CHECK(contains(folder.read("a.svg"), "<desc>k [N/m] against run: k</desc>"));
  CHECK(contains(folder.shell("rheonet plot r.csv -y error -x run -o b.svg", 2).err, "r.csv:3:6: expected a number, found `does, not`"));
  folder.write("r.csv", "run,k\n1,10\n2,x\n");
  CHECK(contains(folder.shell("rheonet plot r.csv -o b.svg", 2).err, "r.csv:3:3: expected a number, found `x`"));
  folder.write("r.csv", "run,k\n1,y\n2,x\n");
  CHECK(contains(folder.shell("rheonet plot r.csv -o b.svg", 2).err, "error: r.csv:2:3: expected a number, found `y`"));
}

TEST_CASE("a file that cannot be written is told before a run for it") {
  const Folder folder(endless);
  folder.write("folder.svg/file", "");
  for (const std::string task : {"plot scene.toml -o ", "run -q scene.toml -o rows.csv --plot ", "precision scene.toml --plot "})
    for (const std::string ending : {".svg", ".png"}) {
      CAPTURE(task);
      CHECK(folder.shell("timeout 20 rheonet " + task + "no/a" + ending, 2).err ==
            "error: cannot write to `no/a" + ending + "`: No such file or directory\n");
      CHECK(contains(folder.shell("timeout 20 rheonet " + task + "folder.svg", 2).err, "error: cannot write to `folder.svg`: Is a directory\n"));
    }
  CHECK_FALSE(folder.has("rows.csv"));
}

TEST_CASE("run --plot draws what there is of a run that fails, or says that there is nothing") {
  const Folder folder(overcome);
  const std::string said = folder.shell("rheonet run -q scene.toml -o rows.csv --plot a.svg", 1).err;
  CHECK(contains(said, "the 3 rows up to there are in `rows.csv`\n  the figure `a.svg` shows the run up to there\n"));
  const std::string svg = folder.read("a.svg");
  CHECK(what_is_wrong_with_xml(svg) == "");
  CHECK(contains(svg, ">k1.force<"));
  CHECK(contains(svg, ">0.20<"));
  CHECK_FALSE(contains(svg, ">0.25<"));
  folder.write("scene.toml", contradictory);
  CHECK(contains(folder.shell("rheonet run -q scene.toml -o rows.csv --plot b.svg", 1).err, "no figure is drawn: the run does not get beyond its start\n"));
  CHECK_FALSE(folder.has("b.svg"));
}

TEST_CASE("a .png is made by rsvg-convert; without it plot says so") {
  const Folder folder(scene);
  folder.shell("rheonet plot scene.toml -o a.png", 0);
  CHECK(folder.read("a.png").starts_with("\x89PNG\r\n"));
  CHECK(folder.read("a.png").size() > 5000);
  CHECK(folder.shell("p=$(command -v rheonet); PATH=/nowhere $p plot scene.toml -o b.png", 1).err ==
        "error: `b.png`: a .png is made by rsvg-convert, which is not installed (Debian: apt-get install "
        "librsvg2-bin); an .svg "
        "needs nothing\n");
}

TEST_CASE("plot says what is wrong with what it is asked for") {
  const Folder folder(scene);
  folder.write("r.csv", "time,k1.force\n0,1\n1,2\n");
  const auto said = [&](const std::string& words) { return folder.shell("rheonet plot " + words, 2).err; };
  CHECK(said("r.csv -y k1.forse -o a.svg") == "error: `r.csv` has no column `k1.forse`\n  did you mean `k1.force`?\n");
  CHECK(said("r.csv -x pressure -o a.svg") == "error: `r.csv` has no column `pressure`\n  it has `time`, `k1.force`\n");
  CHECK(contains(said("scene.toml -y k1.forse -o a.svg"), "error: `k1` has no `forse`"));
  CHECK(said("scene.toml r.csv -y c2.force -o a.svg") ==
        "error: `scene.toml` has no column `c2.force`\n  did you mean `k1.force`?\n");
  CHECK(said("none.csv -o a.svg") == "error: `none.csv` cannot be read: No such file or directory\n");
  CHECK(said("r.csv k1.force -o a.svg") == "error: there is no file `k1.force`\n  what is to be drawn is named by -y: `-y k1.force`\n");
  CHECK(said("r.csv -o a.pdf") == "error: `--output a.pdf` is neither an .svg nor a .png\n");
  CHECK(said("r.csv -o a.svg --x-range 2:1") ==
        "error: `--x-range 2:1` is no range; it takes two numbers, the lower one first: --x-range 0:2.5\n");
  CHECK(said("r.csv -o a.svg --size 640") ==
        "error: `--size 640` is no size; it takes width and height in px, from 200 to 4000: --size 640x400\n");
  CHECK(said("r.csv -o a.svg --log z") == "error: `--log z` names no axes; it takes x, y or xy\n");
  CHECK(said("r.csv -o a.svg --name a --name b") == "error: 2 of --name for 1 curves\n");
  CHECK(said("r.csv -o a.svg --unit kg --domain rotation") ==
        "error: no axis shows a mass (kg), as the unit `kg` would need\n");
  CHECK(contains(said("r.csv"), "--output"));
  CHECK(contains(said("r.csv -o a.svg --domain sideways"), "sideways"));
  CHECK(said("r.csv -o a.svg --domain rotation --x-range 1.01:3") ==
        "error: nothing is drawn within 1.01 to 3\n  time [s] goes from 0 to 1\n");
  CHECK(said("scene.toml -o a.svg -y k1.force --unit mN --y-range -20:-1") ==
        "error: nothing is drawn within -20 to -1\n  force [mN] goes from 0 to 2000\n");
  CHECK_FALSE(folder.has("a.svg"));
  folder.shell("rheonet plot r.csv -o a.svg --domain rotation --x-range 0.99:3", 0);
  CHECK(folder.has("a.svg"));
  // As with `run`, a scene that cannot be simulated is status 1.
  CHECK(contains(folder.shell("rheonet plot scene.toml -o a.svg --set c1.damping=0 k1.stiffness=0", 1).err, "error: "));
}

TEST_CASE("of many records that nobody chose a dozen of each quantity are drawn, and the rest is told") {
  std::string many =
      "[elements]\nc = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1, repeat = { count = 20, "
      "arrange = \"parallel\" } }\n"
      "m = { type = \"motion\", at = \"a\", velocity = 1 }\n[simulate]\nstop = 1\nrecord = [";
  for (int k = 0; k < 14; ++k) many += "\"c." + std::to_string(k) + ".force\", ";
  const Folder folder(many + "\"a.velocity\"]\n");
  const Finished drawn = folder.shell("rheonet plot scene.toml -o -", 0);
  CHECK(drawn.err == "note: of each quantity the first 12 columns are drawn; 2 others are not\n");
  CHECK(contains(drawn.out, ">c.11.force<"));
  CHECK_FALSE(contains(drawn.out, ">c.12.force<"));
  CHECK(contains(drawn.out, ">a.velocity<"));
}

}  // namespace rheonet::test::plot_test
