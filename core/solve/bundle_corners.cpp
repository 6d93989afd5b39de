#include "core/solve/bundle_corners.hpp"

#include <algorithm>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

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
  pace_ += ((crossed(dae, view) ? 1 : 0) - pace_) / numerics::kink_average_steps;
  ++since_;
  if (dense_) {
    if (pace_ > numerics::kink_pace_kept) found_dense_ = true;
    if (since_ <= numerics::kink_trial_steps || pace_ > numerics::kink_pace_kept) return;
    wait_ = found_dense_ ? numerics::kink_trial_steps : std::min(2 * wait_ + numerics::kink_trial_steps, numerics::kink_longest_wait);
    dense_ = false;
  } else {
    if (since_ <= wait_ || pace_ <= numerics::kink_pace_tried) return;
    dense_ = true;
    found_dense_ = false;
  }
  since_ = 0;
}

}  // namespace rheonet
