#pragma once

#include <string>

namespace rheonet::test {

/// A mass on a spring, let go at 1 mm.
inline const std::string block_on_spring = R"([elements]
block_mass = { type = "mass", at = "block", mass = "1 kg" }
k1 = { type = "spring", between = ["block", "ground"], stiffness = "100 N/m" }
[nodes]
block = { position = "1 mm" }
[simulate]
)";

/// It as a scene: x = 1 mm cos(10 t).
inline const std::string oscillator = "title = \"let go\"\n" + block_on_spring + R"(stop = "1 s"
output = { points = 11 }
record = ["block.position", "k1.force"]
)";

/// The same for so long that a test can interrupt it: some 10^7 oscillations.
inline const std::string endless = block_on_spring + R"(stop = 9e6
output = { every = "0.1 s" }
record = ["block.position"]
)";

/// A slider in series with a spring, pulled back and forth: it slips at 0.1 s and sticks at 0.25 s.
inline const std::string pulled_slider = R"([elements]
hand = { type = "motion", at = "grip", velocity = { square = "1 m/s", frequency = "2 Hz" } }
k1 = { type = "spring", between = ["grip", "mid"], stiffness = "10 N/m" }
s1 = { type = "slider", between = ["mid", "ground"], coulomb = "1 N" }
)";
inline const std::string short_run = R"([simulate]
stop = "0.4 s"
output = { points = 5 }
record = ["k1.force"]
)";

inline const std::string switching = pulled_slider + short_run;

/// The same, and at 0.3 s a force on a slider that can take half of it: the run ends there.
inline const std::string overcome = pulled_slider + R"(s2 = { type = "slider", between = ["end", "ground"], coulomb = "1 N" }
push = { type = "force", at = "end", force = { step = "2 N", time = "0.3 s" } }
)" + short_run;

/// Two blocks that a belt pulls back and forth: parts that share only its motion.
inline const std::string two_blocks = R"([elements]
belt = { type = "motion", at = "belt", velocity = { square = "0.3 m/s", frequency = "0.8 Hz" } }
k1 = { type = "spring", between = ["belt", "one"], stiffness = 40 }
m1 = { type = "mass", at = "one", mass = 1 }
s1 = { type = "slider", between = ["one", "ground"], coulomb = 2 }
k2 = { type = "spring", between = ["belt", "two"], stiffness = 60 }
m2 = { type = "mass", at = "two", mass = 0.5 }
s2 = { type = "slider", between = ["two", "ground"], coulomb = 1 }
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

/// A dashpot B in a drive of 2 m/s for 3 s: its force is 2 B, its heat 12 B.
inline const char* const dragged_dashpot = R"([parameters]
B = "3 N*s/m"
[elements]
drive = { type = "motion", at = "a", velocity = 2 }
c = { type = "dashpot", between = ["a", "ground"], damping = "B" }
[simulate]
stop = 3
output = { points = 4 }
record = ["c.force", "a.position"]
)";

}  // namespace rheonet::test
