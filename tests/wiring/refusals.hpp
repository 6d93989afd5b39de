#pragma once

#include <array>
#include <string>

namespace rheonet::test {

/// A reason for which a scene of the wiring test has no answer, or none beyond some time. This is the whole list: any other
/// refusal is a fault. README.md says more.
struct Refusal {
  const char* name;
  const char* reason;                ///< the physics of it
  std::array<const char*, 2> words;  ///< what the message says, either of these
};

/// A force upon a node without mass that friction alone holds.
inline constexpr Refusal overload{
    "a force beyond what friction can take",
    "Every way from the node to something with inertia or to a support leads through friction whose Coulomb forces add up "
    "to less than the force applied. Nothing there takes the rest: no element whose force grows with its velocity or its "
    "displacement, and no mass. The velocity would be infinite.",
    {"nothing resists the force", "every element there has come to a constant force"}};

/// Prescribed motions through a freewheel, with nothing in between that gives way.
inline constexpr Refusal blocked{
    "a motion that a freewheel forbids",
    "Prescribed motions turn the ends of a freewheel backwards against each other. No force ends that.",
    {"that the prescribed motions demand", "that the prescribed motions demand"}};

/// Gears in a loop.
inline constexpr Refusal jammed{
    "gears whose ratios contradict each other",
    "Gears alone make a loop, and no velocity but 0 fits all of their ratios.",
    {"their ratios contradict each other", "it could only repeat or contradict that"}};

bool says(const std::string& message, const Refusal& refusal);

/// The time that a message gives [s]; NaN if it gives none.
double time_in(const std::string& message);

}  // namespace rheonet::test
