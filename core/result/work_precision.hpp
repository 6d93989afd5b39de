#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/result/reference_solution.hpp"
#include "core/result/run.hpp"
#include "core/result/variants.hpp"

namespace rheonet {

/// A setting of the integrator.
struct Setting {
  double tolerance = 1e-6;  ///< Used in place of the scene's accuracy.
  int order = 5;            ///< Largest order.
  int method = 0;           ///< Index into PriceListSettings::methods.
};

/// Cost and accuracy of a method.
struct Price {
  Setting setting;
  std::string failure;              ///< Error message; if it is not "", the other members are void.
  std::vector<RecordError> errors;  ///< For each record; jumps may be displaced by tolerance x length of the run.
  std::size_t worst = 0;            ///< Index of the largest relative error.
  bool meets = false;               ///< Every record is as accurate as the scene asks.
  std::vector<double> cpu_seconds;  ///< For each run, ascending.
  Summary summary;

  double error() const { return errors.empty() ? 0 : errors[worst].relative(); }
  /// A quantile of the CPU time of the runs [s]; fraction 0.5: the median.
  double cpu_quantile(double fraction) const;
};

struct PriceListSettings {
  std::vector<double> tolerances;  ///< In any order.
  std::vector<SimulationMethod> methods = {{.name = "order up to 5"}};  ///< all are tried; see `too_slow`
  int runs = 5;                    ///< Timed runs of each method.
  /// A method is abandoned after a run that takes more than `too_slow` times the CPU time of the slowest run of the first
  /// method. Methods that certify are not abandoned.
  double too_slow = 10;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double fraction)> progress = {};  ///< Called from time to time with the fraction of runs done.
};

/// The cost of accuracy in a scene.
struct PriceList {
  Setting reference, check;          ///< The reference run that measures errors, and the run that checks it.
  std::vector<RecordError> doubt;   ///< Uncertainty: of each record, difference of these two; 0 with a closed form.
  std::vector<RecordError> off;     ///< For each closed form in the scene, deviation of the reference from it.
  std::vector<Price> prices;        ///< By method in the given order, then from the loosest tolerance to the tightest.
  std::vector<std::string> methods; ///< Their names.

  double largest_doubt() const;
  /// The cheapest price that meets the scene's accuracy, by median CPU time; nullptr if none does.
  const Price* cheapest() const;
  /// The price of the scene's own accuracy by the first method; nullptr if it failed or was not tried.
  const Price* own(const Scene& scene) const;
};

/// Simulates a scene repeatedly. Errors are measured against closed forms of records where the scene has them (`[exact]`),
/// otherwise against a run as tight as double precision allows. A run of another order (other steps, formulas and round-off)
/// checks that reference. Timed runs are sequential and in rounds over all methods, so that disturbances of the machine
/// affect all methods. Throws SimulationError if the reference cannot be computed, on an interrupt, or if a closed form has
/// no value.
PriceList price_list(const Scene& scene, const PriceListSettings& settings);

}  // namespace rheonet
