// Every scene that comes with the project runs, and what it claims holds.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/read.hpp"
#include "core/network/advice.hpp"
#include "core/network/component.hpp"
#include "core/result/certify.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet::test::netlists_test {

namespace {

const std::filesystem::path folder = RHEONET_SOURCE_DIR "/netlists";

// A library holds models, not scenes; library_test.cpp runs those, tests/hard the hard cases.
std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto relative = std::filesystem::relative(entry.path(), folder);
    if (entry.path().extension() == ".toml" && *relative.begin() != "library" && *relative.begin() != "hard") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Records are what their scene says they are, to its accuracy.
void check_closed_forms(const Scene& scene, const Trajectory& trajectory) {
  for (const ExactRecord& form : scene.exact) {
    const std::size_t k = static_cast<std::size_t>(form.record);
    CAPTURE(scene.records[k].path);
    double off = 0, scale = 0;
    for (std::size_t i = 0; i < trajectory.rows.size(); ++i) {
      const double value = form.value(trajectory.times[i]);
      REQUIRE(std::isfinite(value));
      off = std::max(off, std::abs(trajectory.rows[i][k] - value));
      scale = std::max(scale, std::abs(value));
    }
    CHECK(off <= scene.accuracy * scale);
  }
}

ReadResult read_sound(const std::filesystem::path& file, ReadOptions options = {}) {
  options.model_folders = {folder};
  ReadResult read = read_scene(file, declarations(), options);
  for (const Diagnostic& diagnostic : read.diagnostics) FAIL_CHECK(format(diagnostic, read.sources));
  REQUIRE(read.scene);
  return read;
}

/// Runs a scene: it ends, its claims and closed forms hold, and no energy is missing.
void check_run(const Scene& scene) {
  Trajectory trajectory;
  CHECK_NOTHROW(trajectory = run_to_memory(scene));
  check_closed_forms(scene, trajectory);
  const Summary& summary = trajectory.summary;
  CHECK_GT(summary.steps, 0);
  for (std::size_t i = 0; i < summary.findings.size(); ++i)
    CHECK_MESSAGE(summary.findings[i].holds,
                  fmt::format("line {}: {:.10g}", scene.claims[i].spot.line, summary.findings[i].found));
  CHECK_LE(std::abs(summary.missing), 10 * scene.accuracy * summary.largest);
}

std::vector<std::filesystem::path> scenes_in(const char* place) {
  std::vector<std::filesystem::path> files = scenes();
  std::erase_if(files, [place](const auto& file) { return file.parent_path() != folder / place; });
  return files;
}

std::vector<std::filesystem::path> demos() { return scenes_in("teaching"); }

}  // namespace

TEST_CASE("no netlist that comes with the project, a hard one neither, gives reason for advice") {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".toml" || entry.path().string().find("/library/") != std::string::npos) continue;
    CAPTURE(entry.path().string());
    const ReadResult read = read_sound(entry.path());
    for (const Diagnostic& diagnostic : advice_on(*read.scene)) FAIL_CHECK(format(diagnostic, read.sources));
  }
}

TEST_CASE("Every netlist of the project runs, and its claims hold") {
  REQUIRE_GE(scenes().size(), 9);
  for (const std::filesystem::path& file : scenes()) {
    CAPTURE(file.string());
    const ReadResult read = read_sound(file);
    CHECK_FALSE(read.scene->title.empty());
    CHECK_GE(read.scene->output_intervals, 100);
    if (*std::filesystem::relative(file, folder).begin() == "thesis") CHECK_FALSE(read.scene->claims.empty());
    check_run(*read.scene);
  }
}

TEST_CASE("every demo says what it teaches, and claims it") {
  CHECK_GE(demos().size(), 10);
  for (const std::filesystem::path& file : demos()) {
    CAPTURE(file.string());
    const ReadResult read = read_sound(file);
    const Demo& demo = read.presentation.demo;
    for (const std::string& text : {demo.question, demo.change, demo.see, demo.why}) {
      CHECK_FALSE(text.empty());
      CHECK(text.find("  ") == std::string::npos);
      CHECK(text.find('\n') == std::string::npos);  // one paragraph each
    }
    CHECK_FALSE(demo.sliders.empty());
    CHECK_FALSE(read.presentation.plot.curves.empty());
    CHECK_FALSE(read.scene->claims.empty());
  }
}

// So that whoever turns it finds a number to turn, and not an expression.
TEST_CASE("a slider begins where its scene is, at a number") {
  for (const std::filesystem::path& file : demos()) {
    CAPTURE(file.string());
    const ReadResult read = read_sound(file);
    DiagnosticList mistakes(read.sources);
    const auto document = parse_toml(0, read.sources, mistakes);
    REQUIRE(document);
    for (const Demo::Slider& slider : read.presentation.demo.sliders) {
      CAPTURE(slider.parameter);
      const TomlValue& value = document->find("parameters")->value.find(slider.parameter)->value;
      const std::string text = value.is_string() ? value.text : fmt::format("{}", value.number);
      const auto at = evaluate_text(text, Environment{}), unit = evaluate_text("1 " + slider.unit, Environment{});
      REQUIRE(std::holds_alternative<Number>(at));
      const double size = slider.unit.empty() ? 1 : std::get<Number>(unit).value;
      CHECK(std::get<Number>(at).value >= slider.least * size * (1 - 1e-12));
      CHECK(std::get<Number>(at).value <= slider.most * size * (1 + 1e-12));
    }
  }
}

TEST_CASE("the page of the demos asks their questions") {
  std::ifstream stream(folder / "teaching/README.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  for (const std::filesystem::path& file : demos()) {
    const std::string row =
        fmt::format("| `{}` | {} |\n", file.filename().string(), read_sound(file).presentation.demo.question);
    CHECK_MESSAGE(page.find(row) != page.npos, row);
  }
}

TEST_CASE("what the demos claim holds at both ends of each slider") {
  for (const std::filesystem::path& file : demos()) {
    for (const Demo::Slider& slider : read_sound(file).presentation.demo.sliders) {
      for (const double value : {slider.least, slider.most}) {
        ReadOptions options;
        options.overrides = {fmt::format("parameters.{}={} {}", slider.parameter, value, slider.unit)};
        if (slider.unit.empty()) options.overrides[0].pop_back();
        CAPTURE(file.string());
        CAPTURE(options.overrides[0]);
        check_run(*read_sound(file, options).scene);
      }
    }
  }
}

TEST_CASE("what the demos claim holds at every accuracy that is asked for") {
  for (const double accuracy : {1e-2, 1e-4, 1e-8, 1e-10}) {
    for (const std::filesystem::path& file : demos()) {
      CAPTURE(file.string());
      CAPTURE(accuracy);
      ReadOptions options;
      options.accuracy = accuracy;
      check_run(*read_sound(file, options).scene);
    }
  }
}

TEST_CASE("the closed forms of the laws of the library hold at every accuracy, and certified") {
  CHECK_GE(scenes_in("laws").size(), 10);
  for (const std::filesystem::path& file : scenes_in("laws")) {
    CAPTURE(file.string());
    const ReadResult plain = read_sound(file);
    CHECK_FALSE(plain.scene->claims.empty());
    CHECK_FALSE(plain.presentation.plot.curves.empty());
    CHECK(certify(*plain.scene, {}).holds);
    for (const double accuracy : {1e-4, 1e-8}) {
      CAPTURE(accuracy);
      ReadOptions options;
      options.accuracy = accuracy;
      check_run(*read_sound(file, options).scene);
    }
  }
}

// The swing that begins with a slip returns to the belt's velocity, or falls short of it: at the border it touches it,
// having come round once (integrated backwards from there, in units of v and v/w).
TEST_CASE("stick-slip ends at the velocity that the demo gives") {
  const double zeta = 0.05, wd = std::sqrt(1 - zeta * zeta);
  const auto swing = [&](double t) {
    const double a = -2 * zeta, b = (1 + zeta * a) / wd;
    const double x = std::exp(-zeta * t) * (a * std::cos(wd * t) + b * std::sin(wd * t));
    return std::pair(x, -zeta * x + std::exp(-zeta * t) * wd * (b * std::cos(wd * t) - a * std::sin(wd * t)));
  };
  double early = -5.6, late = -5.4;  // the velocity is above 1, and below
  REQUIRE((swing(early).second > 1 && swing(late).second < 1));
  for (int k = 0; k < 60; ++k) (swing((early + late) / 2).second > 1 ? early : late) = (early + late) / 2;
  const double border = (6 - 4) / std::sqrt(400 * 1.0) / (swing(early).first + 2 * zeta);
  CHECK(border == doctest::Approx(2 / (0.911 * 20)).epsilon(1e-3));  // as the demo says
  for (const double factor : {0.999, 1.001}) {
    ReadOptions options;
    options.overrides = {fmt::format("parameters.v={} m/s", factor * border)};
    const Trajectory trajectory = run_to_memory(*read_sound(folder / "teaching/stick-slip.toml", options).scene);
    bool sticks_again = false;
    for (std::size_t i = 0; i < trajectory.rows.size(); ++i)
      sticks_again |= trajectory.times[i] > 1 && std::abs(trajectory.rows[i][1] - factor * border) < 1e-9;
    CHECK(sticks_again == (factor < 1));
  }
}

}  // namespace rheonet::test::netlists_test
