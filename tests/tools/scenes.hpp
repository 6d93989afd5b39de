#pragma once

namespace rheonet::test {

/// A mass on a spring, let go at 1 mm: x = 1 mm cos(10 t).
inline const char* const oscillator = R"(title = "let go"
[elements]
block_mass = { type = "mass", at = "block", mass = "1 kg" }
k1 = { type = "spring", between = ["block", "ground"], stiffness = "100 N/m" }
[nodes]
block = { position = "1 mm" }
[simulate]
stop = "1 s"
output = { points = 11 }
record = ["block.position", "k1.force"]
)";

/// The same for so long that a test can interrupt it: some 10^7 oscillations.
inline const char* const endless = R"([elements]
block_mass = { type = "mass", at = "block", mass = "1 kg" }
k1 = { type = "spring", between = ["block", "ground"], stiffness = "100 N/m" }
[nodes]
block = { position = "1 mm" }
[simulate]
stop = 9e6
output = { every = "0.1 s" }
record = ["block.position"]
)";

/// Two prescriptions for one node: it can be read, not simulated.
inline const char* const contradictory = R"([elements]
left = { type = "motion", at = "bar", velocity = "1 m/s" }
right = { type = "motion", at = "bar", velocity = "2 m/s" }
k1 = { type = "spring", between = ["bar", "ground"], stiffness = "100 N/m" }
[simulate]
stop = "1 s"
output = { points = 11 }
)";

/// A misspelt type and a wrong dimension.
inline const char* const mistaken = R"([elements]
k1 = { type = "sprong", between = ["a", "ground"], stiffness = "100 N/m" }
c1 = { type = "dashpot", between = ["a", "ground"], damping = "2 mm" }
[simulate]
stop = "1 s"
output = { points = 11 }
)";

}  // namespace rheonet::test
