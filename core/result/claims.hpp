#pragma once

#include <functional>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// What has become of a claim.
struct Finding {
  double found = not_given;  ///< SI; NaN if there is no such figure (what is never crossed, a ratio to 0)
  double tolerance = 0;      ///< on both sides of what is claimed, SI
  bool holds = false;
};

/// Follows the records that a scene's claims are about through a run. Each step is looked at in pieces no longer than
/// an output interval: at the 4 points of Lobatto's rule, which gives means, and where the cubic through them turns.
/// These are where extremes are, and between two of them a record goes one way: it reaches no level unseen.
class Claims {
 public:
  /// The claimed records at a time of the last step, counted from the start of the run.
  using Read = std::function<const std::vector<double>&(double t)>;

  explicit Claims(const Scene& scene);
  bool any() const { return !claims_.empty(); }

  /// Just after the start or an event.
  void begin(double t, const std::vector<double>& values);
  void step(double from, double to, const Read& read);
  /// One for each of the scene's claims.
  std::vector<Finding> findings() const;

 private:
  /// A figure of one record, as far as it has come.
  struct Course {
    double last = not_given, largest = not_given, smallest = not_given;
    double integral = 0, squares = 0, length = 0;
    double at = not_given;
  };
  struct State {
    Claim claim;      ///< its times count from the start of the run
    Course of, per;   ///< per: of the record that it is divided by
    double side = 0;            ///< of the level, that the record was on last: 1, -1; 0 not known yet
    double looked = not_given;  ///< when it was on that side
    double crossed = not_given;
  };

  struct Point {
    double t, value;
  };

  void piece(double from, double to, const Read& read);
  void look(State& state, Course& course, const Point& point, const Read& read);
  double figure(const State& state, const Course& course) const;

  std::vector<State> claims_;
  std::vector<double> cuts_;     ///< times at which pieces end: those that claims name
  std::vector<double> largest_;  ///< magnitude in the run of each claimed record
  std::vector<double> values_;   ///< at the end of what has been looked at
  double interval_;
  double slack_;  ///< an event this close to a time is at it, as of rows
  double start_, length_, accuracy_;
};

}  // namespace rheonet
