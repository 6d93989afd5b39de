#pragma once

#include "core/netlist/declaration.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// The same experiment seen differently. Each function takes a scene to the one that an identity of mechanics compares
/// with it; what the declarations say of each parameter is all that it needs.

/// New units: one old unit of length, time, force is so many new ones. In a rotational scene angles stay as they are,
/// and `force` counts for torques.
struct Scaling {
  double length = 1, time = 1, force = 1;
  double of(Quantity quantity, Domain domain, double flow_index = 1) const;
};
/// The factor by which a record of the scene is multiplied.
double factor(const Scene& scene, const Record& record, const Scaling& scaling);
Scene rescaled(Scene scene, const Scaling& scaling);

/// All drives and initial values negated, and elements that turn one way only turned round.
Scene negated(Scene scene);

/// Everything moved by dx: initial positions and position signals. No element may end at ground.
Scene shifted(Scene scene, double dx);

/// Seen from a frame that moves with velocity -v: v is added to all initial velocities and velocity signals. No element
/// may end at ground, and no motion be given by its position.
Scene boosted(Scene scene, double v);

/// [a, b] of one element becomes [b, a].
Scene exchanged(Scene scene, int element);

/// Each motion and force `at` a node acts on a shaft of its own instead, and drives the node through a gear of this ratio. The shafts
/// come first among the nodes, so that the unit of one of them is the common one and all else is converted. A motion whose position
/// a block gives stays where it is.
Scene behind_gears(const Scene& scene, double ratio);
/// A motion or force `at` a node.
bool drives(const SceneElement& element);

/// value signal(t / time) + add.
Signal transformed(const Signal& signal, double value, double time = 1, double add = 0);

/// Whether a parameter changes its sign with the direction that counts as positive: a position, velocity or force that
/// may have either sign, a signal.
bool oriented(const Parameter& parameter);

/// Whether an element takes other forces one way than the other, as a freewheel does: turned round it is another one.
bool one_way(const SceneElement& element);

/// The flow index that goes with a parameter: the value of another one, or 1.
double flow_index(const Declaration& declaration, const Parameter& parameter, const std::vector<double>& values);

}  // namespace rheonet::test
