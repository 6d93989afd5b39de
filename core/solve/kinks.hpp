#pragma once

#include <cstddef>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Small kinks one after the other, as a bundle of many pairs makes them where a mass smoothes what it does, upset the error
/// test more than the solution. Where most steps go over some, their errors have either sign, and hardly add up: tolerances
/// may be larger there (Accumulation::dense_share). What follows each kink by itself needs every digit.
class Kinks {
 public:
  /// The network must outlive this.
  explicit Kinks(const Network& network) : network_(network) {}

  /// After a step, with the view of the state that it reached.
  void follow(const Dae& dae, const Dae::View& view);
  /// Whether most steps go over some, or it is being tried if they do at a larger tolerance.
  bool dense() const { return dense_; }

 private:
  bool crossed(const Dae& dae, const Dae::View& view);

  const Network& network_;
  /// How far each bundle has yielded, and on which of its branches.
  struct Yielded { long branch = 0; std::size_t pairs = 0; };
  std::vector<Yielded> yielded_;
  double pace_ = 0;            ///< share of the last steps that went over kinks
  bool dense_ = false;
  bool found_dense_ = false;   ///< since it was last tried
  long since_ = 0, wait_ = 0;   ///< steps since it was last gone over to the one or the other; until it is tried again
};

}  // namespace rheonet
