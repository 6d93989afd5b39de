#include "tools/rheonet/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/rheonet/say.hpp"
#include "tools/rheonet/table.hpp"

namespace rheonet::tool {
namespace {

using Figure = Claim::Figure;

std::string with_unit(double value, const std::string& unit) { return readable(value, unit, 10); }

const Record& record_of(const Scene& scene, int index) { return scene.claimed[static_cast<std::size_t>(index)]; }

std::string unit_of(const Record& record, const Scene& scene) {
  return unit_text(scene, record);
}

}  // namespace

std::string unit_of_claim(const Claim& claim, const Scene& scene) {
  if (is_time(claim.figure)) return "s";
  const Record& record = record_of(scene, claim.record);
  if (claim.per < 0) return unit_of(record, scene);
  const Dimension dimension = rheonet::unit_of(scene, record).dimension /
                              rheonet::unit_of(scene, record_of(scene, claim.per)).dimension;
  // Print a damping in N*s/m rather than kg/s.
  for (const Quantity known : {Quantity::number, Quantity::stiffness, Quantity::damping, Quantity::time})
    if (dimension.same(dimension_of(known, domain_of(scene, record)))) return rheonet::unit_of(known, domain_of(scene, record));
  return to_string(dimension);
}

namespace {

/// As in "k1.force at 0.2 s", "largest k1.force from 1 s to 2 s".
std::string name_of_claim(const Claim& claim, const Scene& scene) {
  const Record& record = record_of(scene, claim.record);
  std::string path = record.path;
  if (claim.per >= 0) path += " / " + record_of(scene, claim.per).path;
  std::string window;
  if (claim.from != scene.start) window += fmt::format(" from {:.10g} s", claim.from);
  if (claim.to != scene.stop) window += fmt::format(" to {:.10g} s", claim.to);
  switch (claim.figure) {
    case Figure::at:
      return fmt::format("{} at {:.10g} s", path, claim.time);
    case Figure::final:
      return path + " at the end";
    case Figure::max:
      return "largest " + path + window;
    case Figure::min:
      return "smallest " + path + window;
    case Figure::mean:
      return "mean of " + path + window;
    case Figure::rms:
      return "root mean square of " + path + window;
    case Figure::time_of_max:
      return "time of the largest " + path + window;
    case Figure::time_of_min:
      return "time of the smallest " + path + window;
    case Figure::crossing:
      break;
  }
  return fmt::format("time at which {} crosses {}{}", path, with_unit(claim.level, unit_of(record, scene)), window);
}

std::string claimed_of(const Claim& claim, const Finding& finding, const std::string& unit) {
  if (claim.least != claim.most)
    return fmt::format("between {} and {}", with_unit(claim.least, unit), with_unit(claim.most, unit));
  return fmt::format("{} within {}", with_unit(claim.least, unit), readable(finding.tolerance, unit, 3));
}

}  // namespace

ClaimInWords in_words(const Scene& scene, const Claim& claim, const Finding& finding) {
  const std::string unit = unit_of_claim(claim, scene);
  const std::string never = claim.per < 0 ? "never comes" : "is no number";
  return {name_of_claim(claim, scene), claimed_of(claim, finding, unit),
          std::isnan(finding.found) ? never : with_unit(finding.found, unit), finding.holds};
}

bool report_claims(const Scene& scene, const Summary& summary, const Sources& sources, bool quiet) {
  bool all_hold = true;
  for (std::size_t i = 0; i < scene.claims.size(); ++i) {
    const Claim& claim = scene.claims[i];
    const Finding& finding = summary.findings[i];
    const std::string unit = unit_of_claim(claim, scene);
    const auto [name, claimed, found, holds] = in_words(scene, claim, finding);
    if (holds) {
      if (!quiet) say("  holds: {} is {}, claimed {}\n", name, found, claimed);
      continue;
    }
    all_hold = false;
    std::string message = fmt::format("the claim fails: {} ", name);
    if (std::isnan(finding.found)) {
      message += fmt::format("{}, claimed {}", found, claimed);
    } else {
      const double off = std::max(claim.least - finding.found, finding.found - claim.most);
      message += fmt::format("is {}, claimed {}: it is off by {}", found, claimed, readable(off, unit, 3));
    }
    say("{}\n", format({.severity = Severity::error, .spot = claim.spot, .message = message, .hint = {}}, sources));
  }
  return all_hold;
}

}  // namespace rheonet::tool
