#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/netlist/characters.hpp"
#include "core/network/component.hpp"
#include "core/result/explain.hpp"
#include "tools/draw/caption.hpp"
#include "tools/draw/schematic.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/plot/units.hpp"
#include "tools/report/adjustable_numbers.hpp"
#include "tools/report/messages.hpp"
#include "tools/rheonet/explanation.hpp"
#include "tools/rheonet/network_text.hpp"
#include "tools/rheonet/plot_source.hpp"

namespace rheonet::report {
namespace {

using nlohmann::json;

const char* name_of(Sources::Role role) {
  return role == Sources::Role::scene ? "scene" : role == Sources::Role::included ? "included" : "table";
}

const char* name_of(Domain domain) { return domain == Domain::rotation ? "rotation" : "translation"; }

const char* name_of(Record::Subject subject) {
  using Subject = Record::Subject;
  return subject == Subject::node         ? "node"
         : subject == Subject::element    ? "element"
         : subject == Subject::block      ? "block"
         : subject == Subject::expression ? "expression"
                                          : "assembly";
}

/// The first of the wished units in which a record can be shown; null if there is none.
json shown_in(const std::vector<std::string>& wished, const std::string& unit) {
  const plot::Measure measure = plot::measure("", unit);
  for (const std::string& wish : wished) {
    const plot::Measure other = plot::measure("", wish);
    if (other.size && plot::compatible(measure, other)) return {{"name", plot::in_print(wish)}, {"factor", other.size->factor}};
  }
  return nullptr;
}

/// The path of a file relative to the scene's folder; only the name of a file that is far from there.
std::string seen_from(const std::filesystem::path& scene, const std::filesystem::path& file) {
  std::error_code failed;
  const std::filesystem::path folder = scene.has_parent_path() ? scene.parent_path() : ".";
  const std::string way = std::filesystem::proximate(file, folder, failed).generic_string();
  return failed || way.starts_with("../../..") || way.starts_with('/') ? file.filename().string() : way;
}

json records(const ReadResult& read) {
  const Scene& scene = *read.scene;
  const std::vector<plot::Column> columns = tool::columns_of(scene);  // The first column is time.
  json list = json::array();
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    const Record& record = scene.records[k];
    const std::size_t dot = record.path.rfind('.');
    list.push_back({{"path", record.path},
                    {"owner", record.path.substr(0, dot)},
                    {"channel", record.path.substr(dot + 1)},
                    {"subject", name_of(record.subject)},
                    {"quantity", columns[k + 1].measure.quantity},
                    {"unit", unit_text(scene, record)}});
    if (const json shown = shown_in(read.presentation.plot.units, unit_text(scene, record)); !shown.is_null())
      list.back()["shown"] = shown;
  }
  return list;
}

/// The values of an element that are numbers from the start to the end, in SI.
json numbers_of(const SceneElement& element) {
  const Declaration& declaration = *declarations()[static_cast<std::size_t>(element.declaration)];
  json numbers = json::object();
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i) {
    const auto& varying = element.signal_parameters;
    const bool varies = std::find(varying.begin(), varying.end(), static_cast<int>(i)) != varying.end();
    if (!varies && std::isfinite(element.values[i])) numbers[declaration.parameters[i].name] = element.values[i];
  }
  return numbers;
}

json elements(const Scene& scene) {
  json list = json::array();
  constexpr std::size_t most = 500;  // Longer tables are not readable.
  for (std::size_t i = 0; i < std::min(scene.elements.size(), most); ++i) {
    const SceneElement& element = scene.elements[i];
    if (element.part != SceneElement::Part::none) continue;
    const auto node = [&scene](NodeId id) { return scene.nodes[static_cast<std::size_t>(id)].name; };
    const auto [name, type, place, values] = tool::row_of(element, scene);
    list.push_back({{"name", name},
                    {"type", type},
                    {"place", place},
                    {"a", node(element.a)},
                    {"b", element.at ? "" : node(element.b)},
                    {"domain", name_of(domain_of(scene, element))},
                    {"values", values},
                    {"numbers", numbers_of(element)}});
  }
  return list;
}

/// The law of each element type in use.
json equations(const Scene& scene) {
  std::map<int, Domain> used;  // Each type, in the domain of its first element.
  for (const SceneElement& element : scene.elements) used.emplace(element.declaration, domain_of(scene, element));
  json list = json::array();
  for (const auto& [index, domain] : used) {
    const Declaration& d = components()[static_cast<std::size_t>(index)]->declaration;
    json symbols = json::array();
    for (const Parameter& p : d.parameters)
      if (!p.symbol.empty())
        symbols.push_back({draw::in_print(p.symbol), p.name_in(domain), p.description});
    list.push_back({{"type", d.type},
                    {"tex", d.equation},
                    {"law", d.law},
                    {"summary", d.summary},
                    {"notes", d.notes},
                    {"source", d.source},
                    {"symbols", symbols}});
  }
  return list;
}

json sliders(const ReadResult& read) {
  json list = json::array();
  for (const AdjustableNumber& knob : adjustable_numbers(read)) {
    const char* scale = knob.scale == AdjustableNumber::Scale::logarithmic ? "log" : knob.scale == AdjustableNumber::Scale::whole ? "whole" : "linear";
    list.push_back({{"group", knob.group},
                    {"name", knob.name},
                    {"description", knob.description},
                    {"value", knob.value},
                    {"unit", knob.unit},
                    {"scale", scale},
                    {"low", knob.low},
                    {"high", knob.high},
                    {"step", knob.step},
                    {"asked", knob.asked},
                    {"line", knob.spot.line},
                    {"column", knob.spot.column}});
  }
  return list;
}

/// The [demo]; null if the scene has none.
json demo(const Demo& demo) {
  if (demo.question.empty()) return nullptr;
  return {{"question", demo.question}, {"change", demo.change}, {"see", demo.see}, {"why", demo.why}};
}

/// The curves of [plot]: pairs of columns.
json plot(const PlotTable& table) {
  json curves = json::array();
  for (const PlotTable::Curve& curve : table.curves) curves.push_back({curve.x, curve.y});
  return {{"curves", curves}};
}

/// The drawing with the nodes at both ends of each symbol and the points where symbols meet nodes; or why there is no drawing.
json schematic(const ReadResult& read) {
  const Scene& scene = *read.scene;
  try {
    const draw::Picture picture = draw::schematic(scene, {.title = "", .sources = &read.sources});
    json ends = json::object(), joints = json::array();
    for (const draw::Mark& mark : picture.marks) {
      json& of_element = ends[scene.elements[static_cast<std::size_t>(mark.element)].name];
      for (const draw::Mark::End& end : mark.ends) {
        const bool left = 2 * end.at.x < mark.box.left + mark.box.right;
        const std::string& node = scene.nodes[static_cast<std::size_t>(end.node)].name;
        of_element[left ? "left" : "right"] = node;
        joints.push_back({{"element", scene.elements[static_cast<std::size_t>(mark.element)].name}, {"node", node}, {"x", end.at.x}, {"y", end.at.y}});
      }
    }
    return {{"svg", draw::svg(picture, scene)}, {"ends", ends}, {"joints", joints}, {"why_not", ""}};
  } catch (const plot::Mistake& mistake) {
    return {{"svg", ""}, {"ends", json::object()}, {"joints", json::array()}, {"why_not", mistake.what()}};
  }
}

}  // namespace

std::string to_line(const json& message) { return message.dump(-1, ' ', false, json::error_handler_t::replace); }

void add_place(const Spot& spot, json& message) {
  if (spot.file != 0) return;
  message["line"] = spot.line;
  message["column"] = spot.column;
}

std::string mistakes_message(const ReadResult& read) {
  json items = json::array();
  for (const Diagnostic& d : read.diagnostics) {
    json item = {{"severity", d.severity == Severity::error ? "error" : "warning"},
                 {"message", printable(d.message)},
                 {"hint", printable(d.hint)},
                 {"text", format(d, read.sources)}};
    add_place(d.spot, item);
    items.push_back(item);
  }
  return to_line({{"kind", "mistakes"}, {"items", items}});
}

std::string explanation_message(const Scene& scene) {
  try {
    json list = json::array();
    for (const tool::Passage& passage : tool::passages(scene, explain(scene))) {
      json lines = json::array();
      for (const auto& [label, text] : passage.lines) lines.push_back({{"label", label}, {"text", text}});
      list.push_back({{"heading", passage.heading}, {"lines", lines}});
    }
    return to_line({{"kind", "explanation"}, {"passages", list}, {"why_not", ""}});
  } catch (const SimulationError& error) {
    return to_line({{"kind", "explanation"}, {"passages", json::array()}, {"why_not", error.what()}});
  }
}

std::string scene_message(const ReadResult& read, const std::string& file, std::size_t own_records) {
  const Scene& scene = *read.scene;
  json sources = json::array();
  for (const Sources::File& source : read.sources.files) {
    constexpr std::size_t most = 100'000;
    const std::string cut = source.text.size() > most ? "\n... and more\n" : "";
    const std::string name = source.role == Sources::Role::scene ? source.path.string() : seen_from(read.sources.files.front().path, source.path);
    sources.push_back({{"file", name}, {"role", name_of(source.role)}, {"text", source.text.substr(0, most) + cut}});
  }
  const json drawing = schematic(read);
  return to_line({{"kind", "scene"},
                  {"file", file},
                  {"title", scene.title},
                  {"domain", name_of(scene.domain)},
                  {"start", scene.start},
                  {"stop", scene.stop},
                  {"accuracy", scene.accuracy},
                  {"records", records(read)},
                  {"own_records", own_records},
                  {"elements", elements(scene)},
                  {"element_count", std::count_if(scene.elements.begin(), scene.elements.end(), [](const SceneElement& e) { return e.part == SceneElement::Part::none; })},
                  {"node_count", scene.nodes.size() - 1},
                  {"equations", equations(scene)},
                  {"sliders", sliders(read)},
                  {"demo", demo(read.presentation.demo)},
                  {"plot", plot(read.presentation.plot)},
                  {"schematic", drawing.at("svg")},
                  {"ends", drawing.at("ends")},
                  {"joints", drawing.at("joints")},
                  {"no_schematic", drawing.at("why_not")},
                  {"sources", sources}});
}

}  // namespace rheonet::report
