#include <nlohmann/json.hpp>

#include "core/network/linearity.hpp"
#include "tools/report/messages.hpp"

namespace rheonet::report {
namespace {

using nlohmann::json;

json names_of(const std::vector<Effect>& effects) {
  json names = json::array();
  for (const Effect effect : effects) names.push_back(name_of(effect));
  return names;
}

/// A model without some effects, and how far it is from the full one.
json model(const Scene& scene, const Rung& rung) {
  json told{{"without", names_of(rung.without)}, {"failure", rung.failure}, {"steps", rung.steps}, {"cpu", rung.median_cpu()}};
  if (!rung.failure.empty() || rung.differences.empty()) return told;
  const Difference& worst = rung.differences[rung.worst];
  told["worst"] = {{"path", scene.records[rung.worst].path},
                   {"unit", unit_text(scene, scene.records[rung.worst])},
                   {"largest", worst.largest},
                   {"rms", worst.rms},
                   {"at", worst.time},
                   {"relative", worst.relative()}};
  for (const Difference& difference : rung.differences) told["relative"].push_back(difference.relative());
  return told;
}

json models(const Scene& scene, const std::vector<Rung>& rungs) {
  json list = json::array();
  for (const Rung& rung : rungs) list.push_back(model(scene, rung));
  return list;
}

}  // namespace

std::string prices_message(const Scene& scene, const PriceList& list, const std::string& text) {
  json prices = json::array();
  for (const Price& price : list.prices) {
    if (!price.failure.empty()) continue;
    prices.push_back({{"tolerance", price.setting.tolerance},
                      {"order", price.setting.order},
                      {"method", list.methods[static_cast<std::size_t>(price.setting.method)]},
                      {"error", price.error()},
                      {"worst", price.errors.empty() ? "" : scene.records[price.worst].path},
                      {"doubt", price.errors.empty() ? 0 : list.doubt[price.worst].relative()},
                      {"meets", price.meets},
                      {"cheapest", &price == list.cheapest()},
                      {"cpu", price.cpu_quantile(0.5)},
                      {"steps", price.summary.steps}});
  }
  const std::optional<NotLinear> obstacle = not_linear(scene);
  return to_line({{"kind", "prices"},
                  {"prices", prices},
                  {"accuracy", scene.accuracy},
                  {"closed_forms", scene.exact.size()},
                  {"records", scene.records.size()},
                  {"reference", list.reference.tolerance},
                  {"not_linear", obstacle ? json(obstacle->reason) : json()},
                  {"by_ida", scene.method == Scene::Method::ida},
                  {"text", text}});
}

std::string effects_message(const Scene& scene, const ModelHierarchy& all, double within) {
  json records = json::array();
  for (const Record& record : scene.records) records.push_back({{"path", record.path}, {"unit", unit_text(scene, record)}});
  const Rung* const barest = all.barest_within(within);
  return to_line({{"kind", "effects"},
                  {"effects", names_of(all.effects)},
                  {"full", model(scene, all.full)},
                  {"each", models(scene, all.each)},
                  {"steps", models(scene, all.steps)},
                  {"barest", barest ? names_of(barest->without) : json()},
                  {"accuracy", scene.accuracy},
                  {"within", within},
                  {"records", records}});
}

}  // namespace rheonet::report
