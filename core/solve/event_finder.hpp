#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace rheonet {

/// Event functions (guards) along a trajectory: an event is a fall of one of them from positive to 0 or below.
class EventFunctions {
 public:
  virtual ~EventFunctions() = default;
  virtual int count() const = 0;
  virtual void evaluate(double t, const double* y, const double* yp, double* g) = 0;
  /// Dead band included in function `k`, which keeps round-off from firing it. If the function exceeds the band at the
  /// beginning of a step, its event is located where it has fallen to the band. Otherwise every event would be late, and over
  /// a long run the delays add up.
  virtual double band(int /*k*/) const { return 0; }
};

/// Finds the first event of a step.
class EventFinder {
 public:
  /// Moves the solution to a time within the step, and evaluates the event functions there.
  using Look = std::function<void(double t, std::vector<double>& functions)>;

  /// With `locate` an event is located within its step, otherwise it is taken to be at the end. `functions` must outlive this.
  EventFinder(const EventFunctions& functions, bool locate, Look look);

  bool none() const { return fired_.empty(); }
  /// The event functions at the beginning of the next step; the ends of steps that have no event are the beginnings of the next.
  std::vector<double>& at_begin() { return left_; }
  /// For steps that are short beside what changes: the functions are looked at at the end. Returns the time of the event, just behind it.
  std::optional<double> in_step(double begin, double end);
  /// For long steps: a function may fall through 0 and come back.
  std::optional<double> in_long_step(double begin, double end);
  /// This one alone has fired, as something else has found.
  void take(int which);
  /// For each function, whether it fired at the last event (1) or not (0).
  const std::vector<int>& fired() const { return fired_; }

 private:
  struct Seen { double time; std::vector<double> functions; };
  Seen look_at(double t) const;
  std::optional<double> first_of(const std::vector<Seen>& seen);
  std::vector<double> find_dips(const std::vector<Seen>& seen, double end) const;
  std::optional<double> minimum_near(std::size_t function, double t, double begin, double end, double apart) const;
  bool falls(const std::vector<double>& now) const;
  double share_to_zero(double weight) const;
  double before_end(double end, double later) const;
  std::optional<double> fire(double begin, double end);
  double locate(double begin, double end);

  const EventFunctions& functions_;
  bool locate_;
  Look look_;
  std::vector<int> fired_;
  std::vector<double> left_, between_, right_;  ///< event functions at both ends of an interval and within
  std::vector<double> later_;                   ///< and at a time after its end
  std::vector<double> band_;                    ///< dead band of each that fell in the last step: see EventFunctions
};

}  // namespace rheonet
