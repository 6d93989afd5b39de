#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/work_precision.hpp"

namespace rheonet::tool {

/// Another model of the system that a scene describes.
struct Variant {
  std::string name;
  Scene scene;
};

/// Replaces the records of a variant by those at `paths`, one for each record of the scene, in its order. Throws NotComparable
/// if the variant does not record one of them, or records another quantity.
void take_records(const Scene& scene, const std::vector<std::string>& paths, Variant& variant);

/// Variants as methods of a price list. All variants and `scene` get one time base. Throws NotComparable.
std::vector<SimulationMethod> methods_of(std::vector<Variant> variants, Scene& scene);

/// Measurements that the command `precision` or the Python package asks for.
struct PricingWanted {
  std::vector<double> accuracies = {};       ///< Empty: 1e-2 to 1e-11. The scene's own is always added.
  bool variants = false;                     ///< Add lower orders, events not located, reductions switched off, ...
  bool certified = false;                    ///< Add certified runs.
  std::vector<SimulationMethod> models = {}; ///< See methods_of.
};

/// The tolerances, the methods and the interrupt of a price list. Runs the scene if `variants` are asked for; throws SimulationError then, also
/// when `interrupt` is set to true.
PriceListSettings settings_of(const Scene& scene, PricingWanted wanted, const std::atomic<bool>* interrupt);

}  // namespace rheonet::tool
