#include "tools/rheonet/certificate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/numerics.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/summary.hpp"
#include "tools/rheonet/table.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using Round = Certificate::Round;

double tighter(const Round& round) { return round.tolerance / numerics::certificate_ratio; }
std::string relative(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }
const std::string& path_of_worst(const Scene& scene, const Round& round) { return scene.records[round.worst].path; }

std::string table_of_records(const Scene& scene, const std::vector<RecordError>& errors) {
  Rows rows{{"record", "estimated error", "relative", "at", "largest magnitude"}};
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const RecordError& error = errors[k];
    const std::string unit = unit_text(scene, scene.records[k]);
    rows.push_back({scene.records[k].path, readable(error.largest, unit, 2), relative(error.relative()),
                    error.largest > 0 ? readable(error.time, "s") : "-", readable(error.scale, unit, 4)});
  }
  return aligned(rows);
}

std::string table_of_rounds(const Scene& scene, const Certificate& certificate) {
  Rows rows{{"run to", "measured by a run to", "estimated error", "of", "at"}};
  for (const Round& round : certificate.rounds) {
    rows.push_back({fmt::format("{:g}", round.tolerance), fmt::format("{:g}", tighter(round)),
                    relative(round.error.relative()), path_of_worst(scene, round), readable(round.error.time, "s")});
  }
  return aligned(rows);
}

std::string cost(const Certificate& certificate) {
  return fmt::format("{} runs, {} of CPU time together", certificate.runs, in_time_units(certificate.cpu_seconds));
}

/// Why the accuracy could not be certified, and the remedy.
std::string reason(const Certificate& certificate) {
  const std::vector<Round>& rounds = certificate.rounds;
  if (!certificate.obstacle.empty()) return "a tighter run does not come to its end: " + certificate.obstacle;
  if (rounds.size() == 1) return "double precision leaves no room for runs tight enough to know, or to do better";
  const Round &before = rounds[rounds.size() - 2], &last = rounds.back();
  if (last.error.relative() > numerics::certificate_own_error * before.error.relative())
    return fmt::format(
        "tightening the tolerance {:.0f} times gains little: differences as small as rounding grow in this scene, as in chaos, or "
        "where what happens hangs on the last digit of a value",
        before.tolerance / last.tolerance);
  return "each run is more accurate than the one before, but double precision leaves no room for a tighter one";
}

/// The failure in sentences, without the table of records.
std::string failure(const Scene& scene, const Certificate& certificate) {
  if (certificate.rounds.empty())
    return fmt::format("not certified: {}\n  the rows are those of a run to {:g}, whose error is not known\n",
                       wrapped(reason(certificate), 2), scene.accuracy);
  const Round& kept = certificate.result();
  return fmt::format("not certified: `{}` is off by an estimated {} of its largest magnitude, at {:g} s; the scene asks for {:g}\n",
                     path_of_worst(scene, kept), relative(kept.error.relative()), kept.error.time, scene.accuracy) +
         fmt::format("  before {:g} s all records are within that; the rows are those of a run to {:g}\n", certificate.until,
                     kept.tolerance) +
         (certificate.imbalance ? fmt::format("  {}\n", wrapped(rheonet::describe(scene, *certificate.imbalance), 2)) : "") +
         fmt::format("  {}\n{}  {}\n", wrapped(reason(certificate), 2), table_of_rounds(scene, certificate), cost(certificate));
}

}  // namespace

std::string describe(const Scene& scene, const Certificate& certificate) {
  if (!certificate.holds) return failure(scene, certificate);
  const Round& kept = certificate.result();
  return fmt::format("certified: every record is within {:g} of its largest magnitude\n", scene.accuracy) +
         (certificate.summary.arc_steps > 0 && certificate.summary.arc_steps == certificate.summary.steps
              ? fmt::format("  solved in closed form between events, measured by a run of IDA to {:g}; {}\n", tighter(kept), cost(certificate))
              : fmt::format("  a run to {:g}, measured by a run to {:g}; {}\n", kept.tolerance, tighter(kept), cost(certificate)));
}

bool report_certificate(const Scene& scene, const Certificate& certificate, bool quiet) {
  if (!certificate.holds) say("error: {}", failure(scene, certificate));
  if (quiet || certificate.rounds.empty()) return certificate.holds;
  if (certificate.holds) say("{}", describe(scene, certificate));
  say("{}", table_of_records(scene, certificate.errors));
  return certificate.holds;
}

}  // namespace rheonet::tool
