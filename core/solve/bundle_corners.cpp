#include "core/solve/bundle_corners.hpp"

#include <algorithm>

#include "core/base/index.hpp"

namespace rheonet {

namespace {

// Length of the moving average, in steps.
constexpr double memory = 32;
// At the strict tolerance kinks make steps short, and most steps cross no kink. So the larger tolerance is tried for `trial`
// steps once the share of steps with kinks exceeds `promising`, which a single kink does not reach. It is kept while that
// share exceeds `largest_pace`.
constexpr double promising = 0.05, largest_pace = 1.0 / 3;
constexpr long trial = 64;
// Longest wait between trials, in steps: each failed trial doubles the wait.
constexpr long longest_wait = 1 << 16;

}  // namespace

bool BundleCorners::crossed(const Dae& dae, const Dae::View& view) {
  bool any = false;
  for (std::size_t b = 0; b < yielded_.size(); ++b) {
    const Iwan& law = (*network_.bundles)[b];
    const Branch& ends = dae.structure().deflections[at(network_.first_bundle) + b];
    const auto smooth = [&](NodeId node) {
      const Kind kind = dae.structure().kind[at(node)];
      return kind == Kind::known || kind == Kind::massive;
    };
    // Without masses at both ends a kink is one of a velocity or of its slope, and a larger tolerance gains nothing.
    if (!smooth(ends.a) || !smooth(ends.b)) continue;
    const Yielded now{law.branch(), law.yielded(view.p[at(network_.first_bundle) + b])};
    if (now.branch == yielded_[b].branch && now.pairs > yielded_[b].pairs) any = true;
    yielded_[b] = now;
  }
  return any;
}

void BundleCorners::follow(const Dae& dae, const Dae::View& view) {
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
