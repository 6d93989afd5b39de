#pragma once

#include <memory>
#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// The mass matrix M of the nodes that inerters couple: masses on the diagonal, and for each inerter of inertance b between the
/// nodes i and j
///     M_ii += b,   M_jj += b,   M_ij = M_ji -= b
/// without rows and columns for prescribed nodes. It is positive definite, because a mass or a prescribed node belongs to
/// each group of nodes that inerters join (see Structure). All other nodes have a mass of their own or none.
class InertiaMatrix {
 public:
  /// Network and structure must outlive this.
  InertiaMatrix(const Network& network, const Structure& structure);
  ~InertiaMatrix();

  bool coupled() const { return !nodes_.empty(); }
  /// Solves M a = force - (the inerters' forces due to the accelerations of prescribed nodes), for the coupled nodes alone.
  /// `acceleration` holds those of prescribed nodes [m/s^2], `force` the sum of the forces that act on each node [N].
  void accelerate(const std::vector<double>& force, std::vector<double>& acceleration) const;

 private:
  struct Factors;
  const Network& network_;
  const Structure& structure_;
  std::vector<NodeId> nodes_;  ///< the coupled ones
  std::vector<int> row_;       ///< of each node, -1
  std::unique_ptr<Factors> factors_;
};

}  // namespace rheonet
