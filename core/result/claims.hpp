#pragma once

#include <array>
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
/// an output interval, halved until the cubic through 4 points of a record is the record, to the run's accuracy. The
/// points are those of Lobatto's rule, which gives means. Extremes are at them or where the cubic turns, and between two
/// of all these a record goes one way: it reaches no level unseen.
class Claims {
 public:
  /// The claimed records at a time of the last step, counted from the start of the run.
  using Read = std::function<const std::vector<double>&(double t)>;
  using Rows = std::array<std::vector<double>, 4>;  ///< the claimed records at 4 times

  explicit Claims(const Scene& scene);
  bool any() const { return !claims_.empty(); }

  /// Just after the start or an event; `fastest` is the largest angular frequency of what drives the records from there on [rad/s].
  void begin(double t, const std::vector<double>& values, double fastest = 0);
  void step(double from, double to, const Read& read);
  /// One for each of the scene's claims.
  std::vector<Finding> findings() const;

 private:
  /// A figure of one record, as far as it has come.
  struct Course {
    double last = not_given, largest = not_given, smallest = not_given;
    double largest_at = not_given, smallest_at = not_given;  ///< when it was that first
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

  /// One that has come of so many halvings, of one whose cubic was `parent` times too far from the record.
  void piece(double from, double to, const Read& read, int halvings = 0, double parent = 0);
  bool may_matter(double middle, const Rows& rows) const;
  /// How far the cubic through a piece is at x, of [-1, 1], from what the records are there, in parts of what the accuracy
  /// allows: the most of those that are looked at in this piece.
  double off_cubic(double middle, const Rows& rows, double x, const std::vector<double>& probed) const;
  void see(const std::vector<double>& row);
  void end_piece(const State& state, Course& course, double to, double value) const;
  void look(State& state, Course& course, const Point& point, const Read& read);
  double figure(const State& state, const Course& course) const;

  std::vector<State> claims_;
  std::vector<double> cuts_;     ///< times at which pieces end: those that claims name
  std::vector<double> largest_;  ///< magnitude in the run of each claimed record
  std::vector<double> values_;   ///< at the end of what has been looked at
  double interval_;
  double slack_;  ///< an event this close to a time is at it, as of rows
  double start_, length_, accuracy_;
  double fastest_ = 0;
  bool any_over_time_ = false;  ///< some figure is of more than one instant
};

}  // namespace rheonet
