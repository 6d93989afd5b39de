#include "core/result/possible_events.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/netlist/switched_function.hpp"
#include "core/network/rigid_links.hpp"
#include "core/result/grouped.hpp"

namespace rheonet {

namespace {

class EventSearch {
 public:
  explicit EventSearch(const Network& network) : network_(network) {}

  PossibleEvents find() {
    for (const Network::Slider& slider : network_.sliders) add_slider(slider);
    for (const Pair& pair : network_.pairs) add("stick, slip, reversal", pair.slider);
    for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        if (laws.batch->events(i) == 0 || laws.component == nullptr || laws.component->hidden) continue;
        std::string kinds = "reversal";
        if (laws.batch->can_hold(i)) kinds += ", stop, start";
        if (laws.batch->events(i) > 1) kinds += ", yield, release";
        if (laws.batch->contact(i)) kinds = "contact, release";
        add(kinds, network_.deflections[at(laws.first) + i].element);
      }
    }
    for (const Blocks::Block& block : network_.blocks.blocks) {
      if (block.law.limits()) add("limit, release", block.element);
      if (block.law.period > 0) add("sample", block.element);
      if (block.function && block.function->switches() > 0) add("switch", block.element);
    }
    for (const Network::Motion& motion : network_.motions) add_breaks(motion.signal, motion.element, motion.block);
    for (const Network::Force& force : network_.forces) add_breaks(force.signal, force.element, force.block);
    for (const Blocks::Block& block : network_.blocks.blocks) {
      if (block.generates) add_breaks(block.signal, block.element, -1);
    }
    result_.events = grouped_.take();
    return std::move(result_);
  }

 private:
  void add(const std::string& kinds, int e) { grouped_.add(kinds, {.kinds = kinds}, network_.scene->elements[at(e)].name); }

  void add_slider(const Network::Slider& slider) {
    if (is_rigid_link(slider)) return;
    if (slider.contact) return add("contact, impact, release", slider.branch.element);
    const bool reverses = std::isfinite(slider.box.forward.sliding.value) && std::isfinite(slider.box.backward.sliding.value);
    std::string kinds = "stick, slip";
    if (slider.box.breaks_away() || !slider.varying.empty()) kinds += ", breakaway";
    if (reverses) kinds += ", reversal";
    add(kinds, slider.branch.element);
  }

  /// Counts the jumps and corners of a signal, whose times are known.
  void add_breaks(const Signal& signal, int e, int block) {
    if (block >= 0) return;
    long count = 0;
    const double length = network_.scene->stop - network_.scene->start;
    for (double t = signal.piece(0).end; t < length && count < numerics::counted_discontinuities; t = signal.piece(t).end) ++count;
    result_.known_instants += count;
    if (count > 0) add("jumps or corners at known times", e);
  }

  const Network& network_;
  PossibleEvents result_;
  Grouped<Explanation::Events> grouped_;
};

}  // namespace

PossibleEvents possible_events(const Network& network) { return EventSearch(network).find(); }

}  // namespace rheonet
