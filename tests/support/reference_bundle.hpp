#pragma once

#include <cstddef>
#include <vector>

#include "tests/support/reference_law.hpp"

namespace rheonet::test {

/// All elements between the same two nodes: one monotone map from displacement to force, the sum of theirs.
class ReferenceBundle {
 public:
  struct Member {
    ReferenceLaw law;
    double sign;  ///< -1 if the element is connected the other way round
    int element;
  };
  struct Point { double step, force, slope; };

  ReferenceBundle(NodeId a, NodeId b) : a(a), b(b) {}
  void add(Member member) { members_.push_back(std::move(member)); }

  NodeId a, b;

  bool steep() const;
  double typical_slope(double h) const;

  /// Force and slope at a given displacement.
  Point at(double step, double h) const;
  /// The same in series with a spring of stiffness K that carries the force `preload` when it is not stretched:
  /// the point of the bundle, and the slope of the whole. `total` is the displacement of both.
  Point with_spring(double total, double K, double preload, double h) const;

  /// Ends the step: shares `force` among the members.
  void accept(double step, double force, double h);
  /// The force at step = 0 where nothing else decides it: each member's preferred one.
  double preferred(double h) const;
  /// Makes each slider's direction of slip fit the step just found; true if that changed a map.
  bool follow_slips(double step);
  /// True if at step = 0 the forces of the members do not follow from their sum.
  bool ambiguous_at_rest() const;
  /// True if at step = 0 the force may lie anywhere in an interval.
  bool set_valued() const;
  /// True if a slider has stopped since `before` under a force at which it could as well have gone on: one that is above
  /// what it slips with, but not above what breaks it away.
  bool could_slip_on(const ReferenceBundle& before) const;
  bool relaxing() const;  ///< with a cfm, whose force at rest goes on from the one before

  const std::vector<Member>& members() const { return members_; }
  ReferenceLaw& law(std::size_t member) { return members_[member].law; }

 private:
  struct Interval { double low, high; };
  Interval at_rest(double h) const;
  void share_at_rest(double force, double h);

  std::vector<Member> members_;
};

}  // namespace rheonet::test
