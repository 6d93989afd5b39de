#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/work_precision.hpp"

namespace rheonet::tool {

/// Another model of what a scene describes.
struct Variant {
  std::string name;
  Scene scene;
};

/// Replaces the records of a variant by those at `paths`, one for each record of the scene, in its order. Throws NotComparable
/// if the variant does not record one of them, or records another quantity.
void take_records(const Scene& scene, const std::vector<std::string>& paths, Variant& variant);

/// Variants as methods of a price list. All get one time base, the scene too. Throws NotComparable.
std::vector<SimulationMethod> methods_of(std::vector<Variant> variants, Scene& scene);

/// What the command `precision` and the Python package measure.
struct PricingWanted {
  std::vector<double> accuracies = {};       ///< empty: 1e-2 to 1e-11; the scene's own is always among them
  bool variants = false;                     ///< lower orders, events not located, reductions switched off, ...
  bool certified = false;                    ///< certified runs too
  std::vector<SimulationMethod> models = {}; ///< see methods_of
};

/// The tolerances and methods of a price list. Runs the scene if `variants` are asked for; throws SimulationError then.
PriceListSettings settings_of(const Scene& scene, PricingWanted wanted);

}  // namespace rheonet::tool
