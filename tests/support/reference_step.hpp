#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/index.hpp"
#include "tests/support/reference_bundle.hpp"
#include "tests/support/transmission_equation.hpp"

namespace rheonet::test {

/// A network of nodes, bundles of elements and masses, and one implicit Euler step of it. With x the displacements of
/// the nodes in a step of length h, the step is the minimum over the free nodes of the convex function
///
///     sum over bundles  int f d(step)  +  sum over masses  m (h/s) (x/h - v)^2/2  -  sum  F x
///
/// where each law is a monotone map from the displacement of its ends to its force at the end of the step. v is the mean velocity in the step
/// before, s the time between the middles of both steps: with s = h the inertial force of a mass in prescribed motion would be unbounded when
/// a short step follows a long one.
class ReferenceNetwork {
 public:
  struct Node {
    bool prescribed = false;
    double mass = 0;
    double position = 0, velocity = 0;  ///< at the end of the last step
    double acceleration = 0;            ///< in it
  };
  /// A gear: the sum of factors times displacements is 0. Its force on each node is its own times the factor there.
  struct Gear {
    std::array<NodeId, 3> node{};
    std::array<double, 3> factor{};
    double force = 0;  ///< at the end of the last step
    double K = 0;      ///< of the spring that stands for it while a step is sought (see minimise)
    double found = 0;  ///< its force at the present point
    TransmissionEquation equation{};
    /// The friction of its losses, a law between its first node and its support.
    struct Friction { std::size_t bundle, member; };
    std::optional<Friction> friction{};
  };
  /// Input of a step.
  struct Input {
    double h = 0;
    std::vector<double> displacement;  ///< of prescribed nodes
    std::vector<double> velocity;      ///< of prescribed nodes, at the end of the step
    std::vector<double> applied;       ///< force at each node
    struct Bound { std::size_t bundle, member; SliderBounds bounds; };
    std::vector<Bound> bounds;         ///< of sliders whose bounds vary, at the end of the step
  };

  ReferenceNetwork(std::vector<Node> nodes, std::vector<ReferenceBundle> bundles, std::vector<Gear> gears = {});

  /// Takes one step. Returns false if there is no minimum: nothing resists the applied force.
  bool step(const Input& input);
  /// Imbalance by round-off in the last step, as a fraction of the largest force: the displacements of both ends of a law are rounded, and in
  /// a short step the laws are steep.
  double blur() const { return blur_; }
  /// The velocities are those of an instant from here on, and no means: s is h in the next step.
  void begin() { before_ = 0; }

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<ReferenceBundle>& bundles() const { return bundles_; }
  const std::vector<Gear>& gears() const { return gears_; }
  /// Sum of the forces that the bundles exert on a node's surroundings: what must be applied there.
  double nodal_force(NodeId node) const { return nodal_[at(node)]; }
  /// True if a law is on another piece of its map than in `before`, or about to be: a reversal, a stop, a yield.
  bool turned_since(const ReferenceNetwork& before) const;
  /// Takes over the directions of those laws of `other` that have turned since `before`, though not here. False if there
  /// are none.
  bool follow(const ReferenceNetwork& other, const ReferenceNetwork& before);
  /// True if in the last step forces at rest did not follow from the balance alone, as with sliders that form a loop: the
  /// laws leave them open.
  bool ambiguous() const { return ambiguous_; }
  /// True if that has been so at a law that remembers its force: all that follows is then one of many solutions.
  bool forked() const { return forked_; }
  /// True if a slider has stopped since `before` where it could as well have gone on.
  bool could_slip_on(const ReferenceNetwork& before) const;

 private:
  /// The stretch of a series spring that is left, against the largest displacement in the step.
  static constexpr double little_stretch = 1e-9;
  double span(const Input& input) const { return before_ > 0 ? (before_ + input.h) / 2 : input.h; }
  bool minimise(const Input& input);
  bool minimise(const Input& input, double factor);
  double around(std::size_t bundle, double h) const;
  double around(const Gear& gear, double h) const;
  bool losses() const;
  bool follow_losses();
  bool open_at_rest() const;
  void evaluate(const Input& input);
  double tolerance(double size) const;
  bool newton(const Input& input);
  bool search(const Input& input, const std::vector<double>& direction);
  double slope_along(const Input& input, const std::vector<double>& direction);
  void note_ambiguity();

  std::vector<Node> nodes_;
  std::vector<ReferenceBundle> bundles_;
  std::vector<Gear> gears_;
  double before_ = 0;                   ///< Size of the last step, 0: none.
  std::vector<int> unknown_;            ///< For each node its unknown; -1: prescribed.
  std::vector<NodeId> node_of_;         ///< For each unknown its node.
  std::vector<double> x_;               ///< Displacement of each node in this step.
  std::vector<ReferenceBundle::Point> points_;
  std::vector<double> preload_, K_;     ///< For each steep bundle (see minimise).
  std::vector<double> gradient_, size_; ///< For each unknown: the imbalance, and the sum of magnitudes of the forces.
  std::vector<double> matrix_;
  std::vector<double> nodal_;
  double blur_ = 0;                     ///< See blur().
  double unbalance_ = 0;                ///< Largest imbalance relative to round-off.
  double largest_force_ = 0, largest_step_ = 0;  ///< At the present point.
  double typical_step_ = 0;             ///< At any balance found in this step.
  double total_mass_ = 0;               ///< [kg]
  double impulse_ = 0;                  ///< Sum over all steps so far of the largest force times the step [N s].
  double still_ = 0;                    ///< Bundles with smaller displacements in this step are at rest.
  double rounding_ = 1e-300;            ///< Round-off of forces that are computed as a fraction of a Coulomb force [N].
  bool ambiguous_ = false, forked_ = false;
};

}  // namespace rheonet::test
