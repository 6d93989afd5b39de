#include "tools/python/studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <variant>

#include "core/netlist/expression.hpp"
#include "tools/python/diagnostics.hpp"
#include "tools/python/watch.hpp"
#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/compare_report.hpp"
#include "tools/rheonet/effects_report.hpp"
#include "tools/rheonet/precision_report.hpp"
#include "tools/rheonet/pricing.hpp"
#include "tools/rheonet/sensitivity_rows.hpp"

namespace rheonet::python {
namespace {

/// Calls `work` without the interpreter lock, while this thread checks for Ctrl-C. `sources` returns the sources of the scene that was
/// simulated when an error occurred.
void do_watched(const py::object& progress, const std::function<void(Watch&)>& work, const std::function<const Sources&()>& sources) {
  Watch watch(progress);
  std::optional<SimulationError> failure;
  watch.call(
      [&] {
        try {
          work(watch);
        } catch (const SimulationError& error) {
          failure = error;
        }
      },
      true);
  if (failure) raise(*failure, sources());
}

py::dict as_dict(const Difference& d) {
  py::dict result;
  result["largest"] = d.largest;
  result["time"] = d.time;
  result["first"] = d.first;
  result["second"] = d.second;
  result["rms"] = d.rms;
  result["scale"] = d.scale;
  result["relative"] = d.relative();
  result["relative_rms"] = d.relative_rms();
  return result;
}

}  // namespace

Comparison::Comparison(const std::vector<const Reading*>& readings, std::vector<tool::Pairing> pairings, const py::object& progress) {
  for (const Reading* reading : readings) compared_.add(reading->file(), reading->scene(), reading->sources());
  compared_.pairings = std::move(pairings);
  tool::prepare(compared_);
  if (compared_.pairings.empty()) throw tool::NotComparable("the scenes record nothing of the same name: pair their records by `pairs`");
  do_watched(
      progress,
      [&](Watch& watch) {
        const auto share = 1 / static_cast<double>(compared_.scenes.size());
        tool::simulate(compared_, {.interrupt = watch.interrupt(), .progress = [&](double fraction) {
                                     watch.advance((static_cast<double>(compared_.trajectories.size()) + fraction) * share);
                                   }});
      },
      [&]() -> const Sources& { return compared_.sources[compared_.trajectories.size()]; });
}

std::vector<std::string> Comparison::units() const {
  std::vector<std::string> units;
  const Scene& first = compared_.scenes.front();
  for (const tool::Pairing& pairing : compared_.pairings)
    units.push_back(unit_text(first, first.records[compared_.columns.front().at(pairing.front())]));
  return units;
}

py::list Comparison::differences() const {
  py::list all;
  for (const std::vector<Difference>& of_scene : compared_.differences) {
    py::list found;
    for (const Difference& d : of_scene) found.append(as_dict(d));
    all.append(found);
  }
  return all;
}

std::vector<double> Comparison::dissipated() const {
  std::vector<double> joules;
  for (const Trajectory& trajectory : compared_.trajectories) joules.push_back(trajectory.summary.dissipated);
  return joules;
}

py::array_t<double> Comparison::time() const {
  const std::vector<double>& times = compared_.trajectories.front().times;
  return py::array_t<double>(static_cast<py::ssize_t>(times.size()), times.data());
}

py::array_t<double> Comparison::rows(std::size_t pairing) const {
  const std::size_t rows = compared_.trajectories.front().rows.size(), scenes = compared_.scenes.size();
  py::array_t<double> result({static_cast<py::ssize_t>(scenes), static_cast<py::ssize_t>(rows)});
  auto cells = result.mutable_unchecked<2>();
  for (std::size_t i = 0; i < scenes; ++i) {
    const std::size_t column = compared_.columns[i].at(compared_.pairings[pairing][i]);
    for (std::size_t row = 0; row < rows; ++row)
      cells(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(row)) = compared_.trajectories[i].rows[row][column] + 0.0;
  }
  return result;
}

std::string Comparison::text() const { return tool::describe(compared_); }

tool::Design drawn_points(const std::vector<std::string>& vary, const std::string& kind, long count, std::uint64_t seed,
                          const std::vector<std::string>& correlate) {
  tool::SweepArguments sweep;
  sweep.vary = vary;
  sweep.correlate = correlate;
  sweep.seed = seed;
  (kind == "random" ? sweep.random : kind == "latin" ? sweep.latin : sweep.sobol) = count;
  auto read = tool::Design::read(sweep);
  if (const auto* wrong = std::get_if<tool::NoVariation>(&read))
    throw std::invalid_argument(wrong->hint.empty() ? wrong->message : wrong->message + "\n  " + wrong->hint);
  return std::get<tool::Design>(std::move(read));
}

std::optional<std::pair<double, bool>> evaluated(const std::string& text) {
  const auto read = evaluate_text(text, Environment{});
  const Number* number = std::get_if<Number>(&read);
  if (!number) return {};
  return std::pair{number->value, !number->plain};
}

Effects::Effects(const Reading& reading, int runs, const py::object& progress) : file_(reading.file()), scene_(reading.scene()) {
  scene_.output_events = false;  // models are compared at the same times
  do_watched(
      progress,
      [&](Watch& watch) {
        ladder_ = ladder_of(scene_, {.runs = runs, .interrupt = watch.interrupt(), .progress = [&](double fraction) { watch.advance(fraction); }});
      },
      [&]() -> const Sources& { return reading.sources(); });
}

std::vector<std::string> Effects::effects() const {
  std::vector<std::string> names;
  for (const Effect effect : ladder_.effects) names.push_back(name_of(effect));
  return names;
}

std::optional<std::size_t> Effects::barest(double relative) const {
  const Rung* const found = ladder_.barest_within(relative);
  if (!found) return {};
  return static_cast<std::size_t>(found - ladder_.steps.data());
}

std::string Effects::text(std::optional<double> within) const {
  return tool::describe(scene_, file_, ladder_, within.value_or(tool::default_within));
}

py::dict Effects::model(const Rung& rung) const {
  py::dict result, differences;
  py::list without;
  for (const Effect effect : rung.without) without.append(name_of(effect));
  for (std::size_t k = 0; k < rung.differences.size(); ++k) {
    differences[py::str(scene_.records[k].path)] = as_dict(rung.differences[k]);
  }
  result["without"] = py::tuple(without);
  result["differences"] = differences;
  result["steps"] = rung.steps;
  result["cpu_seconds"] = rung.failure.empty() ? rung.median_cpu() : not_given;
  result["failure"] = rung.failure;
  return result;
}

py::list Effects::models(const std::vector<Rung>& rungs) const {
  py::list result;
  for (const Rung& rung : rungs) result.append(model(rung));
  return result;
}

Precision::Precision(const Reading& reading, const Wanted& wanted, const py::object& progress) : file_(reading.file()), scene_(reading.scene()) {
  std::vector<tool::Variant> variants;
  for (std::size_t k = 0; k < wanted.models.size(); ++k) {
    tool::Variant& variant = variants.emplace_back(tool::Variant{wanted.models[k].first, wanted.models[k].second->scene()});
    tool::take_records(scene_, wanted.records[k], variant);
  }
  std::vector<SimulationMethod> models = tool::methods_of(std::move(variants), scene_);
  do_watched(
      progress,
      [&](Watch& watch) {
        PriceListSettings settings = tool::settings_of(
            scene_, {.accuracies = wanted.accuracies, .variants = wanted.variants, .certified = wanted.certified, .models = std::move(models)}, watch.interrupt());
        settings.runs = wanted.runs;
        settings.progress = [&](double fraction) { watch.advance(fraction); };
        list_ = price_list(scene_, settings);
      },
      [&]() -> const Sources& { return reading.sources(); });
}

py::list Precision::prices() const {
  py::list result;
  for (const Price& p : list_.prices) {
    py::dict price, errors;
    const bool failed = !p.failure.empty();
    for (std::size_t k = 0; k < p.errors.size(); ++k) errors[py::str(scene_.records[k].path)] = p.errors[k].relative();
    price["accuracy"] = p.setting.tolerance;
    price["method"] = list_.methods[static_cast<std::size_t>(p.setting.method)];
    price["order"] = p.setting.order;
    price["error"] = failed ? not_given : p.error();
    price["record"] = p.errors.empty() ? py::object(py::none()) : py::str(scene_.records[p.worst].path);
    price["errors"] = errors;
    price["meets"] = p.meets;
    for (const auto& [name, quantile] : {std::pair{"cpu_seconds", 0.5}, {"cpu_lower_quartile", 0.25}, {"cpu_upper_quartile", 0.75}})
      price[name] = failed ? not_given : p.cpu_quantile(quantile);
    price["steps"] = p.summary.steps;
    price["rejected_steps"] = p.summary.rejected_steps;
    price["residual_evaluations"] = p.summary.residual_evaluations;
    price["jacobian_evaluations"] = p.summary.jacobian_evaluations;
    price["restarts"] = p.summary.restarts;
    price["failure"] = p.failure;
    result.append(price);
  }
  return result;
}

std::optional<std::size_t> Precision::place(const Price* price) const {
  if (!price) return {};
  return static_cast<std::size_t>(price - list_.prices.data());
}

py::dict Precision::doubt() const {
  py::dict result;
  for (std::size_t k = 0; k < list_.doubt.size(); ++k) result[py::str(scene_.records[k].path)] = list_.doubt[k].relative();
  return result;
}

std::string Precision::text() const { return tool::describe(scene_, file_, list_); }

Sensitivities::Sensitivities(Source& source, const Source::Wanted& wanted, std::vector<std::string> paths, std::optional<double> accuracy,
                             const py::object& progress)
    : paths_(std::move(paths)), reading_(source.read(wanted)) {
  const auto work = [&](Watch& watch) {
    for (const std::string& path : paths_) {
      const auto multiplied = [&](double factor) {
        Source::Wanted changed = wanted;
        changed.overrides.push_back(fmt::format("{}*={:.17g}", path, factor));
        ReadResult read = source.read(std::move(changed)).read_result(accuracy);
        if (read.scene) return *std::move(read.scene);
        throw SimulationError(fmt::format("`{}` cannot be changed by {:.0e} of its value: {}", path, factor - 1, read.diagnostics.front().message));
      };
      const double before = static_cast<double>(derivatives_.size()), all = static_cast<double>(paths_.size());
      const auto advance = [&](double) { watch.advance(before / all); };
      derivatives_.push_back(sensitivity(multiplied, path, {.interrupt = watch.interrupt(), .progress = advance}));
    }
  };
  do_watched(progress, work, [&]() -> const Sources& { return reading_.sources(); });
}

py::array_t<double> Sensitivities::time() const {
  py::array_t<double> result(rows_of_all());
  RowStore::Reader reader = derivatives_.front().rows.read();
  double* cell = result.mutable_data();
  for (py::ssize_t row = 0; row < rows_of_all(); ++row) *cell++ = reader.next()[0];
  return result;
}

py::array_t<double> Sensitivities::rows(std::size_t record) const {
  py::array_t<double> result({static_cast<py::ssize_t>(derivatives_.size()), rows_of_all()});
  double* cell = result.mutable_data();
  for (const Sensitivity& by_value : derivatives_) {
    RowStore::Reader reader = by_value.rows.read();
    for (py::ssize_t row = 0; row < rows_of_all(); ++row) *cell++ = reader.next()[1 + record] + 0.0;
  }
  return result;
}

/// The number of rows that the derivatives by each value have.
py::ssize_t Sensitivities::rows_of_all() const {
  std::size_t rows = derivatives_.front().rows.rows();
  for (const Sensitivity& by_value : derivatives_) rows = std::min(rows, by_value.rows.rows());
  return static_cast<py::ssize_t>(rows);
}

py::list Sensitivities::largest() const {
  py::list all;
  for (const Sensitivity& by_value : derivatives_) {
    py::list found;
    for (const Sensitivity::Record& record : by_value.records) found.append(py::make_tuple(record.largest, record.time, record.error));
    all.append(found);
  }
  return all;
}

std::string Sensitivities::text() const { return tool::describe(reading_.scene(), derivatives_, paths_); }

}  // namespace rheonet::python
