#include "core/result/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <iterator>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/network/error.hpp"
#include "core/result/row_store.hpp"

namespace rheonet {

namespace {

RunSettings settings_of(const Setting& setting, const PriceListSettings& settings) {
  return {.interrupt = settings.interrupt, .tolerance = setting.tolerance, .method = Scene::Method::ida, .order = setting.order, .account = false};
}

RunSettings settings_of(const Setting& setting, const PriceListSettings& settings, RowStore& rows) {
  RunSettings result = settings_of(setting, settings);
  result.row = [&rows](double time, const std::vector<double>& values) { rows.add(time, values); };
  return result;
}

// WebAssembly has no threads here: there the check runs when its result is asked for.
#ifdef __EMSCRIPTEN__
constexpr std::launch beside_this_thread = std::launch::deferred;
#else
constexpr std::launch beside_this_thread = std::launch::async;
#endif

class Pricing {
 public:
  Pricing(const Scene& scene, const PriceListSettings& settings)
      : scene_(scene), settings_(settings), tolerances_(settings.tolerances) {
    std::sort(tolerances_.begin(), tolerances_.end(), std::greater<>());
  }

  PriceList go() {
    find_reference();
    for (std::size_t method = 0; method < settings_.methods.size(); ++method) {
      list_.methods.push_back(settings_.methods[method].name);
      const bool exact = settings_.methods[method].method == Scene::Method::exact;
      for (const double tolerance : exact ? std::vector{tolerances_.back()} : tolerances_) {
        list_.prices.push_back(price({tolerance, settings_.methods[method].order, static_cast<int>(method)}));
        tell_progress();
        if (slow(list_.prices.back())) break;
      }
    }
    for (int run = 0; run < settings_.runs; ++run) time_all();
    for (Price& p : list_.prices) std::sort(p.cpu_seconds.begin(), p.cpu_seconds.end());
    return std::move(list_);
  }

 private:
  const SimulationMethod& method_of(const Setting& setting) const { return settings_.methods[static_cast<std::size_t>(setting.method)]; }
  RowStore no_rows() const { return RowStore({scene_.records.size()}); }
  double length() const { return scene_.stop - scene_.start; }
  double shift(double tolerance) const { return tolerance * length(); }

  void find_reference() {
    for (const double tolerance : numerics::reference_tolerances) {
      list_.reference = {tolerance, RunSettings{}.order};
      list_.check = {tolerance, numerics::reference_check_order};
      auto beside = std::async(beside_this_thread, [&] {
        RowStore rows = no_rows();
        run(scene_, settings_of(list_.check, settings_, rows));
        return rows;
      });
      try {
        const double loosest = std::max(tolerances_.front(), scene_.accuracy);
        truth_ = run_as_reference(scene_, shift(loosest), settings_of(list_.reference, settings_));
        list_.doubt = record_errors(scene_, beside.get(), truth_,
                                    {.allowed = tolerances_.back(), .shift = shift(tolerances_.back())});
        use_closed_forms();
        return;
      } catch (const SimulationError&) {
        const bool interrupted = settings_.interrupt && *settings_.interrupt;
        if (interrupted || tolerance == *std::rbegin(numerics::reference_tolerances)) throw;
      }
    }
  }

  /// Replaces the reference by the closed form of each record that has one.
  void use_closed_forms() {
    if (scene_.exact.empty()) return;
    const RowStore computed = std::exchange(truth_.rows, no_rows());
    RowStore::Reader rows = computed.read();
    std::vector<double> values(scene_.records.size());
    while (const double* const row = rows.next()) {
      const double t = row[0];
      std::copy_n(row + 1, values.size(), values.begin());
      for (const ExactRecord& form : scene_.exact) {
        const std::size_t k = static_cast<std::size_t>(form.record);
        values[k] = form.value(t);
        if (!std::isfinite(values[k]))
          throw SimulationError(form.spot, fmt::format("the closed form of `{}` has no finite value at t = {:.6g} s",
                                                       scene_.records[k].path, t));
        truth_.largest[k] = std::max(truth_.largest[k], std::abs(values[k]));
      }
      truth_.rows.add(t, values);
    }
    for (const ExactRecord& form : scene_.exact) list_.doubt[static_cast<std::size_t>(form.record)] = {};
    const auto errors = record_errors(scene_, computed, truth_, {.shift = shift(tolerances_.back())});
    for (const ExactRecord& form : scene_.exact) list_.off.push_back(errors[static_cast<std::size_t>(form.record)]);
  }

  Price price(const Setting& setting) {
    Price result;
    result.setting = setting;
    try {
      RowStore rows = no_rows();
      result.summary = run_by(method_of(setting), scene_, settings_of(setting, settings_, rows));
      result.errors = record_errors(scene_, rows, truth_, {.allowed = setting.tolerance, .shift = shift(setting.tolerance)});
      result.worst = worst_of(result.errors);
      const ErrorMeasure asked{.allowed = scene_.accuracy, .shift = shift(scene_.accuracy)};
      const auto as_asked = record_errors(scene_, rows, truth_, asked);
      result.meets = true;
      for (std::size_t k = 0; k < as_asked.size(); ++k) {
        // The uncertainty of the reference counts as an additional error.
        if (as_asked[k].relative() + list_.doubt[k].relative() > scene_.accuracy) result.meets = false;
      }
    } catch (const SimulationError& error) {
      if (settings_.interrupt && *settings_.interrupt) throw;
      result.failure = error.what();
    }
    return result;
  }

  /// Too slow: the method is abandoned.
  bool slow(const Price& price) {
    const double seconds = price.summary.cpu_seconds;
    if (price.setting.method == 0) slowest_ = std::max(slowest_, seconds);
    return !method_of(price.setting).certified && seconds > settings_.too_slow * slowest_;
  }

  void time_all() {
    for (Price& p : list_.prices) {
      if (!p.failure.empty()) continue;
      p.cpu_seconds.push_back(run_by(method_of(p.setting), scene_, settings_of(p.setting, settings_)).cpu_seconds);
      tell_progress();
    }
  }

  void tell_progress() {
    const double all = static_cast<double>(tolerances_.size() * settings_.methods.size()) * (settings_.runs + 1);
    if (settings_.progress) settings_.progress(std::min(1.0, ++done_ / all));
  }

  const Scene& scene_;
  const PriceListSettings& settings_;
  std::vector<double> tolerances_;
  ReferenceSolution truth_;
  double slowest_ = 0;  ///< longest CPU time of a run by the first method [s]
  double done_ = 0;     ///< number of runs done
  PriceList list_;
};

}  // namespace

double Price::cpu_quantile(double fraction) const {
  if (cpu_seconds.empty()) return 0;
  const double place = fraction * static_cast<double>(cpu_seconds.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place), above = std::min(below + 1, cpu_seconds.size() - 1);
  return std::lerp(cpu_seconds[below], cpu_seconds[above], place - static_cast<double>(below));
}

double PriceList::largest_doubt() const {
  double largest = 0;
  for (const RecordError& d : doubt) largest = std::max(largest, d.relative());
  return largest;
}

const Price* PriceList::cheapest() const {
  const Price* best = nullptr;
  for (const Price& p : prices) {
    if (!p.failure.empty() || !p.meets) continue;
    if (!best || p.cpu_quantile(0.5) < best->cpu_quantile(0.5)) best = &p;
  }
  return best;
}

const Price* PriceList::own(const Scene& scene) const {
  for (const Price& p : prices) {
    if (p.setting.method != 0 || p.setting.tolerance != scene.accuracy) continue;
    return p.failure.empty() ? &p : nullptr;
  }
  return nullptr;
}

PriceList price_list(const Scene& scene, const PriceListSettings& settings) { return Pricing(scene, settings).go(); }

}  // namespace rheonet
