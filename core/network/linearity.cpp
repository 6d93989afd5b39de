#include "core/network/linearity.hpp"

#include <fmt/format.h>

#include <set>
#include <variant>
#include <vector>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/netlist/switched_function.hpp"
#include "core/network/transmission.hpp"

namespace rheonet {

namespace {

/// A word for a signal that is not made of constants, straight lines and sines; else empty.
std::string bent(const Signal& signal) {
  const auto of = [](const auto& shape) -> std::string {
    using Shape = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Shape, Signal::Chirp>) return shape.frequency == shape.end_frequency ? "" : "a chirp";
    else if constexpr (std::is_same_v<Shape, Signal::Table>) return shape.smooth ? "a smooth table" : "";
    else return "";
  };
  return std::visit(of, signal.shape());
}

double frequency(const Signal& signal) {
  const auto* sine = std::get_if<Signal::Sine>(&signal.shape());
  return sine ? sine->frequency : 0;
}

struct Given {
  int element;
  const Signal* signal;
  bool moves = false;  ///< it is the position of a motion, whose velocity jumps at each corner
};

/// The signals of motions, forces and generators.
std::vector<Given> given_signals(const Network& network) {
  std::vector<Given> result;
  for (const Network::Motion& m : network.motions) result.push_back({m.element, &m.signal, m.position});
  for (const Network::Force& f : network.forces) result.push_back({f.element, &f.signal});
  for (const Blocks::Block& block : network.blocks.blocks) result.push_back({block.element, &block.signal});
  return result;
}

}  // namespace

std::optional<NotLinear> not_linear(const Network& network) {
  const auto name_of = [&](int element) -> const std::string& { return network.scene->elements[at(element)].name; };
  const auto wrong = [&](int element, const std::string& reason) { return NotLinear{network.spot_of(element), reason}; };
  const auto curved = [&](const auto& all, const auto& branches) -> std::optional<NotLinear> {
    for (const auto& laws : all) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        if (laws.batch->linear(i)) continue;
        const Branch& branch = branches[at(laws.first) + i];
        return wrong(branch.element, fmt::format("the law of `{}`{} is not linear", network.name_of(branch), laws.component ? " (" + laws.component->declaration.type + ")" : ""));
      }
    }
    return {};
  };
  if (auto found = curved(network.deflection_laws, network.deflections)) return found;
  if (auto found = curved(network.rate_laws, network.rates)) return found;
  for (const Blocks::Block& block : network.blocks.blocks) {
    if (block.function && !block.function->linear()) return wrong(block.element, fmt::format("`{}` computes `{}`", name_of(block.element), block.function->text()));
    if (block.law.delay > 0) return wrong(block.element, fmt::format("`{}` delays a signal", name_of(block.element)));
  }
  for (const Network::Motion& m : network.motions) {
    // It may part from rest like a power of time, below the round-off of a step.
    if (m.block >= 0) return wrong(m.element, fmt::format("blocks give the motion `{}`", name_of(m.element)));
  }
  for (const Network::Slider& slider : network.sliders) {
    if (slider.varying.size() > 1) return wrong(slider.branch.element, fmt::format("several parameters of `{}` vary", network.name_of(slider.branch)));
  }
  std::set<double> frequencies;
  for (const Given& given : given_signals(network)) {
    if (const double f = frequency(*given.signal); f > 0) frequencies.insert(f);
    if (const std::string what = bent(*given.signal); !what.empty()) return wrong(given.element, fmt::format("the signal of `{}` is {}", name_of(given.element), what));
    if (frequencies.size() > numerics::arc_frequencies)
      return wrong(given.element, fmt::format("the inputs have more than {} frequencies", numerics::arc_frequencies));
  }
  return {};
}

std::optional<NotLinear> not_linear(const Scene& scene) {
  if (const std::optional<Scene> converted = in_common_units(scene)) return not_linear(*converted);
  return not_linear(build_network(scene));
}

namespace {

/// The largest bundle, if it has so many kinks that IDA takes less time.
std::optional<NotLinear> many_kinks(const Network& network) {
  for (std::size_t k = 0; network.bundles && k < network.bundles->size(); ++k) {
    const std::size_t pairs = (*network.bundles)[k].size();
    const int element = network.deflections[at(network.first_bundle) + k].element;
    if (pairs > at(numerics::arc_unknowns))
      return NotLinear{network.spot_of(element), fmt::format("`{}` and others beside it, {} springs with sliders, are taken as one law", network.scene->elements[at(element)].name, pairs)};
  }
  return {};
}

/// A signal with so many corners that IDA, which steps over those that the accuracy cannot see, takes less time.
std::optional<NotLinear> many_corners(const Network& network) {
  for (const Given& given : given_signals(network)) {
    const auto* table = std::get_if<Signal::Table>(&given.signal->shape());
    if (!table || given.moves || table->times.size() <= numerics::arc_corners) continue;
    return NotLinear{network.spot_of(given.element),
                     fmt::format("the table of `{}` has {} points, and steps pass over most of its corners", network.scene->elements[at(given.element)].name, table->times.size())};
  }
  return {};
}

}  // namespace

NetworkOfMethod::NetworkOfMethod(const Scene& scene, Scene::Method method) : network_(build_network(scene)), exact_(false) {
  if (method == Scene::Method::ida) return;
  obstacle_ = not_linear(network_);
  if (obstacle_ && method == Scene::Method::exact) {
    throw SimulationError(scene.method == Scene::Method::exact ? scene.method_spot : obstacle_->spot,
                          fmt::format("`method = \"exact\"` needs laws that are linear between events, but {}; without `method` any scene is simulated", obstacle_->reason));
  }
  if (method == Scene::Method::automatic) {
    if (!obstacle_) obstacle_ = many_kinks(network_);
    if (!obstacle_) obstacle_ = many_corners(network_);
  }
  exact_ = !obstacle_;
  if (exact_ && network_.bundles) network_.bundles->stop_at_every_kink();
}

}  // namespace rheonet
