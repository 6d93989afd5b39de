#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::run_test {

namespace {

std::size_t lines(const std::string& text) {
  std::size_t n = 0;
  for (char c : text) n += c == '\n' ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("run writes the rows to standard output and the summary to standard error") {
  const Folder folder(oscillator);
  const Finished result = folder.shell("rheonet run scene.toml", 0);

  std::istringstream rows(result.out);
  std::string header;
  std::getline(rows, header);
  CHECK(header == "time,block.position,k1.force");
  double t = 0, x = 0, f = 0;
  char comma = 0;
  int count = 0;
  while (rows >> t >> comma >> x >> comma >> f) {
    CHECK(t == doctest::Approx(0.1 * count).epsilon(1e-12));
    CHECK(std::abs(x - 1e-3 * std::cos(10 * t)) < 1e-8);
    CHECK(std::abs(f - 0.1 * std::cos(10 * t)) < 1e-6);
    ++count;
  }
  CHECK(count == 11);

  for (const std::string part :
       {"rows                              11", "unknowns", "linear between events: solved in closed form", "steps", "rejected", "residual evaluations",
        "Jacobian evaluations", "events", "starts", "wall time", "CPU time", "energy supplied", "energy stored",
        "energy dissipated", "energy missing", " J", "of the largest energy"}) {
    CAPTURE(part);
    CHECK(contains(result.err, part));
  }
  // Not a terminal: no bar.
  CHECK_FALSE(contains(result.err, "\x1b"));
  CHECK_FALSE(contains(result.err, "\r"));
}

TEST_CASE("-o writes the same rows to a file, `-o -` to standard output; -q says nothing") {
  const Folder folder(oscillator);
  const std::string expected = folder.shell("rheonet run -q scene.toml").out;
  CHECK(lines(expected) == 12);
  CHECK(folder.shell("rheonet run -q scene.toml -o -").out == expected);

  folder.write("out.csv", std::string(100000, 'x'));
  const Finished to_file = folder.shell("rheonet run --quiet scene.toml --output out.csv");
  CHECK(to_file.status == 0);
  CHECK(to_file.out == "");
  CHECK(to_file.err == "");
  CHECK(folder.read("out.csv") == expected);
  CHECK(contains(folder.shell("rheonet run scene.toml -o out.csv").err, "to `out.csv`"));
}

TEST_CASE("--events writes what switches, and the summary counts it") {
  const Folder folder(switching);
  const Finished result = folder.shell("rheonet run scene.toml -o out.csv --events events.csv", 0);
  const std::string events = folder.read("events.csv");
  CAPTURE(events);
  CHECK(events.starts_with("time,element,event,direction\n0.1"));
  CHECK(contains(events, ",s1,slip,1\n0.25,hand,jump,-1\n0.25,s1,stick,0\n"));
  CHECK(lines(events) == 4);
  CHECK(contains(result.err, "events                             3  2 of `s1`, 1 of `hand`\n"));
  CHECK(folder.read("out.csv") == folder.shell("rheonet run -q scene.toml").out);
  CHECK(folder.shell("rheonet run -q scene.toml -o out.csv --events -").out == events);
  CHECK(contains(folder.shell("rheonet run --help").out, "--events"));
}

TEST_CASE("--profile says what the steps are spent on, beside the same rows") {
  const Folder folder(switching);
  const Finished plain = folder.shell("rheonet run scene.toml -q", 0), result = folder.shell("rheonet run scene.toml -q --profile", 0);
  CHECK(result.out == plain.out);
  CHECK(plain.err == "");
  CAPTURE(result.err);
  CHECK(contains(result.err, "what limits the steps"));
  CHECK(contains(result.err, "\n  s1 "));
  CHECK(contains(result.err, "\n  hand "));
  CHECK(contains(result.err, "steps by order: 1: "));
}

TEST_CASE("a run that fails leaves its events, and says so") {
  const Folder folder(overcome);
  const Finished result = folder.shell("rheonet run scene.toml -o out.csv --events events.csv", 1);
  CHECK(contains(result.err, "scene.toml:5:36: error: at t = 0.3 s nothing resists the force at node `end`"));
  CHECK(contains(result.err, "the 3 rows up to there are in `out.csv`"));
  CHECK(contains(result.err, "the 4 events up to there are in `events.csv`"));
  CHECK(lines(folder.read("events.csv")) == 5);
}

TEST_CASE("events that have no file of their own are refused before simulating; a full disk ends the run") {
  const Folder folder(switching);
  const auto run = [&folder](const std::string& options) { return folder.shell("rheonet run scene.toml " + options); };
  CHECK(run("--events -").status == 2);
  CHECK(contains(run("--events -").err, "`--output` and `--events` both write to standard output"));
  CHECK(run("-o out.csv --events ./out.csv").status == 2);
  CHECK_FALSE(folder.has("out.csv"));
  CHECK(contains(run("-o out.csv --events scene.toml").err, "`--events scene.toml` would overwrite the scene"));
  CHECK(run("-o out.csv --events none/events.csv").status == 2);
  CHECK_FALSE(folder.has("out.csv"));
  const Finished full = run("-o out.csv --events /dev/full");
  CHECK(full.status == 1);
  CHECK(contains(full.err, "cannot write to `/dev/full`: No space left on device"));
  CHECK(contains(full.err, "no event was written to `/dev/full`"));
  folder.write("bad.toml", contradictory);
  folder.write("events.csv", "earlier results\n");
  CHECK(folder.shell("rheonet run bad.toml -o out.csv --events events.csv").status == 1);
  CHECK(folder.read("events.csv") == "earlier results\n");
}

TEST_CASE("--accuracy wins over the scene") {
  const Folder folder(oscillator);
  folder.write("by_ida.toml", oscillator + "method = \"ida\"\n");
  const std::string coarse = folder.shell("rheonet run -q by_ida.toml --accuracy 1e-2").out;
  const std::string fine = folder.shell("rheonet run -q by_ida.toml --accuracy 1e-10").out;
  const auto last = [](const std::string& csv) {
    const std::size_t row = csv.rfind('\n', csv.size() - 2) + 1;
    return std::strtod(csv.c_str() + csv.find(',', row) + 1, nullptr);
  };
  const double exact = 1e-3 * std::cos(10.0);
  CHECK(std::abs(last(fine) - exact) < 1e-12);
  CHECK(std::abs(last(coarse) - exact) > std::abs(last(fine) - exact));
  for (const std::string senseless : {"0", "-1e-6", "2", "nan", "inf", "1e-300"}) {
    CAPTURE(senseless);
    const Finished result = folder.shell(std::string("rheonet run scene.toml --accuracy ") + senseless);
    CHECK(result.status == 2);
    CHECK(contains(result.err, "accuracy"));
    CHECK(result.out == "");
  }
}

TEST_CASE("a scene with mistakes: status 2, all of them listed, earlier results untouched") {
  const Folder folder(mistaken);
  folder.write("out.csv", "earlier results\n");
  const Finished result = folder.shell("rheonet run scene.toml -o out.csv", 2);
  CHECK(contains(result.err, "scene.toml:2:"));
  CHECK(contains(result.err, "did you mean `spring`?"));
  CHECK(contains(result.err, "scene.toml:3:"));
  CHECK(contains(result.err, "2 errors"));
  CHECK(folder.read("out.csv") == "earlier results\n");
  CHECK(folder.shell("rheonet run none.toml").status == 2);
}

TEST_CASE("a scene that cannot be simulated: status 1, elements named, earlier results untouched") {
  const Folder folder(contradictory);
  folder.write("out.csv", "earlier results\n");
  const Finished result = folder.shell("rheonet run scene.toml -o out.csv", 1);
  CHECK(result.err.starts_with("scene.toml:3:1: error: "));
  CHECK(contains(result.err, "left"));
  CHECK(contains(result.err, "right"));
  CHECK(folder.read("out.csv") == "earlier results\n");
  CHECK(folder.shell("rheonet run scene.toml -o new.csv").status == 1);
  CHECK_FALSE(folder.has("new.csv"));
}

TEST_CASE("an output that cannot be opened is found before simulating") {
  const Folder folder(endless);
  for (const std::string path : {"none/out.csv", "."}) {
    CAPTURE(path);
    const Finished result = folder.shell(std::string("timeout 20 rheonet run scene.toml -o ") + path);
    CHECK(result.status == 2);
    CHECK(contains(result.err, std::string("error: cannot write to `") + path + "`"));
  }
  for (const std::string path : {"scene.toml", "./scene.toml", "link.toml"}) {
    CAPTURE(path);
    const Finished result = folder.shell(std::string("ln -sf scene.toml link.toml; rheonet run scene.toml -o ") + path);
    CHECK(result.status == 2);
    CHECK(contains(result.err, "would overwrite the scene"));
    CHECK(folder.read("scene.toml") == endless);
  }
}

TEST_CASE("rows do not go into any file that the scene is made of") {
  const Folder folder(R"(include = ["parts.toml"]
[elements]
drive = { type = "motion", at = "a", velocity = { table = "drive.csv" } }
k = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
)");
  folder.write("parts.toml", "[models.m]\nports = [\"a\"]\nelements = { m = { type = \"mass\", at = \"a\", mass = 1 } }\n");
  folder.write("drive.csv", "0,0\n1,1\n");
  const auto run = [&](const std::string& words) { return folder.shell("rheonet run scene.toml " + words, 2).err; };
  CHECK(run("-o drive.csv") == "error: `--output drive.csv` would overwrite a table that the scene reads\n");
  CHECK(run("-o parts.toml") == "error: `--output parts.toml` would overwrite a file that the scene includes\n");
  CHECK(run("-o x.csv --events scene.toml") == "error: `--events scene.toml` would overwrite the scene itself\n");
}

TEST_CASE("a full disk and a reader that goes away stop the run") {
  const Folder folder(endless);
  const Finished full = folder.shell("timeout 60 rheonet run scene.toml -o /dev/full");
  CHECK(full.status == 1);
  CHECK(contains(full.err, "cannot write to `/dev/full`: No space left on device"));
  CHECK(full.err.find("No space left") == full.err.rfind("No space left"));
  const Finished piped = folder.shell("timeout 60 rheonet run scene.toml | head -n 3; exit ${PIPESTATUS[0]}");
  CHECK(piped.status == 1);
  CHECK(lines(piped.out) == 3);
  CHECK(contains(piped.err, "cannot write to standard output: Broken pipe"));
  folder.write("short.toml", oscillator);
  CHECK(folder.shell("rheonet run short.toml -o /dev/full").status == 1);
}

TEST_CASE("what a full disk cuts off ends with a whole row, and its rows are those that are told") {
  const Folder folder(endless);
  // A limit on the size of files ends a write in the middle, as a full disk does.
  for (const std::string output : {"-o out.csv", "-q > out.csv"}) {
    CAPTURE(output);
    const Finished full = folder.shell("ulimit -f 70; timeout 60 rheonet run scene.toml " + output, 1);
    const std::string rows = folder.read("out.csv");
    CHECK(contains(full.err, "File too large"));
    CHECK(rows.size() > 64 * 1024);
    CHECK(rows.size() < 70 * 1024);
    CHECK(rows.ends_with("\n"));
    CHECK(contains(full.err, "the " + std::to_string(lines(rows) - 1) + " rows up to there are in"));
  }
}

TEST_CASE("an interrupted run keeps its rows and says so") {
  const Folder folder(endless);
  for (const std::string signal : {"INT", "TERM"}) {
    CAPTURE(signal);
    const Finished result =
        folder.shell(std::string("timeout --foreground --preserve-status -s ") + signal + " 1 rheonet run scene.toml -o out.csv");
    CAPTURE(result.err);
    CHECK(result.status == 1);
    CHECK(contains(result.err, "interrupted"));
    CHECK(contains(result.err, "rows up to there are in `out.csv`"));
    const std::string rows = folder.read("out.csv");
    CHECK(rows.starts_with("time,block.position\n0,0.001\n"));
    CHECK(rows.ends_with("\n"));
    CHECK(contains(result.err, "the " + std::to_string(lines(rows) - 1) + " rows"));
  }
}

TEST_CASE("a long run shows its progress on a terminal and leaves no trace of it; a short one shows none") {
  const Folder folder(endless);
  folder.write("short.toml", oscillator);
  const auto on_terminal = [&folder](const std::string& command) {
    return folder.shell("script -qec '" + command + "' /dev/null").out;
  };
  const std::string bar = on_terminal("timeout --foreground -s INT 1.5 rheonet run scene.toml -o out.csv");
  CAPTURE(bar);
  CHECK(contains(bar, "\r["));
  CHECK(contains(bar, "left"));
  CHECK(contains(bar, "\r\x1b[Kerror: interrupted"));
  CHECK_FALSE(contains(on_terminal("timeout --foreground -s INT 1.5 rheonet run -q scene.toml -o out.csv"), "\r["));
  CHECK_FALSE(contains(on_terminal("timeout --foreground -s INT 1.5 rheonet run scene.toml"), "\r["));
  CHECK_FALSE(contains(on_terminal("rheonet run short.toml -o out.csv"), "\x1b"));
}

TEST_CASE("run --sensitivities adds the derivatives of the records") {
  const Folder folder(oscillator);
  const Finished result = folder.shell("rheonet run scene.toml --sensitivities k1.stiffness,block_mass.mass -o out.csv", 0);
  CHECK(contains(result.err, "largest derivative"));
  std::istringstream rows(folder.read("out.csv"));
  std::string header;
  std::getline(rows, header);
  CHECK(header == "time,block.position,k1.force,d(block.position)/dln k1.stiffness,d(k1.force)/dln k1.stiffness,"
                  "d(block.position)/dln block_mass.mass,d(k1.force)/dln block_mass.mass");
  double t = 0, x = 0, f = 0, by_k = 0, f_by_k = 0, by_m = 0, f_by_m = 0;
  char comma = 0;
  int count = 0;
  while (rows >> t >> comma >> x >> comma >> f >> comma >> by_k >> comma >> f_by_k >> comma >> by_m >> comma >> f_by_m) {
    const double exact = -1e-3 * std::sin(10 * t) * 5 * t;
    CHECK(std::abs(by_k - exact) < 1e-10);
    CHECK(std::abs(by_m + exact) < 1e-10);
    CHECK(std::abs(f_by_k - (f + 100 * exact)) < 1e-7);
    CHECK(std::abs(f_by_m + 100 * exact) < 1e-7);
    ++count;
  }
  CHECK(count == 11);
}

TEST_CASE("run --sensitivities says what cannot be multiplied, and writes nothing") {
  const Folder folder(oscillator);
  const Finished mistyped = folder.shell("rheonet run scene.toml --sensitivities k1.stifness -o out.csv", 2);
  CHECK(contains(mistyped.err, "the netlist gives no `stifness` that could be multiplied"));
  CHECK(contains(mistyped.err, "did you mean `stiffness`?"));
  const Finished times = folder.shell("rheonet run scene.toml --sensitivities simulate.stop -o out.csv", 1);
  CHECK(contains(times.err, "`simulate.stop` changes the times of the rows"));
  CHECK(contains(folder.shell("rheonet run scene.toml --sensitivities k1.stiffness --certify", 2).err, "--certify"));
}

}  // namespace rheonet::test::run_test
