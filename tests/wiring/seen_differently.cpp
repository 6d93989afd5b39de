#include "tests/wiring/seen_differently.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/network/component.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test {

namespace {

std::vector<View::Column> same_columns(const Scene& scene) {
  std::vector<View::Column> columns;
  for (const Record& r : scene.records) columns.push_back({.path = r.path, .original = r.path});
  return columns;
}

View renamed(const Scene& scene) {
  View view{.name = "renamed and reordered", .scene = scene, .columns = same_columns(scene)};
  const int nodes = static_cast<int>(scene.nodes.size()), elements = static_cast<int>(scene.elements.size());
  const auto node = [&](NodeId n) { return n == ground ? ground : nodes - n; };
  std::reverse(view.scene.nodes.begin() + 1, view.scene.nodes.end());
  std::reverse(view.scene.elements.begin(), view.scene.elements.end());
  for (std::size_t n = 1; n < view.scene.nodes.size(); ++n) view.scene.nodes[n].name.insert(0, "z_");
  for (SceneElement& e : view.scene.elements) {
    e.name.insert(0, "y_");
    e.a = node(e.a);
    e.b = node(e.b);
    e.support = node(e.support);
  }
  for (std::size_t k = 0; k < view.scene.records.size(); ++k) {
    Record& r = view.scene.records[k];
    const bool of_node = r.subject == Record::Subject::node;
    r.index = of_node ? node(r.index) : elements - 1 - r.index;
    r.path.insert(0, of_node ? "z_" : "y_");
    view.columns[k].path = r.path;
  }
  return view;
}

View swapped(const Scene& scene) {
  View view{.name = "ends swapped", .scene = scene, .columns = same_columns(scene)};
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const bool gear = static_cast<bool>(components()[static_cast<std::size_t>(scene.elements[e].declaration)]->ratio);
    if (scene.elements[e].at || gear || one_way(scene.elements[e])) continue;
    view.scene = exchanged(std::move(view.scene), static_cast<int>(e));
    for (std::size_t k = 0; k < scene.records.size(); ++k) {
      const Record& r = scene.records[k];
      if (r.subject == Record::Subject::element && r.index == static_cast<int>(e)) view.columns[k].factor = -1;
    }
  }
  return view;
}

View in_units(const Scene& scene, const std::string& name, const Scaling& scaling) {
  View view{.name = name, .scene = rescaled(scene, scaling), .columns = same_columns(scene), .time = scaling.time};
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    view.columns[k].factor = factor(scene, scene.records[k], scaling);
  }
  return view;
}

View from_moving_frame(Scene scene, double v) {
  View view{.name = "from a moving frame", .scene = {}, .columns = same_columns(scene)};
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    const Record& r = scene.records[k];
    if (r.subject == Record::Subject::node) {
      (r.channel == Record::Channel::velocity ? view.columns[k].offset : view.columns[k].rate) = v;
    }
  }
  // The elements at ground are moved to a node that stands still but could move.
  const NodeId base = static_cast<NodeId>(scene.nodes.size());
  scene.nodes.push_back({.name = "base", .spot = {}});
  for (SceneElement& e : scene.elements) {
    if (e.a == ground) e.a = base;
    if (!e.at && e.b == ground) e.b = base;
    if (components()[static_cast<std::size_t>(e.declaration)]->ratio && e.support == ground) e.support = base;
    // A mass without a start velocity starts at rest.
    if (declarations()[static_cast<std::size_t>(e.declaration)]->type == "mass") {
      scene.nodes[static_cast<std::size_t>(e.a)].velocity = 0;
    }
  }
  SceneElement carrier = SceneBuilder::element("carrier", "motion");
  carrier.at = true;
  carrier.a = base;
  carrier.signal_parameters = {1};
  carrier.signals = std::vector<Signal>(1, Signal(Signal::Constant{0}));
  scene.elements.push_back(std::move(carrier));
  view.scene = boosted(std::move(scene), v);
  return view;
}

View reversed(const Wiring& wiring) {
  View view{.name = "groups in reverse order", .scene = scene_of(netlist_of(wiring, wired(commuted(*wiring.tree)))), .columns = {}};
  for (View::Column& column : same_columns(view.scene)) {
    // Inner nodes are different in this view.
    if (column.path[0] != 'n') view.columns.push_back(std::move(column));
  }
  return view;
}

}  // namespace

std::vector<View> seen_differently(const Wiring& wiring, const Scene& scene) {
  std::vector<View> views = {renamed(scene), swapped(scene)};
  // One scale of lengths, and one frame that moves, are for scenes of one domain.
  const bool two_domains = std::set<char>(wiring.rotating.begin() + (wiring.rotating.empty() ? 0 : 1), wiring.rotating.end()).size() == 2;
  if (two_domains) return views;
  for (View view : {in_units(scene, "small lengths, large forces", {.length = 1e-9, .time = 1, .force = 1e9}),
                             in_units(scene, "long times, small forces", {.length = 1, .time = 1e9, .force = 1e-9}),
                             in_units(scene, "large lengths, short times", {.length = 1e9, .time = 1e-9, .force = 1})}) views.push_back(std::move(view));
  if (wiring.drive != Wiring::Drive::position) views.push_back(from_moving_frame(scene, 0.371));
  const bool masses_between = std::count(wiring.massive.begin() + 2, wiring.massive.end(), char{1}) > 0;
  if (wiring.tree && !masses_between) views.push_back(reversed(wiring));
  return views;
}

std::vector<View> reduced(const Scene& scene, const Scene& unreduced) {
  constexpr std::size_t one_in = 5;
  Scene few = scene;
  few.records.clear();
  for (std::size_t k = 0; k < scene.records.size(); k += one_in) few.records.push_back(scene.records[k]);
  std::vector<View> views{{.name = "reduced", .scene = scene, .columns = same_columns(scene)},
                          {.name = "reduced, with few records", .scene = few, .columns = same_columns(few)}};
  for (const std::string& name : unreduced.keep) {
    for (std::size_t k = 0; k < 2; ++k) {
      View view = views[k];
      view.name += " by " + name + " alone";
      view.scene.keep = unreduced.keep;
      std::erase(view.scene.keep, name);
      views.push_back(std::move(view));
    }
  }
  return views;
}

}  // namespace rheonet::test
