#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Result of the check of a claim.
struct Finding {
  double found = not_given;  ///< SI; NaN if it does not exist (a level never crossed, a ratio to 0)
  double tolerance = 0;      ///< on either side of the claimed value, SI
  bool holds = false;
};

/// Evaluates the records that a scene's claims refer to, during a run. Each step is divided into pieces no longer than an
/// output interval, which are halved until the cubic through 4 points of a record agrees with the record to the run's
/// accuracy. The points are those of Lobatto's rule, which gives means. Extremes lie at these points or at turning points of
/// the cubic; between two of them a record is monotonic, so that no crossing of a level is missed.
class Claims {
 public:
  /// The claimed records at a time in the last step; times count from the start of the run.
  using Read = std::function<const std::vector<double>&(double t)>;
  using Rows = std::array<std::vector<double>, 4>;  ///< the claimed records at 4 times

  explicit Claims(const Scene& scene);
  bool any() const { return !claims_.empty(); }

  /// State just after the start or an event. `fastest`: largest angular frequency of the inputs from there on [rad/s].
  void begin(double t, const std::vector<double>& values, double fastest = 0);
  void step(double from, double to, const Read& read);
  /// The finding of each of the scene's claims.
  std::vector<Finding> findings() const;

 private:
  /// The largest value of a record so far. If several peaks have one height, within the accuracy, `at` is the time of the first.
  struct Peak {
    double value = not_given, at = not_given;
    double height = not_given;  ///< value at `at`
    bool passed = false;        ///< the record has fallen since
    void see(double t, double now, double equal);
  };
  /// Figures of one record, so far.
  struct Statistics {
    double last = not_given;
    Peak largest, smallest;  ///< `smallest`: of the negative of the record
    double integral = 0, squares = 0, length = 0;
    double at = not_given;
  };
  struct State {
    Claim claim;      ///< its times count from the start of the run
    Statistics of, per;   ///< `of`: the record; `per`: the record by which it is divided
    double side = 0;            ///< last side of the level: 1, -1; 0 if not known yet
    double looked = not_given;  ///< time of the last point examined
    double crossed = not_given;
  };

  struct Point {
    double t, value;
  };

  /// `halvings`: how many led to this piece; `parent`: the deviation (as of off_cubic) of the piece that was halved.
  void piece(double from, double to, const Read& read, int halvings = 0, double parent = 0);
  bool may_matter(double middle, const Rows& rows) const;
  /// Largest deviation of the cubics of a piece from the claimed records at x in [-1, 1], in units of the accuracy.
  /// `probed`: the records there.
  double off_cubic(double middle, const Rows& rows, double x, const std::vector<double>& probed) const;
  void see(const std::vector<double>& row);
  void end_piece(const State& state, Statistics& statistics, double to, double value) const;
  void look(State& state, Statistics& statistics, int record, const Point& point, const Read& read);
  double figure(const State& state, const Statistics& statistics) const;

  std::vector<State> claims_;
  std::vector<double> cuts_;     ///< times named by claims, at which pieces end
  std::vector<double> largest_;  ///< magnitude in the run of each claimed record
  std::vector<double> values_;   ///< of the claimed records at the end of the last piece
  double interval_;
  double slack_;  ///< an event this close to a time coincides with it, as for rows
  double start_, length_, accuracy_;
  double fastest_ = 0;
  bool any_over_time_ = false;  ///< some figure depends on more than one time
};

}  // namespace rheonet
