#pragma once

namespace rheonet::test {

/// The scene with which the description of the format begins.
inline constexpr const char* contract_scene = R"~(
title  = "Bingham element: spring in series with (dashpot parallel to slider)"
domain = "rotation"

[parameters]
B  = "0.5 N*m*s/rad"
Tc = "2 N*m"

[elements]
drive   = { type = "motion", at = "drum", velocity = { step = "10 rad/s", time = "0 s" } }
k1      = { type = "spring",  between = ["drum", "mid"],    stiffness = "100 N*m/rad" }
c1      = { type = "dashpot", between = ["mid", "ground"],  damping = "B" }
s1      = { type = "slider",  between = ["mid", "ground"],  coulomb = "Tc" }

[simulate]
stop     = "0.2 s"
accuracy = 1e-6
output   = { every = "1 ms" }
record   = ["k1.force", "mid.velocity"]
)~";

}  // namespace rheonet::test
