#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/result/run.hpp"
#include "core/result/variants.hpp"
#include "core/result/yardstick.hpp"

namespace rheonet {

/// How a scene is integrated.
struct Method {
  double tolerance = 1e-6;  ///< what `accuracy` of a scene is
  int order = 5;            ///< at most
  int manner = 0;           ///< index into PriceListSettings::manners
};

/// What a method costs, and what it gives.
struct Price {
  Method method;
  std::string failure;              ///< why the scene cannot be simulated so; "" if it can: else the rest means nothing
  std::vector<RecordError> errors;  ///< of each record; a jump may be displaced by the tolerance, of the run's length
  std::size_t worst = 0;            ///< position of the largest relative error
  bool meets = false;               ///< every record is as accurate as the scene asks
  std::vector<double> cpu_seconds;  ///< of each run, ascending
  Summary summary;

  double error() const { return errors.empty() ? 0 : errors[worst].relative(); }
  /// Of the CPU time of the runs [s]; fraction 0.5: the median.
  double cpu_quantile(double fraction) const;
};

struct PriceListSettings {
  std::vector<double> tolerances;  ///< in any order
  std::vector<Manner> manners = {{.name = "order up to 5"}};  ///< each is gone through; see `too_slow`
  int runs = 5;                    ///< of each method, whose CPU time is taken
  /// A method that takes so many times the CPU time of the slowest one of the first of the manners is the last of its manner,
  /// unless that is to certify.
  double too_slow = 10;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double fraction)> progress = {};  ///< called now and then, with the share of the methods that are done
};

/// What accuracy costs in a scene.
struct PriceList {
  Method reference, check;          ///< what errors are measured by, and what that is checked by
  std::vector<RecordError> doubt;   ///< of each record, how far those two are apart; 0 of one with a closed form
  std::vector<RecordError> off;     ///< of each closed form of the scene, how far the reference is from it
  std::vector<Price> prices;        ///< by manner as asked for, then from the loosest tolerance to the tightest
  std::vector<std::string> manners; ///< their names

  double largest_doubt() const;
  /// The cheapest price that meets what the scene asks for, by the median of its CPU time; nullptr if none does.
  const Price* cheapest() const;
  /// That of the scene's own accuracy in the first of the manners; nullptr if it cannot be simulated so.
  const Price* own(const Scene& scene) const;
};

/// Simulates a scene over and over. Errors are measured by the closed forms of records, where a scene has them (`[exact]`);
/// else by a run as tight as double precision allows, which is itself checked by one of another order: other steps, other formulas, other roundings. The runs whose time is taken follow each
/// other, one by one, and each goes through all methods before the next begins: what disturbs the machine for a while
/// disturbs all of them. Throws SimulationError if the reference cannot be had, or on an interrupt, or where
/// a closed form has no value.
PriceList price_list(const Scene& scene, const PriceListSettings& settings);

}  // namespace rheonet
