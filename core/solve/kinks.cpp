#include "core/solve/kinks.hpp"

#include <algorithm>

#include "core/network/index.hpp"

namespace rheonet {

namespace {

// Steps over which is counted.
constexpr double memory = 32;
// At a strict tolerance kinks make steps short, and most of these go over none. So it is tried where one in so many does
// (which one kink by itself does not come to), for so many steps, and left off where at the larger tolerance not every
// third one does.
constexpr double promising = 0.05, largest_pace = 1.0 / 3;
constexpr long trial = 64;
// The longest wait until it is tried again: each failure doubles it.
constexpr long longest_wait = 1 << 16;

}  // namespace

bool Kinks::crossed(const Dae& dae, const Dae::View& view) {
  bool any = false;
  for (std::size_t b = 0; b < yielded_.size(); ++b) {
    const Iwan& law = (*network_.bundles)[b];
    const Branch& ends = dae.structure().deflections[at(network_.first_bundle) + b];
    const auto smooth = [&](NodeId node) {
      const Kind kind = dae.structure().kind[at(node)];
      return kind == Kind::known || kind == Kind::massive;
    };
    // Where a mass is not there to smooth it a kink is one of a velocity or of its slope, and nothing is gained.
    if (!smooth(ends.a) || !smooth(ends.b)) continue;
    const Yielded now{law.branch(), law.yielded(view.p[at(network_.first_bundle) + b])};
    if (now.branch == yielded_[b].branch && now.pairs > yielded_[b].pairs) any = true;
    yielded_[b] = now;
  }
  return any;
}

void Kinks::follow(const Dae& dae, const Dae::View& view) {
  if (!network_.bundles) return;
  yielded_.resize(network_.bundles->size());
  pace_ += ((crossed(dae, view) ? 1 : 0) - pace_) / memory;
  ++since_;
  if (dense_) {
    if (pace_ > largest_pace) found_dense_ = true;
    if (since_ <= trial || pace_ > largest_pace) return;
    wait_ = found_dense_ ? trial : std::min(2 * wait_ + trial, longest_wait);
    dense_ = false;
  } else {
    if (since_ <= wait_ || pace_ <= promising) return;
    dense_ = true;
    found_dense_ = false;
  }
  since_ = 0;
}

}  // namespace rheonet
