#include "tools/rheonet/pricing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/network/linearity.hpp"
#include "tools/rheonet/comparison.hpp"

namespace rheonet::tool {

void take_records(const Scene& scene, const std::vector<std::string>& paths, Variant& variant) {
  const Columns columns = record_columns(variant.scene);
  std::vector<Record> records;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const auto column = columns.find(paths[k]);
    if (column == columns.end()) throw NotComparable(fmt::format("the variant `{}` does not record `{}`", variant.name, paths[k]));
    const Record& record = variant.scene.records[column->second];
    if (!unit_of(scene, scene.records[k]).dimension.same(unit_of(variant.scene, record).dimension))
      throw NotComparable(fmt::format("`{}` and, in the variant `{}`, `{}` are different quantities", scene.records[k].path, variant.name, paths[k]));
    records.push_back(record);
  }
  variant.scene.records = std::move(records);
  variant.scene.exact.clear();
}

std::vector<SimulationMethod> methods_of(std::vector<Variant> variants, Scene& scene) {
  std::vector<Scene> scenes{scene};
  for (Variant& variant : variants) scenes.push_back(std::move(variant.scene));
  check_comparable(scenes);
  if (!variants.empty()) to_one_time_base(scenes);
  scene = std::move(scenes.front());
  std::vector<SimulationMethod> methods;
  for (std::size_t k = 0; k < variants.size(); ++k) methods.push_back({.name = std::move(variants[k].name), .scene = {std::move(scenes[k + 1])}});
  return methods;
}

PriceListSettings settings_of(const Scene& scene, PricingWanted wanted, const std::atomic<bool>* interrupt) {
  PriceListSettings settings{.tolerances = std::move(wanted.accuracies), .interrupt = interrupt};
  std::vector<double>& tolerances = settings.tolerances;
  if (tolerances.empty()) tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11};
  if (std::find(tolerances.begin(), tolerances.end(), scene.accuracy) == tolerances.end()) tolerances.push_back(scene.accuracy);
  if (wanted.variants) settings.methods = methods(scene, interrupt);
  if (!not_linear(scene)) settings.methods.push_back({.name = "exact arcs", .method = Scene::Method::exact});
  if (wanted.certified) settings.methods.push_back({.name = "certified", .certified = true});
  std::move(wanted.models.begin(), wanted.models.end(), std::back_inserter(settings.methods));
  return settings;
}

}  // namespace rheonet::tool
