#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/result/reference_solution.hpp"

namespace rheonet {

/// An imbalance of forces at a massless node, in the rows of a run.
struct Imbalance {
  std::string node;                   ///< its name
  NodeId id = ground;                 ///< its index
  std::vector<std::string> elements;  ///< names of the elements at the node
  double sum = 0;                     ///< magnitude of the sum of their forces [N]
  double largest = 0;                 ///< largest of these forces in the run [N]
  double time = 0;                    ///< of the row with the imbalance [s]
};

/// Checks the balance of all forces, applied ones included, at each massless node that a record refers to. Runs that share
/// an error of a force cannot measure it by comparison; an imbalance reveals it.
class Balances {
 public:
  explicit Balances(const Scene& scene);

  /// The scene, with the additional forces needed appended to its own records.
  const Scene& scene() const { return scene_; }
  /// Number of the scene's own records.
  std::size_t asked() const { return asked_; }

  /// Raises the errors of the scene's own records, whose limit is `allowed` (relative), to the imbalances in the rows of a
  /// run of `scene()`. The error of a force is raised to the imbalance, that of a motion to its scale times imbalance /
  /// largest force there. Returns the imbalance behind the largest raised error above `allowed`; absent if there is none.
  std::optional<Imbalance> raise(const RowStore& rows, double allowed, std::vector<RecordError>& errors) const;

 private:
  struct Term { std::size_t record; double sign; };
  struct Node {
    NodeId id;
    std::vector<Term> terms;             ///< one for each element at the node
    std::vector<std::size_t> forces;     ///< own records that are forces of elements at the node
    std::vector<std::size_t> movements;  ///< own records of the motion of the node, or of an element there
  };
  /// The sum of the forces at a node, in the rows of a run.
  struct Sum {
    double largest_force = 0;
    double largest = 0, time = 0;  ///< Largest magnitude of the sum, and the time of its row.
    std::vector<double> beyond;    ///< First time at which it exceeds the limit of each record: those of `forces`, then those of `movements`.
  };
  void find_nodes(const Scene& scene);
  /// The sums are in common units, the error of a record in its own unit.
  double own(std::size_t record) const { return std::abs(scene_.records[record].factor); }
  std::vector<Sum> sums(const RowStore& rows, double allowed, const std::vector<RecordError>& errors) const;

  Scene scene_;
  std::size_t asked_;
  std::vector<Node> nodes_;
};

/// "the forces of `k1`, `s1` at node `n1` sum to 0.01 N, 0.001 of the largest of them, at t = 0.5 s".
std::string describe(const Scene& scene, const Imbalance& imbalance);

}  // namespace rheonet
