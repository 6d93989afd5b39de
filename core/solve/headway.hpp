#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Whether events bring a run on, or come over and over at one place (chattering) or ever faster (accumulating).
class Headway {
 public:
  /// So many events of one element are looked at.
  static constexpr int enough = 500;

  /// `accuracy` is that of the run: a change by less, of the largest velocity or deflection so far, is none.
  Headway(std::size_t causes, double accuracy);

  /// What comes is counted from here on.
  void reset();
  /// These causes (elements, say) have fired at t, and left the network in this state. True when one of them has had
  /// `enough` events while nothing has changed: whether there is something wrong depends on how long that took.
  bool lost(double t, const std::vector<int>& causes, const State& state);
  /// It has taken long enough to be a fault of nothing: counts begin anew at t. True when nothing has changed meanwhile
  /// for so many counts, within `instant` [s]: with such an instant after the other the run would not come to its end.
  bool without_end(double t, double instant);
  /// Time at which the count began [s].
  double since() const { return since_; }
  /// What has fired since then, the busiest first.
  std::vector<int> busiest() const;
  /// The same in words, the names and what would end it: causes beyond the elements of the network are left out.
  std::string describe(const Network& network, double t) const;

  /// The integrator has failed at t: true when it does so over and over within this time. It comes up to an instant at
  /// which something grows without bound.
  bool failing(double t, double within);
  /// A step has come to t: true when step after step brings the time on by no more than its rounding, of which `grain` [s] are
  /// some.
  bool standing(double t, double grain);

 private:
  struct Watched {
    double largest = 0;          ///< magnitude in the run
    std::vector<double> before;  ///< at `since`
    bool changed(const std::vector<double>& now, double accuracy);
  };

  double accuracy_;
  double since_ = 0;
  double first_ = 0;  ///< of the counts since something changed [s]
  int counts_ = 0;
  bool begun_ = false;
  Watched velocity_, deflection_;
  std::vector<int> count_;  ///< of each cause
  std::vector<int> fired_;  ///< causes with a count above 0
  std::deque<double> failures_;  ///< the last instants [s]
  double reached_ = 0;           ///< where the last steps have been [s]
  int steps_there_ = 0;
};

}  // namespace rheonet
