#pragma once

#include <array>
#include <string>

namespace rheonet::test {

/// A physical reason for which a scene of the wiring test has no solution, or none beyond some time. This list is complete: any other
/// refusal is a fault. See README.md.
struct Refusal {
  const char* name;
  const char* reason;                ///< Physical reason.
  std::array<const char*, 2> words;  ///< The message contains one of these texts.
};

/// A force on a massless node that only friction holds.
inline constexpr Refusal overload{
    "a force beyond what friction can take",
    "Every way from the node to something with inertia or to a support leads through friction whose Coulomb forces add up "
    "to less than the force applied. Nothing there takes the rest: no element whose force grows with its velocity or its "
    "displacement, and no mass. The velocity would be infinite.",
    {"nothing resists the force", "every element there has come to a constant force"}};

/// Prescribed motions at a freewheel, without a compliant element in between.
inline constexpr Refusal blocked{
    "a motion that a freewheel forbids",
    "Prescribed motions turn the ends of a freewheel backwards against each other. No force ends that.",
    {"that the prescribed motions demand", "that the prescribed motions demand"}};

/// Gears in a loop.
inline constexpr Refusal jammed{
    "gears whose ratios contradict each other",
    "Gears alone make a loop, and no velocity but 0 fits all of their ratios.",
    {"their ratios contradict each other", "it could only repeat or contradict that"}};

/// Gears whose losses grow with their own forces.
inline constexpr Refusal seized{
    "losses of gears that no motion fits",
    "Where the losses of a gear grow faster with its force than the force that is left, it has two motions or none. From one to the other leads "
    "only an impact, which is no part of the laws.",
    {"no motion was found in which the losses", "no motion was found in which the losses"}};

bool says(const std::string& message, const Refusal& refusal);

/// The time in a message [s]; NaN if there is none.
double time_in(const std::string& message);

}  // namespace rheonet::test
