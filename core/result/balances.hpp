#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/result/yardstick.hpp"

namespace rheonet {

/// The forces at a massless node do not sum to 0, as they stand in the rows of a run.
struct Imbalance {
  std::string node;                   ///< its name
  std::vector<std::string> elements;  ///< those at the node
  double sum = 0;                     ///< of their forces, magnitude [N]
  double largest = 0;                 ///< the largest of these forces in the run [N]
  double time = 0;                    ///< of the row [s]
};

/// The balance of forces at each massless node that a record of a scene has to do with: of all the elements there, drives too,
/// as rows print them. Runs that share an error of a force cannot measure it by each other; at a node it shows.
class Balances {
 public:
  explicit Balances(const Scene& scene);

  /// The scene, with the forces that are needed but not recorded as records behind its own.
  const Scene& scene() const { return scene_; }
  /// How many of the records are the scene's own.
  std::size_t asked() const { return asked_; }

  /// Raises the errors of the scene's own records, which are relative to `allowed`, to what the rows of a run of `scene()` leave
  /// unbalanced at their nodes: that of a force by as much; that of a motion by the same share of itself as it is of the largest
  /// force there. Returns the imbalance that has raised an error beyond that the most; absent if none has.
  std::optional<Imbalance> raise(const Course& course, double allowed, std::vector<RecordError>& errors) const;

 private:
  struct Term { std::size_t record; double sign; };
  struct Node {
    NodeId id;
    std::vector<Term> terms;             ///< one for each element there
    std::vector<std::size_t> forces;     ///< own records that are forces of elements there
    std::vector<std::size_t> movements;  ///< own records of how the node moves, or of an element there
  };
  void find_nodes(const Scene& scene);

  Scene scene_;
  std::size_t asked_;
  std::vector<Node> nodes_;
};

/// "the forces of `k1`, `s1` at node `n1` sum to 0.01 N, 0.001 of the largest of them, at t = 0.5 s".
std::string describe(const Scene& scene, const Imbalance& imbalance);

}  // namespace rheonet
