#include "tools/serve/requests.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tools/serve/folder.hpp"
#include "tools/serve/netlist_name.hpp"

namespace rheonet::serve {

using nlohmann::json;

namespace {

constexpr std::size_t most_compared = 10, most_curves = 200, longest_name = 1000;

/// A netlist for a worker; absent if the value is not a netlist.
std::optional<json> scene_of(const json& value) {
  if (!value.is_object() || !value.contains("text") || !value["text"].is_string()) return {};
  const std::string file = word(value, "file");
  const std::string folder = fault_of_name(file).empty() ? std::filesystem::path(file).parent_path().string() : "";
  return json{{"text", value["text"]}, {"file", file.empty() ? "scene.toml" : file}, {"folder", folder}};
}

/// A display unit: its name and its size in SI.
std::optional<json> unit_of(const json& curve, const char* key) {
  const json unit = curve.value(key, json());
  if (!unit.is_object() || !unit.value("factor", json()).is_number() || !(unit["factor"].get<double>() > 0)) return {};
  return json{{"name", word(unit, "name")}, {"factor", unit["factor"]}};
}

bool consists_of(const std::string& text, const char* characters) { return text.find_first_not_of(characters) == text.npos; }

/// A curve of a figure: its columns and its style in the page.
std::optional<json> curve_of(const json& curve) {
  if (!curve.is_object()) return {};
  json result;
  for (const char* key : {"x", "y", "name", "color", "dashes"}) result[key] = word(curve, key);
  const auto color = result["color"].get<std::string>();
  if (result["x"] == "" || result["y"] == "" || color.size() != 7 || color[0] != '#') return {};
  if (!consists_of(color.substr(1), "0123456789abcdef") || !consists_of(result["dashes"].get<std::string>(), "0123456789. ")) return {};
  const json panel = curve.value("panel", json());
  if (!panel.is_number_unsigned() || panel.get<std::uint64_t>() > most_curves) return {};
  result["panel"] = panel;
  for (const char* key : {"x_unit", "y_unit"}) {
    const std::optional<json> unit = unit_of(curve, key);
    if (!unit) return {};
    result[key] = *unit;
  }
  return result;
}

bool is_one_of(std::string_view kind, std::initializer_list<std::string_view> kinds) { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); }

/// A list of strings of a request; absent if it is not a list of strings or has more than `most` items.
std::optional<json> words_of(const json& request, const char* key) {
  constexpr std::size_t most = 1000;
  const auto found = request.find(key);
  if (found == request.end() || !found->is_array() || found->size() > most) return {};
  const bool all = std::all_of(found->begin(), found->end(), [](const json& each) { return each.is_string() && each.get_ref<const std::string&>().size() <= longest_name; });
  return all ? std::optional(json(*found)) : std::nullopt;
}

}  // namespace

std::string word(const json& value, const char* key) {
  const auto found = value.find(key);
  if (found == value.end() || !found->is_string()) return "";
  const auto& text = found->get_ref<const std::string&>();
  return text.size() <= longest_name ? text : "";
}

std::optional<json> task_of(const json& request) {
  const std::string kind = word(request, "task");
  if (kind == "catalogue") return json{{"task", kind}};
  if (is_one_of(kind, {"show", "explain", "csv", "effects", "precision", "lesson"})) {
    std::optional<json> task = scene_of(request);
    if (!task) return {};
    (*task)["task"] = kind;
    (*task)["draw"] = request.value("draw", json()) == true;
    (*task)["language"] = word(request, "language");
    if (const json lesson = request.value("lesson", json()); lesson.is_string()) (*task)["lesson"] = lesson;
    return task;
  }
  if (kind == "sweep") {
    std::optional<json> task = scene_of(request);
    if (!task) return {};
    (*task)["task"] = kind;
    (*task)["path"] = word(request, "path");
    for (const char* key : {"values", "measures", "set"}) {
      const std::optional<json> list = words_of(request, key);
      if (!list) return {};
      (*task)[key] = *list;
    }
    return task;
  }
  if ((kind != "report" && kind != "figure") || !request.contains("scenes") || !request["scenes"].is_array()) return {};
  json task{{"task", kind}, {"scenes", json::array()}};
  if (request["scenes"].empty() || request["scenes"].size() > most_compared) return {};
  for (const json& scene : request["scenes"]) {
    std::optional<json> one = scene_of(scene);
    if (!one) return {};
    task["scenes"].push_back(std::move(*one));
    if (kind == "report") continue;
    const json curves = scene.value("curves", json());
    if (!curves.is_array() || curves.size() > most_curves) return {};
    json& taken = task["scenes"].back()["curves"] = json::array();
    for (const json& each : curves) {
      const std::optional<json> curve = curve_of(each);
      if (!curve) return {};
      taken.push_back(*curve);
    }
  }
  return task;
}

json listing_of(const Folder& folder) {
  json scenes = json::array();
  const Folder::Listing listing = folder.scenes();
  for (const Folder::Entry& each : listing.scenes) {
    scenes.push_back({{"file", each.file}, {"title", each.title}, {"about", each.about}});
    if (each.place) scenes.back()["place"] = *each.place;
    if (each.lesson) scenes.back()["lesson"] = {{"level", each.lesson->level}, {"minutes", each.lesson->minutes}, {"titles", each.lesson->titles}};
  }
  return {{"name", folder.path().filename().string()},
          {"may_be_written", folder.may_be_written()},
          {"left_out", listing.left_out},
          {"all_visited", listing.all_visited},
          {"scenes", scenes}};
}

}  // namespace rheonet::serve
