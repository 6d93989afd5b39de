#pragma once

#include <optional>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Transmissions: gears, levers, racks, screws.
///
/// A transmission without losses multiplies velocities by a constant ratio and divides forces by it. Seen from one side, the
/// network on the other side is the same network in another unit of length. With x' = s x and f' = f/s, v_a = i v_b becomes
/// v'_a = v'_b if s_b = i s_a. So a scene with transmissions is computed in common units: each node has a scale s, the same
/// throughout each region that elements other than transmissions join, and a transmission is a rigid link between two regions.
/// Ground is at rest in any unit, and in no region.
///
/// Three kinds of transmissions are no change of units: those with a moving support (a planetary gear), those that close a loop
/// with other elements (a gear that shifts), and those with losses. Each becomes a train, an equation of its own (SceneElement::row):
/// row_a v_a + row_b v_b + row_s v_s = 0, with the forces row_a f, row_b f and row_s f at its nodes. Losses are friction between a
/// and s as well, whose bounds depend on f.
///
/// All laws are dimensionally homogeneous: an element in a region of scale s is the same element with other values, k/s^2 for
/// a stiffness k. Where s is negative, a motion to the right appears as one to the left. There the two nodes of an element change
/// places, and its scale is abs(s): laws that tell directions apart (a freewheel) stay what they are.

/// Factor from common units to the own unit of a node or an element with the scale `scale`.
double own_unit(Quantity quantity, double scale, double flow_index = 1);

/// The scene in common units; absent if it has no transmissions, or is in common units already. Its records have factors
/// (Record::factor), by which they give the same values as those of `scene`. Throws SimulationError for a loop of transmissions
/// whose ratios contradict each other.
std::optional<Scene> in_common_units(const Scene& scene);

}  // namespace rheonet
