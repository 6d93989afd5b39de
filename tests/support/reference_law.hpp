#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/scene.hpp"
#include "tests/support/slider_bounds.hpp"

namespace rheonet::test {

/// A law over one time step of length h: a monotone map from the displacement `step` of the element during the step to
/// its force at the end of it. At step = 0 the map may be set-valued: an interval of forces.
///
///     spring   f = k (d + step - d0)
///     dashpot  f = B |step/h|^n sgn
///     slider   f = Fc sgn(step), an interval at 0; with Stribeck's curve (Fc + (Fs - Fc) exp(-|step/(h vs)|^n)) sgn(step)
///     loss     the friction of a transmission: as a slider, with a force of its own for each direction
///     stop     f = k x beyond a bound by x, and B step/h within +-k x
///     freewheel  f = 0 for step > 0, any f <= 0 for step = 0; a step < 0 is impossible
///     sfm      the closed form between two reversals, in the direction of the step
///     vfm      (B/sigma) (f - f_before)/h + f = B step/h
///     cfm      sfm's closed form along step - h f/B, in the direction of the step. At 0 the graph between the two
///              directions is filled in (Filippov's solution)
class ReferenceLaw {
 public:
  static constexpr double rounding = 4e-16;  ///< error of a sum by round-off, as a fraction of its terms
  enum class Type { spring, dashpot, slider, sfm, vfm, cfm, freewheel, stop, loss };
  struct Value { double force, slope; };
  struct Interval { double low, high; };

  /// `displacement` is that of the element's ends at the start.
  ReferenceLaw(const SceneElement& element, const Declaration& declaration, double displacement);
  /// The friction of a transmission.
  static ReferenceLaw loss() { return ReferenceLaw(Type::loss); }
  static bool is_law(const std::string& type);

  Type type() const { return type_; }
  /// Sticks at 0.
  bool rigid() const { return type_ == Type::slider || type_ == Type::freewheel || type_ == Type::loss; }
  /// Set-valued at 0, or of infinite slope there.
  bool steep() const { return rigid() || type_ == Type::cfm || (type_ == Type::dashpot && exponent_ < 1); }

  Value value(double step, double h) const;  ///< step = 0 only where the law is not set-valued
  Interval at_rest(double h) const;          ///< forces at step = 0
  double preferred(double h) const;          ///< the one of these that E = sigma gives (s = sgn 0 = 0); 0 if it sticks

  /// The bounds of a slider during the next step, if they vary.
  void bound(const SliderBounds& bounds) { coulomb_ = bounds.coulomb, breakaway_ = bounds.breakaway; }

  /// The forces of a transmission's friction in both directions.
  Interval range() const { return range_; }
  void set_range(Interval range) { range_ = range; }

  /// Ends the step.
  void accept(double step, double force, double h);
  double force() const { return force_; }
  double coulomb() const { return coulomb_; }
  double breakaway() const { return breakaway_; }

  /// The piece of its map that the last step was on: another one means a corner in the force.
  struct Piece {
    int direction = 0;  ///< of the step
    int leaving = 0;    ///< of the velocity at its end, by a straight line through those of this step and the last
    bool bound = false; ///< the force is at its bound
    bool operator==(const Piece&) const = default;
  };
  Piece piece() const { return piece_; }
  bool turned_since(const ReferenceLaw& before) const {
    return piece_ != before.piece_ || piece_.leaving != piece_.direction;
  }

  /// If this law has not turned since `before` but `other` has, as `other`.
  bool follow(const ReferenceLaw& other, const ReferenceLaw& before) {
    if (piece_.direction != before.piece_.direction || piece_.direction == other.piece_.direction) return false;
    piece_.direction = piece_.leaving = other.piece_.direction;
    return true;
  }

  /// A slider's direction of slip; 0 if it sticks. It sticks up to `breakaway`, and slips at `coulomb`.
  int slip() const { return slip_; }
  void set_slip(int direction) { slip_ = direction; }

  /// Size of the slope df/dstep in a step of length h, for the choice of numerical parameters.
  double typical_slope(double h) const;

 private:
  explicit ReferenceLaw(Type type) : type_(type) {}
  Value stribeck(double step, double h) const;
  Value solid_friction(double step) const;
  Value contact(double step, double h) const;
  double relaxing(double step, double h, double direction) const;

  Type type_;
  double stiffness_ = 0, damping_ = 0, coulomb_ = 0, breakaway_ = 0, exponent_ = 1;
  double force_ = 0;
  double stretch_ = 0;  ///< of a spring: d - d0; of a stop: d
  double lower_ = -INFINITY, upper_ = INFINITY;
  double sliding_ = 0, stribeck_ = NAN, shape_ = 2;  ///< of Stribeck's curve: Fc, vs, n
  Interval range_{0, 0};
  int slip_ = 0;
  Piece piece_;
  double velocity_ = 0, h_ = 0;  ///< mean velocity and length of the last step
};

}  // namespace rheonet::test
