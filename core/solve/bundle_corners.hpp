#pragma once

#include <cstddef>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Detects runs over many small kinks: a bundle of spring-slider pairs makes one whenever a pair yields. Where masses smooth
/// them, kinks upset the error test more than the solution. If most steps cross some, their errors have either sign and
/// largely cancel: tolerances may be larger (GlobalErrorModel::dense_share). Resolving each kink needs the full tolerance.
class BundleCorners {
 public:
  /// The network must outlive this.
  explicit BundleCorners(const Network& network) : network_(network) {}

  /// Call after a step, with the view of the state at its end.
  void follow(const Dae& dae, const Dae::View& view);
  /// True where most steps cross kinks, or while a larger tolerance is on trial.
  bool dense() const { return dense_; }

 private:
  bool crossed(const Dae& dae, const Dae::View& view);

  const Network& network_;
  /// How many pairs of each bundle have yielded, and on which branch of its law.
  struct Yielded { long branch = 0; std::size_t pairs = 0; };
  std::vector<Yielded> yielded_;
  double pace_ = 0;            ///< moving average of the share of steps that crossed kinks
  bool dense_ = false;
  bool found_dense_ = false;   ///< most steps crossed kinks at some time in the present trial
  long since_ = 0, wait_ = 0;   ///< steps since `dense_` changed; steps until the next trial
};

}  // namespace rheonet
