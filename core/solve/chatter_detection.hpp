#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Detects runs without progress: events that repeat at one place (chattering) or ever faster (accumulating), and failures.
class ChatterDetection {
 public:
  /// `accuracy` is that of the run: a change below this share of the largest velocity or deflection so far is none.
  ChatterDetection(std::size_t causes, double accuracy);

  /// Begins all counts anew.
  void reset();
  /// Counts the causes (indices of elements, or of the solver) that fired at t and led to this state. True when one of them
  /// has fired `numerics::chatter_events` times while the state has not changed. The caller then judges whether this took too little time.
  /// Velocities are compared with the largest seen here, or with `largest_velocity` of the run [m/s].
  bool lost(double t, const std::vector<int>& causes, const State& state, double largest_velocity = 0);
  /// Call where `lost` returned true but the events took long enough to be legitimate: begins new counts at t. True when
  /// the state has not changed for many such counts within `instant` [s], so that the run would never end.
  bool without_end(double t, double instant);
  /// Time at which the count began [s].
  double since() const { return since_; }
  /// Causes that fired since then, the most frequent first.
  std::vector<int> busiest() const;
  /// A message that names the busiest elements and a remedy.
  std::string describe(const Network& network, double t) const;

  /// Counts the causes that fired at t, `left` [s] before the end of the run. True when the times from one event of a cause to its next do
  /// not become shorter, and the run would never end, whatever the state does. Impacts that time does not resolve have many more events.
  bool endless(double t, const std::vector<int>& causes, double left, bool impacts = false);
  /// Sum of these times [s].
  double endless_time() const;
  /// A message that names the elements and a remedy. `squeezed`: they are rigid stops that hit.
  std::string describe_endless(const Network& network, bool squeezed) const;

  /// Counts a failure of the integrator at t. True when the last failures all lie `within` this time [s]: the solution
  /// probably grows without bound there.
  bool failing(double t, double within);
  /// Counts a step that ended at t. True when many steps in succession advanced time by round-off only; `grain` is a few
  /// ulps of time [s].
  bool stalled(double t, double grain);

 private:
  struct Watched {
    double largest = 0;          ///< magnitude in the run
    std::vector<double> before;  ///< at `since`
    bool changed(const std::vector<double>& now, double accuracy);
  };

  double accuracy_;
  double since_ = 0;
  double first_ = 0;  ///< time of the last change of the state [s]
  int counts_ = 0;
  bool begun_ = false;
  Watched velocity_, deflection_;
  std::vector<int> count_;  ///< of each cause
  std::vector<int> fired_;  ///< causes with a count above 0
  struct Pause {
    double length;  ///< s
    int cause;
  };
  std::deque<Pause> pauses_;        ///< the last ones, between two events of one cause
  int counts_at_one_time_ = 0;      ///< how often in a row time did not resolve them
  std::vector<double> last_event_;  ///< of each cause: time of its last one [s]; NaN: there was none
  std::deque<double> failures_;  ///< times of the last failures [s]
  double reached_ = 0;           ///< time near which the last steps ended [s]
  int steps_there_ = 0;
};

}  // namespace rheonet
