#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// The mass matrix M of the nodes that inerters couple. Masses stand on its diagonal. An inerter of inertance b between the
/// nodes i and j adds
///     M_ii += b,   M_jj += b,   M_ij -= b,   M_ji -= b.
/// Prescribed nodes have no rows and columns. M is positive definite, because each group of nodes that inerters join has a
/// mass or a prescribed node (see Structure).
///
/// The equations of trains, C v = 0, hold for the accelerations too, and add their forces D f: [ M  D ; C  0 ]. D is the transpose of C
/// but for losses that slip. A train whose equation follows from others in the present modes has no force.
class InertiaMatrix {
 public:
  /// Network and structure must outlive this.
  InertiaMatrix(const Network& network, const Structure& structure);
  ~InertiaMatrix();

  bool coupled() const { return !nodes_.empty(); }
  /// Where losses depend on the speed: the present forces of the trains at their nodes (Structure::train_forces).
  void take_train_forces(const std::vector<std::array<double, 3>>& train_forces);
  /// Solves M a + D f = force - (the inerters' forces due to the accelerations of prescribed nodes) with C a = 0, for the coupled
  /// nodes alone. `acceleration` holds those of prescribed nodes [m/s^2], `force` the sum of the forces that act on each node [N];
  /// `train_force` gets the force of each train [N].
  void accelerate(const std::vector<double>& force, std::vector<double>& acceleration, std::vector<double>& train_force) const;

 private:
  struct Factors;
  struct TrainEntry { int row, column; std::size_t train, end; };
  const Network& network_;
  const Structure& structure_;
  std::vector<NodeId> nodes_;  ///< the coupled ones
  std::vector<int> row_;       ///< of each node, -1
  std::vector<Eigen::Triplet<double>> entries_;  ///< without the forces of trains
  std::vector<TrainEntry> train_entries_;
  std::unique_ptr<Factors> factors_;
};

}  // namespace rheonet
