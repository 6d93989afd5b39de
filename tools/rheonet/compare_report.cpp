#include "tools/rheonet/compare_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/table.hpp"

namespace rheonet::tool {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string relative_text(double value) { return value == 0 ? "0" : fmt::format("{:.2e}", value); }

std::string unit_of(const Compared& compared, const Pairing& pairing) {
  const Scene& first = compared.scenes.front();
  return unit_text(first, first.records[compared.columns.front().at(pairing.front())]);
}

std::string list_of_scenes(const Compared& compared) {
  std::size_t width = 0;
  for (const std::string& file : compared.files) width = std::max(width, count_characters(printable(file)));
  std::string text;
  for (std::size_t i = 0; i < compared.scenes.size(); ++i) {
    const std::string file = printable(compared.files[i]), title = printable(compared.scenes[i].title);
    text += fmt::format("  {} = {}", letter(i), file);
    if (!title.empty()) text += fmt::format("{:<{}}  \"{}\"", "", width - count_characters(file), title);
    text += '\n';
  }
  return text;
}

std::string energy_line(const Compared& compared, std::size_t other) {
  const double a = compared.trajectories.front().summary.dissipated, b = compared.trajectories[other].summary.dissipated;
  const double larger = std::max(std::abs(a), std::abs(b));
  std::string text = fmt::format("  energy dissipated: A {}, {} {}", readable(a, "J"), letter(other), readable(b, "J"));
  if (b == a) return text + ", the same\n";
  return text + fmt::format("; {} {} {}, {} of the larger\n", letter(other), readable(std::abs(b - a), "J"),
                            b > a ? "more" : "less", relative_text(std::abs(b - a) / larger));
}

}  // namespace

std::string letter(std::size_t scene) { return std::string(1, static_cast<char>('A' + scene)); }

std::string name_of(const Pairing& pairing, std::size_t other) {
  return pairing[other] == pairing.front() ? pairing.front() : pairing.front() + " / " + pairing[other];
}

std::string describe(const Compared& compared) {
  const Scene& first = compared.scenes.front();
  std::string text = list_of_scenes(compared);
  text += fmt::format("  {:g} s to {:g} s, {} rows, {:g} s apart\n", first.start, first.stop,
                      compared.trajectories.front().times.size(), first.output_every);
  for (std::size_t other = 1; other < compared.scenes.size(); ++other) {
    text += fmt::format("\n{} against A\n", letter(other));
    Rows rows{{"record", "largest difference", "relative", "at", "A is", letter(other) + " is", "rms difference",
               "relative"}};
    for (std::size_t p = 0; p < compared.pairings.size(); ++p) {
      const Difference& d = compared.differences[other - 1][p];
      const std::string unit = unit_of(compared, compared.pairings[p]);
      rows.push_back({name_of(compared.pairings[p], other), readable(d.largest, unit), relative_text(d.relative()),
                      d.largest == 0 ? "-" : readable(d.time, "s"), readable(d.first, unit), readable(d.second, unit),
                      readable(d.rms, unit), relative_text(d.relative_rms())});
    }
    text += aligned(rows) + energy_line(compared, other);
  }
  double accuracy = 0;
  for (std::size_t other = 1; other < compared.scenes.size(); ++other)
    accuracy = std::max(accuracy, first.accuracy + compared.scenes[other].accuracy);
  text += fmt::format(
      "\nRelative: to the largest magnitude that either has in the run. A relative difference up to {:g} may be\n"
      "that of the accuracy asked for.\n",
      accuracy);
  return text;
}

std::string overlay(const Compared& compared) {
  std::string text = "time";
  std::vector<std::vector<std::size_t>> columns;
  for (const Pairing& pairing : compared.pairings) {
    columns.emplace_back();
    for (std::size_t i = 0; i < compared.scenes.size(); ++i) {
      columns.back().push_back(compared.columns[i].at(pairing[i]));
      text += fmt::format(",{}.{}", letter(i), pairing[i]);
    }
  }
  text += '\n';
  const Trajectory& first = compared.trajectories.front();
  for (std::size_t row = 0; row < first.rows.size(); ++row) {
    text += fmt::format("{}", first.times[row]);
    for (const auto& of_pairing : columns)
      for (std::size_t i = 0; i < of_pairing.size(); ++i)
        fmt::format_to(std::back_inserter(text), ",{}", compared.trajectories[i].rows[row][of_pairing[i]] + 0.0);
    text += '\n';
  }
  return text;
}

std::string describe(const std::string& path, const std::vector<Varied>& rows, const Compared& compared) {
  std::string text = list_of_scenes(compared);
  for (std::size_t other = 1; other < compared.scenes.size(); ++other) {
    for (std::size_t p = 0; p < compared.pairings.size(); ++p) {
      const std::string unit = unit_of(compared, compared.pairings[p]);
      text += fmt::format("\n{} against A: {}\n", letter(other), name_of(compared.pairings[p], other));
      Rows cells{{path, "largest difference", "relative", "at", "rms difference", "relative", "A dissipates",
                  letter(other) + " dissipates"}};
      for (const Varied& row : rows) {
        const Difference& d = row.differences[other - 1][p];
        cells.push_back({row.value, readable(d.largest, unit), relative_text(d.relative()),
                         d.largest == 0 ? "-" : readable(d.time, "s"), readable(d.rms, unit),
                         relative_text(d.relative_rms()), readable(row.dissipated.front(), "J"),
                         readable(row.dissipated[other], "J")});
      }
      text += aligned(cells);
    }
  }
  text += "\nRelative: to the largest magnitude that either has in the run.\n";
  return text;
}

std::string table(const std::string& path, const std::vector<Varied>& rows, const Compared& compared) {
  std::string text = path;
  for (std::size_t other = 1; other < compared.scenes.size(); ++other)
    for (const Pairing& pairing : compared.pairings)
      for (const char* figure : {"largest", "relative", "time", "rms", "relative_rms"})
        text += fmt::format(",{}.{} {}", letter(other), pairing[other], figure);
  for (std::size_t i = 0; i < compared.scenes.size(); ++i) text += fmt::format(",{} dissipated", letter(i));
  text += '\n';
  for (const Varied& row : rows) {
    text += row.value;  // Has no comma, because lists are split at commas.
    for (const auto& of_scene : row.differences)
      for (const Difference& d : of_scene)
        text += fmt::format(",{},{},{},{},{}", d.largest, d.relative(), d.time, d.rms, d.relative_rms());
    for (const double joules : row.dissipated) text += fmt::format(",{}", joules);
    text += '\n';
  }
  return text;
}

std::string verdict(double within, const Furthest& furthest, const std::string& varied) {
  const bool holds = furthest.difference.relative() <= within;
  std::string text = fmt::format(
      "{} {:g}: `{}` differs by {}{} of its largest magnitude", holds ? "within" : "NOT within", within, furthest.name,
      furthest.difference.largest > 0 ? "up to " : "", relative_text(furthest.difference.relative()));
  if (furthest.difference.largest > 0) text += fmt::format(", at {:g} s", furthest.difference.time);
  if (!varied.empty()) text += fmt::format(", with {} = {}", varied, furthest.value);
  return text + '\n';
}

}  // namespace rheonet::tool
