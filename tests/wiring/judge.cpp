#include "tests/wiring/judge.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/network/component.hpp"
#include "tests/support/reference_integrator.hpp"
#include "tests/support/simulate.hpp"
#include "tests/wiring/agreement.hpp"
#include "tests/wiring/overload.hpp"
#include "tests/wiring/refusals.hpp"
#include "tests/wiring/sticking.hpp"

namespace rheonet::test {

namespace {

// Smallest fraction of certain values for a verdict.
constexpr double enough = 0.5;
// Allowed difference between the ends of a refused run and of the reference, as a fraction of the run's length: some steps of the reference.
constexpr double same_end = 3e-3;
// The dependence of the deviation on the reference's step is significant above this fraction of the scale. (If its longest steps are already
// as close, the deviation of its shortest steps is round-off, within its own estimate.)
constexpr double told = 1e-5;

/// Contradiction between the bounds of the forces and the reference; "" if they agree.
std::string contradiction(const Scene& scene, const ReferenceSolution& reference) {
  const double slack = same_end * (scene.stop - scene.start);
  const std::optional<double> might = first_above(scene, &Capacity::sliding, 1 - 1e-6);
  const std::optional<double> must = first_above(scene, &Capacity::sticking, 1 + 1e-6);
  if (!reference.complete && !(might && reference.end >= *might - slack)) {
    return fmt::format("the reference stops at {:.6g} s, before the friction is overloaded", reference.end);
  }
  if (must && (reference.complete || reference.end > *must + slack)) {
    return fmt::format("the reference goes on beyond {:.6g} s, where the friction is overloaded", *must);
  }
  return "";
}

/// Whether the run was refused for an overload, and the capacity alone shows that the scene cannot continue there.
bool beyond_bounds(const Scene& scene, const std::string& refusal) {
  const std::optional<double> must = first_above(scene, &Capacity::sticking, 1 + 1e-6);
  return must && says(refusal, overload) && std::abs(time_in(refusal) - *must) <= same_end * (scene.stop - scene.start);
}

/// Judges the end of the run. Returns "" if it ended like the reference, else the error.
std::string wrong_end(const Scene& scene, const std::string& refusal, const ReferenceSolution& reference) {
  if (reference.complete) return refusal.empty() ? "" : "refused: " + refusal;
  const std::string expected = fmt::format("{} at {:.6g} s", overload.name, reference.end);
  if (refusal.empty()) return "not refused, though there is " + expected;
  double t = time_in(refusal);
  if (std::isnan(t)) t = scene.start;
  const bool names = refusal.find("`end`") != std::string::npos || refusal.find("`n") != std::string::npos;
  if (!says(refusal, overload) || !names || !(std::abs(t - reference.end) <= same_end * (scene.stop - scene.start))) {
    return fmt::format("refused for another reason than {}: {}", expected, refusal);
  }
  return "";
}

Judgement beside(const Scene& scene, const Attempt& run, const ReferenceSolution& reference) {
  const Agreement found = agreement(scene, run.rows, reference);
  Judgement result{.verdict = Verdict::wrong,
                   .deviation = found.deviation,
                   .judged = found.judged,
                   .reference_steps = reference.steps,
                   .text = found.where};
  if (found.worst > 1) {
    result.text = fmt::format("off by {:.3g} times what is allowed: {}", found.worst, found.where);
  } else if (reference.fork < reference.end) {
    result.verdict = run.refusal.empty() || says(run.refusal, overload) ? Verdict::open : Verdict::wrong;
    result.text = run.refusal;
  } else if (!reference.complete && says(run.refusal, blocked) &&
             std::abs(time_in(run.refusal) - reference.end) <= same_end * (scene.stop - scene.start)) {
    result.verdict = Verdict::refused;
  } else if (const std::string why = contradiction(scene, reference); !why.empty()) {
    result.text = why;
    result.verdict = beyond_bounds(scene, run.refusal) ? Verdict::refused : Verdict::undecided;
  } else if (const std::string end = wrong_end(scene, run.refusal, reference); !end.empty()) {
    result.text = end;
  } else if (found.from_coarse > told && found.from_fine > told && found.from_fine > 0.5 * found.from_coarse) {
    result.text = fmt::format("the reference comes no nearer with its step: {:.2g} after {:.2g}", found.from_fine,
                              found.from_coarse);
  } else if (!reference.complete) {
    result.verdict = Verdict::refused;
  } else if (found.judged < enough) {
    result.verdict = Verdict::undecided;
    result.text = fmt::format("only {:.0f} % of the reference's values are sure", 100 * found.judged);
  } else {
    result.verdict = Verdict::agrees;
  }
  return result;
}

}  // namespace

Judgement judge(const Wiring& wiring, bool closer) {
  const Scene scene = scene_of(netlist_of(wiring), closer ? 1e-9 : 0);
  const Attempt run = attempt(scene);
  Judgement result;
  if (says(run.refusal, jammed)) return {.verdict = Verdict::refused, .text = run.refusal};
  // The reference does not determine how sticking sliders share a load; balance and least norm do.
  result.text = wrong_sticking(scene, run.rows);
  if (!result.text.empty()) return result;
  const auto judged_with = [&](const ReferenceSettings& settings) { return beside(scene, run, integrate_reference(scene, declarations(), settings)); };
  for (const int more : {closer ? 4 : 0, 2, 4}) {
    ReferenceSettings settings;
    settings.halvings += more;
    // A retry needs a tighter target, otherwise it would accept the same solution.
    if (more > 0) settings.target *= 1e-2;
    result = judged_with(settings);
    const bool refused_without_need = !run.refusal.empty() && !says(run.refusal, overload);
    if (closer || refused_without_need || (result.verdict != Verdict::wrong && result.verdict != Verdict::undecided)) break;
  }
  // A turn that lies badly between the steps may have stopped the reference, or have hidden its errors from it.
  if (result.verdict == Verdict::undecided) result = judged_with({.base_steps = 600});
  return result;
}

}  // namespace rheonet::test
