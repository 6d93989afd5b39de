#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/numerics.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/explanation.hpp"
#include "tools/rheonet/reading.hpp"

namespace rheonet::tool {

namespace {

std::string numerics_as_text() {
  std::string text, heading;
  for (const numerics::Parameter& p : numerics::parameters()) {
    if (p.heading != heading) text += fmt::format("{}{}\n", heading.empty() ? "" : "\n", p.heading);
    heading = p.heading;
    text += fmt::format("  {} = {} [{}]\n    {}\n    {}\n", p.name, fmt::join(p.values, ", "), p.unit, p.meaning, p.reason);
  }
  return text;
}

std::string numerics_as_json() {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const numerics::Parameter& p : numerics::parameters()) {
    all.push_back({{"name", p.name}, {"values", p.values}, {"unit", p.unit}, {"meaning", p.meaning}, {"reason", p.reason}, {"heading", p.heading}});
  }
  return all.dump(2) + "\n";
}

}  // namespace

ExitStatus explain_scene(const Arguments& arguments) {
  if (arguments.numerics) {
    fmt::print("{}", arguments.json ? numerics_as_json() : numerics_as_text());
    return done;
  }
  const ReadResult read = read_and_report(arguments.scene, options_of(arguments));
  if (!read.scene) return wrong_input;
  try {
    const Explanation explanation = explain(*read.scene);
    fmt::print("{}", arguments.json ? to_json(*read.scene, explanation) : describe(*read.scene, arguments.scene, explanation));
  } catch (const SimulationError& error) {
    report(error, read.sources);
    return not_simulated;
  }
  return done;
}

}  // namespace rheonet::tool
