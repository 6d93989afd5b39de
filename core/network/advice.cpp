#include "core/network/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/loose_nodes.hpp"
#include "core/netlist/records.hpp"
#include "core/network/component.hpp"
#include "core/network/parts.hpp"

namespace rheonet {

namespace {

using Place = std::tuple<int, int, int>;

Place place_of(const Spot& spot) { return {spot.file, spot.line, spot.column}; }

Diagnostic warning(const Spot& spot, std::string message, std::string hint) {
  return {.severity = Severity::warning, .spot = spot, .message = std::move(message), .hint = std::move(hint)};
}

bool begins_elsewhere(double start) { return !std::isnan(start) && start != 0; }

/// The path of a node with its last part in lower case.
std::string without_capitals(const std::string& path) {
  std::string name = path;
  for (std::size_t i = path.rfind('.') == path.npos ? 0 : path.rfind('.'); i < name.size(); ++i)
    name[i] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  return name;
}

class Adviser {
 public:
  explicit Adviser(const Scene& scene) : scene_(scene), found_(loose_nodes(scene)) {
    for (const Diagnostic& diagnostic : found_) told_.insert(place_of(diagnostic.spot));
  }

  std::vector<Diagnostic> advise() {
    compare_names();
    look_at_parts();
    look_at_signals();
    std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) { return comes_before(a.spot, b.spot); });
    return std::move(found_);
  }

 private:
  /// Members of a `repeat` and instances of a model share their place in the file: warn once for all of them.
  void warn_once(const Spot& spot, std::string message, std::string hint) {
    if (told_.insert(place_of(spot)).second) found_.push_back(warning(spot, std::move(message), std::move(hint)));
  }

  void compare_names() {
    const auto has_capital = [](const SceneNode& node) { return without_capitals(node.name) != node.name; };
    if (std::none_of(scene_.nodes.begin(), scene_.nodes.end(), has_capital)) return;
    std::unordered_map<std::string, std::size_t> first;
    for (std::size_t n = 1; n < scene_.nodes.size(); ++n) {
      const auto [other, is_first] = first.emplace(without_capitals(scene_.nodes[n].name), n);
      const std::string& name = scene_.nodes[n].name;
      const std::string& same = scene_.nodes[other->second].name;
      if (is_first || told_.contains(place_of(scene_.nodes[other->second].spot))) continue;
      warn_once(scene_.nodes[n].spot, fmt::format("nodes `{}` and `{}` differ in capital letters only: they are two nodes, and nothing joins them",
                                                  same, name),
                fmt::format("write `{}` everywhere if one node is meant", same));
    }
  }

  /// Elements of some parts.
  struct Group {
    std::vector<std::string> names;
    Spot spot;  ///< of the first
  };

  template <typename Chosen>
  Group group(const Parts& parts, const Chosen& chosen) const {
    Group result;
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (parts.of_element[e] < 0 || !chosen(at(parts.of_element[e]))) continue;
      if (result.names.empty()) result.spot = scene_.elements[e].spot;
      result.names.push_back(scene_.elements[e].name);
    }
    return result;
  }

  void look_at_parts() {
    const Parts parts = find_parts(scene_, {}, Between::ground);
    const auto count = static_cast<std::size_t>(parts.count);
    // Parts without nodes (blocks alone) do not count. A loose node, or one with a doubtful name, already has its warning.
    std::vector<char> counts(count, 0), is_loose(count, 0);
    for (std::size_t n = 1; n < scene_.nodes.size(); ++n) {
      if (parts.of_node[n] < 0) continue;
      counts[at(parts.of_node[n])] = 1;
      if (told_.contains(place_of(scene_.nodes[n].spot))) is_loose[at(parts.of_node[n])] = 1;
    }
    for (std::size_t p = 0; p < count; ++p) counts[p] = counts[p] && !is_loose[p];
    const std::vector<char> driven = driven_parts(parts);
    const Group at_rest = group(parts, [&](std::size_t p) { return counts[p] && !driven[p]; });
    if (std::none_of(driven.begin(), driven.end(), [](char d) { return d != 0; })) {
      if (at_rest.names.empty()) return;
      found_.push_back(warning(at_rest.spot, "nothing drives the scene: everything stays at rest",
                               "add a `motion`, a `force`, or a velocity or position in [nodes]"));
      return;
    }
    if (!at_rest.names.empty()) {
      found_.push_back(warning(at_rest.spot, fmt::format("{} {} the rest of the network at ground only, and nothing drives {}",
                                                         format_list(at_rest.names), at_rest.names.size() > 1 ? "touch" : "touches",
                                                         at_rest.names.size() > 1 ? "them" : "it"),
                               "a node is mistyped, or an element is missing that joins it to the rest"));
      return;
    }
    look_at_driven_parts(parts, counts);
  }

  /// A scene with several networks usually compares them, and then records or claims something of each.
  void look_at_driven_parts(const Parts& parts, const std::vector<char>& counts) {
    if (std::count(counts.begin(), counts.end(), 1) < 2) return;
    const bool is_chosen = scene_.records.size() < every_record(scene_).size();
    const std::vector<char> asked = asked_parts(parts, is_chosen);
    const Group unasked = group(parts, [&](std::size_t p) { return counts[p] && !asked[p]; });
    if (unasked.names.empty()) return;
    const std::size_t first = static_cast<std::size_t>(std::find(counts.begin(), counts.end(), 1) - counts.begin());
    const Group told = is_chosen ? unasked : group(parts, [&](std::size_t p) { return counts[p] && p != first; });
    found_.push_back(warning(told.spot, fmt::format("{} {} the rest of the network at ground only{}", format_list(told.names), told.names.size() > 1 ? "touch" : "touches",
                                                    is_chosen ? ", and nothing is recorded there" : ": neither has an effect on the other"),
                             is_chosen ? "join it to the rest, record something of it, or leave it out"
                                       : "if these are several networks on purpose, say in `record` what is wanted of each"));
  }

  std::vector<char> driven_parts(const Parts& parts) const {
    std::vector<char> driven(static_cast<std::size_t>(parts.count), 0);
    std::vector<char> fed(scene_.elements.size(), 0);
    for (const SceneFeed& feed : scene_.feeds) {
      const Role role = components()[at(scene_.elements[at(feed.element)].declaration)]->role;
      if (role == Role::motion || role == Role::force) fed[at(feed.element)] = 1;
    }
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (parts.of_element[e] >= 0 && (fed[e] || drives(scene_.elements[e]))) driven[at(parts.of_element[e])] = 1;
    }
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      const SceneNode& node = scene_.nodes[n];
      if (parts.of_node[n] >= 0 && (begins_elsewhere(node.position) || begins_elsewhere(node.velocity))) driven[at(parts.of_node[n])] = 1;
    }
    return driven;
  }

  /// The element moves or pushes something, or starts or rests at a position other than 0.
  bool drives(const SceneElement& element) const {
    const Component& component = *components()[at(element.declaration)];
    if (component.role == Role::motion || component.role == Role::force) {
      return std::any_of(element.signals.begin(), element.signals.end(), [&](const Signal& signal) { return acts(signal); });
    }
    const std::vector<Parameter>& parameters = component.declaration.parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const bool displaces = parameters[k].kind == Parameter::Kind::initial || parameters[k].quantity == Quantity::position;
      if (component.role != Role::block && displaces && begins_elsewhere(element.values[k])) return true;
    }
    return false;
  }

  /// The signal is not 0 throughout the run.
  bool acts(const Signal& signal) const {
    const Piece piece = signal.piece(scene_.start);
    return piece.largest(scene_.start, scene_.stop) != 0 || piece.end < scene_.stop;
  }

  /// Flags the parts that have claims, or records if `records_too`.
  std::vector<char> asked_parts(const Parts& parts, bool records_too) const {
    std::vector<char> asked(static_cast<std::size_t>(parts.count), 0);
    const auto ask = [&](int part) {
      if (part >= 0) asked[at(part)] = 1;
    };
    const auto ask_for = [&](const Record& record) {
      if (record.subject == Record::Subject::node) ask(parts.of_node[at(record.index)]);
      if (record.subject == Record::Subject::element) ask(parts.of_element[at(record.index)]);
      if (record.subject == Record::Subject::block) ask(parts.of_element[at(scene_.blocks[at(record.index)].element)]);
      if (record.subject != Record::Subject::assembly) return;
      const SceneAssembly& assembly = scene_.assemblies[at(record.index)];
      ask(parts.of_node[at(assembly.a)]);
      ask(parts.of_node[at(assembly.b)]);
    };
    for (const std::vector<Record>* records : {&scene_.claimed, &scene_.records}) {
      if (records == &scene_.records && !records_too) continue;
      for (const Record& record : *records) for_each_operand(scene_, record, ask_for);
    }
    if (scene_.stop_when >= 0) ask(parts.of_element[at(scene_.blocks[at(scene_.stop_when)].element)]);
    return asked;
  }

  void look_at_signals() {
    for (const SceneElement& element : scene_.elements) {
      for (const Signal& signal : element.signals) {
        const auto* table = std::get_if<Signal::Table>(&signal.shape());
        if (!table || table->times.size() < 2) continue;
        const double end = table->time + table->times.back();
        const double before_last = table->values[table->values.size() - 2];
        // Two equal values at the end, or a jump there, mean that the last value is to be held.
        if (table->times[table->times.size() - 2] == table->times.back()) continue;
        if (end >= scene_.stop - time_rounding * (scene_.stop - scene_.start) || before_last == table->values.back()) continue;
        warn_once(element.spot, fmt::format("the table of `{}` ends at {:.6g} s, before the run does at {:.6g} s: its last value is held from there on",
                                            element.name, end, scene_.stop),
                  "end the run there, or give its last value once more at a later time");
      }
    }
  }

  const Scene& scene_;
  std::vector<Diagnostic> found_;
  std::set<Place> told_;
};

}  // namespace

std::vector<Diagnostic> advice_on(const Scene& scene) { return Adviser(scene).advise(); }

}  // namespace rheonet
