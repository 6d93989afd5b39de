#include "tools/rheonet/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/rheonet/table.hpp"

namespace rheonet::tool {
namespace {

std::string grouped(long n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3 + (n < 0 ? 1u : 0u); i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

// The names of the few elements with the most events.
std::string busiest(const std::vector<Summary::Switched>& switched) {
  constexpr std::size_t few = 4;
  const std::size_t named = switched.size() <= few ? switched.size() : few - 1;
  std::string text;
  for (std::size_t k = 0; k < named; ++k) {
    text += fmt::format("{}{} of `{}`", k ? ", " : "", grouped(switched[k].times), switched[k].element);
  }
  long others = 0;
  for (std::size_t k = named; k < switched.size(); ++k) others += switched[k].times;
  const long elements = static_cast<long>(switched.size() - named);
  if (elements > 0) text += fmt::format(", {} of {} others", grouped(others), grouped(elements));
  return text;
}

}  // namespace

std::string in_time_units(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.0f} us", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:#.3g} ms", seconds * 1e3);
  if (seconds < 120) return fmt::format("{:#.3g} s", seconds);
  const long whole = std::lround(seconds);
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

std::string describe(const Summary& s, long rows, const std::string& destination) {
  std::string text;
  const auto line = [&text](const char* label, const std::string& value, const std::string& remark) {
    text += fmt::format("  {:<22}{:>14}{}{}\n", label, value, remark.empty() ? "" : "  ", remark);
  };
  const auto energy = [&line](const char* label, double joules, const std::string& remark) {
    if (!std::isfinite(joules)) return line(label, "too large", "for a number of double precision");
    line(label, fmt::format("{:.6g}", joules), "J" + remark);
  };

  line("rows", grouped(rows), "to " + destination);
  line("unknowns", grouped(s.unknowns),
       s.unknowns == 0 ? "all motion is prescribed, or held by friction"
       : s.arc_steps == s.steps && s.steps > 0 ? "linear between events: solved in closed form"
       : s.sparse      ? "sparse linear algebra (KLU)"
                       : "dense linear algebra");
  if (s.parts > 1) line("independent parts", grouped(s.parts), "each with steps of its own: the figures are their sums");
  line("steps", grouped(s.steps), fmt::format("{} rejected{}", grouped(s.rejected_steps),
                                                 s.arc_steps > 0 && s.arc_steps < s.steps ? fmt::format(", {} in closed form", grouped(s.arc_steps)) : ""));
  line("residual evaluations", grouped(s.residual_evaluations), "");
  line("Jacobian evaluations", grouped(s.jacobian_evaluations), "");
  line("events", grouped(s.events), busiest(s.switched));
  line("starts", grouped(s.restarts), "of the integrator: the first, and those that events made necessary");
  line("wall time", in_time_units(s.wall_seconds), "");
  line("CPU time", in_time_units(s.cpu_seconds), "");
  energy("energy supplied", s.supplied, "");
  energy("energy stored", s.stored, "  gained since the start");
  energy("energy dissipated", s.dissipated, "");
  energy(
      "energy missing", s.missing,
      s.largest > 0 ? fmt::format("  {:.1e} of the largest energy in the run", std::abs(s.missing) / s.largest) : "");
  for (const std::string& note : s.notes) text += fmt::format("  note: {}\n", note);
  return text;
}

std::string describe_profile(const Summary& summary) {
  constexpr std::size_t most = 16;
  std::vector<std::vector<std::string>> rows{
      {"what limits the steps", "", "steps", "share", "too large an error", "not solved", "switches", "starts"}};
  const double all = static_cast<double>(std::max(summary.steps, 1L));
  const auto line = [&](const std::string& name, const std::string& kind, const Summary::Profiled& p) {
    rows.push_back({name, kind, grouped(p.steps), fmt::format("{:.1f} %", 100 * static_cast<double>(p.steps) / all),
                    grouped(p.rejected), grouped(p.diverged), grouped(p.switched), grouped(p.starts)});
  };
  Summary::Profiled rest;
  long left_out = 0;
  for (const Summary::Profiled& p : summary.profile) {
    if (p.name.empty()) {
      if (p.steps + p.rejected + p.diverged + p.starts > 0) line("nobody", "", p);
    } else if (rows.size() <= most) {
      line(p.name, p.node ? "node" : "element", p);
    } else {
      ++left_out;
      rest.steps += p.steps;
      rest.rejected += p.rejected;
      rest.diverged += p.diverged;
      rest.switched += p.switched;
      rest.starts = std::max(rest.starts, p.starts);  // One start may be attributed to several elements.
    }
  }
  if (left_out > 0) line(fmt::format("{} others", left_out), "", rest);
  std::string text = aligned(rows) + "  steps by order:";
  for (std::size_t order = 1; order < summary.steps_of_order.size(); ++order) {
    text += fmt::format(" {}: {}", order, grouped(summary.steps_of_order[order])) +
            (order + 1 < summary.steps_of_order.size() ? "," : "\n");
  }
  return text;
}

}  // namespace rheonet::tool
