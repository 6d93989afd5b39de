#include "tests/wiring/identities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/network/component.hpp"
#include "core/network/reductions.hpp"
#include "tests/support/reference_integrator.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/slider_bounds.hpp"
#include "tests/wiring/agreement.hpp"
#include "tests/wiring/refusals.hpp"
#include "tests/wiring/seen_differently.hpp"

namespace rheonet::test {

namespace {

// Tolerance of the energy as a multiple of the accuracy.
constexpr double of_energy = 10;
constexpr double slip_rounding = 1e-12;
// Allowed difference between the ends of two refused runs, as a fraction of the run's length.
constexpr double same_end_of_views = 1e-4;
// A record below the fraction `negligible` of the largest of its kind is 0 except for round-off. `least_scale`: smallest scale [m | m/s | N].
constexpr double negligible = 1e-6, least_scale = 1e-3;
// Values of the scenes are near 1: energies below this are those of round-off, in a scene at rest [J].
constexpr double least_energy = 1e-20;
// Digits that a sum, or a ratio of a gear, may lose.
constexpr double ulps = 4 * std::numeric_limits<double>::epsilon();
// Records below the fraction `little` of the largest of their kind come from tiny motions, such as a slip of nanometres at the peak of a
// force, which depend on the last digits of the accuracy. A run with an accuracy tighter by the factor `finer` judges these.
constexpr double little = 1e-4, finer = 1e-3;

double parameter(const SceneElement& e, const std::string& name) {
  const std::vector<Parameter>& parameters = declarations()[static_cast<std::size_t>(e.declaration)]->parameters;
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  return found == parameters.end() ? std::nan("") : e.values[static_cast<std::size_t>(found - parameters.begin())];
}

/// Refusals for a physical reason, which the comparison with the reference judges.
bool expected(const std::string& refusal) { return says(refusal, overload) || says(refusal, blocked) || says(refusal, jammed); }

Scene first_half(Scene scene) {
  scene.output_intervals /= 2;
  scene.stop = scene.start + scene.output_every * static_cast<double>(scene.output_intervals);
  return scene;
}

/// Judges the energy account of a whole run and of its first half. Returns "" or the error.
std::string wrong_energy(const Scene& scene, const Summary& whole, const Summary& half) {
  const double allowed = of_energy * scene.accuracy * std::max(whole.largest, least_energy);
  if (!(std::abs(whole.missing) <= allowed)) {
    return fmt::format("energy: {:.3g} J of {:.3g} J missing", whole.missing, whole.largest);
  }
  // Dissipated energy never decreases: a run of half the length has dissipated no more.
  if (!(half.dissipated >= -allowed && whole.dissipated >= half.dissipated - allowed)) {
    return fmt::format("dissipation: {:.9g} J in the first half, {:.9g} J in all", half.dissipated, whole.dissipated);
  }
  return "";
}

/// The force of a slider that slips with this velocity.
double sliding_force(const SceneElement& slider, const SliderBounds& bounds, double velocity) {
  const double speed = parameter(slider, "stribeck");
  if (std::isnan(speed)) return bounds.coulomb;
  const double Fc = parameter(slider, "coulomb"), shape = parameter(slider, "shape");
  return Fc + StribeckCurve{Fc, bounds.breakaway, speed, shape}.above(std::abs(velocity));
}

/// Judges the bounds of friction. Returns "" or the place of a violation.
std::string wrong_friction(const Scene& scene, const RunTable& rows) {
  // In a moving frame, relative velocities of 0 are differences of two velocities, and have their round-off.
  double fastest = 0;
  for (const auto& [path, column] : rows.columns) {
    if (path.ends_with(".velocity")) fastest = std::max(fastest, rows.scale(path));
  }
  for (const SceneElement& e : scene.elements) {
    const std::string& type = declarations()[static_cast<std::size_t>(e.declaration)]->type;
    if (type != "slider" && type != "sfm" && type != "cfm") continue;
    if (!rows.columns.contains(e.name + ".force") || !rows.columns.contains(e.name + ".velocity")) continue;
    const auto bounds = [&](double t) {
      if (type == "slider") return slider_bounds(e, [t](const Signal& signal) { return signal.value(t); });
      return SliderBounds{parameter(e, "coulomb"), parameter(e, "coulomb")};
    };
    const std::vector<double>&force = rows[e.name + ".force"], &velocity = rows[e.name + ".velocity"];
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double f = force[i], w = velocity[i];
      const SliderBounds now = bounds(rows.time()[i]);
      const bool slips = type == "slider" && std::abs(w) > ulps * fastest;
      const double Fc = slips ? sliding_force(e, now, w) : now.coulomb, Fs = now.breakaway;
      // Bounds that vary are computed once here and once there, and instants of sticking are as exact as the accuracy.
      const double varies = e.signals.empty() && Fc == now.coulomb ? 0 : 1e-12 * Fs;
      const double rounding = type == "cfm" ? of_accuracy * scene.accuracy * Fc : e.signals.empty() ? 0 : of_accuracy * scene.accuracy * std::max(1.0, Fs);
      // A slipping slider has its sliding force, to the round-off of a spring that carries the same force.
      const bool slides = Fc == 0 ? f == 0 : f * w > 0 && std::abs(f) <= Fc * (1 + ulps) + varies && std::abs(f) >= Fc * (1 - slip_rounding) - varies;
      // A slider about to slip may exceed its bound by the round-off of a balance: its force follows from its neighbours.
      if (slips ? slides : std::abs(f) <= Fs * (1 + slip_rounding) + rounding) continue;
      return fmt::format("friction: {} of {:.17g} at t = {:.6g}, where its velocity is {:.3g}, bound {:.17g}",
                         e.name, f, rows.time()[i], w, slips ? Fc : Fs);
    }
  }
  return "";
}

/// The largest difference between a run and the same run in another view, relative to the scale, with its place, and the time of the first
/// difference beyond the tolerance.
struct Difference {
  double worst = 0;
  std::string where;
  double first = std::numeric_limits<double>::infinity();
  bool of_little = true;  ///< Only records below the fraction `little` of their kind exceed the tolerance.
};

std::string channel_of(const std::string& path) {
  const std::string channel = path.substr(path.rfind('.') + 1);
  return channel == "displacement" ? "position" : channel;
}

Difference difference(const View& view, const RunTable& original, const RunTable& seen, double allowed) {
  Difference result;
  std::map<std::string, double> largest;
  for (const View::Column& column : view.columns) {
    double& kind = largest[channel_of(column.original)];
    kind = std::max({kind, original.scale(column.original), least_scale});
  }
  for (const View::Column& column : view.columns) {
    const std::vector<double>&from = original[column.original], &to = seen[column.path];
    const std::size_t count = std::min(from.size(), to.size());
    double scale = negligible * largest[channel_of(column.original)];
    // The scale of the quantity in this view: a moving frame adds to it.
    for (double x : to) scale = std::max(scale, std::abs(x / column.factor));
    for (std::size_t i = 0; i < count; ++i) {
      const double back = (to[i] - column.offset - column.rate * seen.time()[i]) / column.factor;
      const double off = std::abs(back - from[i]);
      if (off > allowed * scale) {
        result.first = std::min(result.first, original.time()[i]);
        result.of_little = result.of_little && scale < little * largest[channel_of(column.original)];
      }
      if (!(off > result.worst * scale)) continue;
      result.worst = off / scale;
      result.where = fmt::format("{} at row {}, t = {:.6g}: {:.9g} becomes {:.9g} (scale {:.3g})", column.original, i,
                                 original.time()[i], from[i], back, scale);
    }
  }
  return result;
}

/// The same for a run with an accuracy tighter by the factor `finer`.
Difference finer_difference(const View& view, const Scene& scene) {
  Scene original = scene, other = view.scene;
  original.accuracy = other.accuracy = finer * scene.accuracy;
  const Attempt run = attempt(original), seen = attempt(other);
  if (run.rows.header.empty() || seen.rows.header.empty() || !run.refusal.empty() || !seen.refusal.empty()) return {.worst = 1, .where = "at a finer accuracy: refused"};
  return difference(view, run.rows, seen.rows, of_accuracy * original.accuracy);
}

/// Judges the end of a run in another view. Returns "" or the error.
std::string wrong_end(const View& view, const Scene& scene, const std::string& refusal, const std::string& seen) {
  if (refusal.empty() != seen.empty()) return refusal.empty() ? "refused: " + seen : "not refused";
  if (refusal.empty()) return "";
  const double t = time_in(refusal), u = time_in(seen) / view.time;
  const bool same = std::isnan(t) || std::isnan(u) ? std::isnan(t) == std::isnan(u)
                                                   : std::abs(t - u) <= same_end_of_views * (scene.stop - scene.start);
  return same ? "" : fmt::format("refused otherwise: {}, but {}", refusal, seen);
}

/// Whether the laws do not determine the motion from some time before t: then many solutions are correct.
bool open_before(const Scene& scene, double t) { return integrate_reference(scene, declarations(), {}).fork <= t; }

/// Compares a run with its views.
Judgement judge_views(const Scene& scene, const Attempt& run, const std::vector<View>& views, Judgement result) {
  for (const View& view : views) {
    const Attempt seen = attempt(view.scene);
    double since = scene.stop;
    result.text = wrong_end(view, scene, run.refusal, seen.refusal);
    if (result.text.empty() && !run.rows.header.empty() && !seen.rows.header.empty()) {
      const Difference off = difference(view, run.rows, seen.rows, of_accuracy * scene.accuracy);
      since = off.first;
      result.deviation = std::max(result.deviation, off.worst);
      const bool off_by_little = off.worst > of_accuracy * scene.accuracy && off.of_little && run.refusal.empty() &&
                                 finer_difference(view, scene).worst <= of_accuracy * finer * scene.accuracy;
      if (off.worst > of_accuracy * scene.accuracy && !off_by_little) {
        result.text = fmt::format("{:.3g} of the scale: {}", off.worst, off.where);
      }
    }
    const bool differs = !result.text.empty();
    if (!differs && !seen.rows.header.empty()) result.text = wrong_friction(view.scene, seen.rows);
    if (result.text.empty()) continue;
    result.text = view.name + ": " + result.text;
    if (differs && open_before(scene, since)) result.verdict = Verdict::open;
    return result;
  }
  result.verdict = run.refusal.empty() ? Verdict::agrees : Verdict::refused;
  return result;
}

}  // namespace

Judgement check_identities(const Wiring& wiring) {
  const Scene scene = scene_of(netlist_of(wiring));
  const Attempt run = attempt(scene);
  Judgement result{.verdict = Verdict::wrong, .judged = 1, .text = ""};
  if (!run.refusal.empty() && !expected(run.refusal)) {
    result.text = "refused: " + run.refusal;
    return result;
  }
  if (run.refusal.empty()) {
    const Attempt half = attempt(first_half(scene));
    if (!half.refusal.empty()) {
      result.text = "the first half alone is refused: " + half.refusal;
      if ((expected(half.refusal) || says(half.refusal, seized)) && open_before(scene, time_in(half.refusal))) result.verdict = Verdict::open;
      return result;
    }
    result.text = wrong_energy(scene, run.summary, half.summary);
  }
  if (result.text.empty() && !run.rows.header.empty()) result.text = wrong_friction(scene, run.rows);
  if (!result.text.empty()) return result;
  return judge_views(scene, run, seen_differently(wiring, scene), result);
}

Judgement check_reductions(const Wiring& wiring) {
  const Scene scene = scene_of(netlist_of(wiring));
  Scene unreduced = scene;
  for (const ReductionWords& words : reductions()) unreduced.keep.push_back(words.name);
  const Attempt run = attempt(unreduced);
  if (!run.refusal.empty() && !expected(run.refusal)) return {.verdict = Verdict::wrong, .text = "refused: " + run.refusal};
  return judge_views(unreduced, run, reduced(scene, unreduced), {.verdict = Verdict::wrong, .judged = 1, .text = ""});
}

}  // namespace rheonet::test
