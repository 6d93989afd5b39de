#include <doctest/doctest.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::crowded_friction_test {

namespace {

struct Crowd { const char* what; const char* toml; };

const Crowd crowds[] = {
    {"two frictions that stand together, one of which has relaxed to almost nothing", R"([elements]
e1 = { type = "cfm", between = ["n0", "ground"], stiffness = 409, coulomb = 1.35, damping = 0.613, exponent = 0.5 }
e2 = { type = "cfm", between = ["n0", "ground"], stiffness = 237, coulomb = 0.838, damping = 9.34, exponent = 2 }
e3 = { type = "dashpot", between = ["n1", "ground"], damping = 1.45, flow_index = 0.7 }
e4 = { type = "sfm", between = ["n1", "ground"], stiffness = 447, coulomb = 0.19, exponent = 0 }
e5 = { type = "spring", between = ["n2", "n1"], stiffness = 148 }
e6 = { type = "vfm", between = ["n2", "n1"], damping = 0.465, stiffness = 220 }
e7 = { type = "sfm", between = ["n3", "n2"], stiffness = 611, coulomb = 0.122, exponent = 2 }
e8 = { type = "dashpot", between = ["n3", "n2"], damping = 19.1 }
e9 = { type = "cfm", between = ["n0", "n2"], stiffness = 17.6, coulomb = 1.23, damping = 9.13, exponent = 3 }
e10 = { type = "vfm", between = ["n1", "n3"], damping = 5.25, stiffness = 92.1 }
e11 = { type = "vfm", between = ["n0", "n2"], damping = 20, stiffness = 79.1 }
f = { type = "motion", at = "n3", position = { sine = 0.462, frequency = 0.494 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "e9.force", "e10.force", "e11.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"a slider and friction that stick at their bounds while another slider slips", R"([elements]
e1 = { type = "vfm", between = ["n0", "ground"], damping = 17.1, stiffness = 172 }
e2 = { type = "slider", between = ["n0", "ground"], coulomb = 0.122 }
e3 = { type = "slider", between = ["n1", "n0"], coulomb = 0.188 }
e4 = { type = "cfm", between = ["n1", "n0"], stiffness = 165, coulomb = 0.111, damping = 2.89, exponent = 1 }
e5 = { type = "spring", between = ["n1", "ground"], stiffness = 3.79 }
m6 = { type = "mass", at = "n1", mass = 4.53 }
f = { type = "force", at = "n1", force = { sine = 1.3, frequency = 0.477, phase = 5.68667 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "n0.velocity", "n1.velocity"]
)"},
    {"two frictions that lean on a slider at its bound", R"([elements]
e1 = { type = "slider", between = ["n0", "ground"], coulomb = 0.439 }
e2 = { type = "cfm", between = ["n0", "ground"], stiffness = 38, coulomb = 1.59, damping = 7.99, exponent = 3 }
e3 = { type = "dashpot", between = ["n1", "n0"], damping = 0.755 }
e4 = { type = "slider", between = ["n1", "n0"], coulomb = 0.25 }
e5 = { type = "cfm", between = ["ground", "n0"], stiffness = 79.9, coulomb = 0.258, damping = 1.91, exponent = 0.5 }
e6 = { type = "sfm", between = ["ground", "n1"], stiffness = 779, coulomb = 0.119, exponent = 1 }
e7 = { type = "vfm", between = ["n1", "n0"], damping = 5.3, stiffness = 960 }
m8 = { type = "mass", at = "n1", mass = 0.694 }
f = { type = "force", at = "n0", force = { ramp = -1.73, offset = 1.73 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "n0.velocity", "n1.velocity"]
)"},
    {"friction that relaxes beside elastoplastic friction, on the edge of sliding", R"([elements]
e1 = { type = "cfm", between = ["n0", "ground"], stiffness = 756, coulomb = 1.66, damping = 1.17, exponent = 0.5 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 351, coulomb = 0.919, damping = 3.09, exponent = 2 }
e3 = { type = "sfm", between = ["n1", "n0"], stiffness = 147, coulomb = 0.564, exponent = 0 }
e4 = { type = "sfm", between = ["n2", "n1"], stiffness = 14.2, coulomb = 0.353, exponent = 1 }
e5 = { type = "sfm", between = ["n3", "n2"], stiffness = 256, coulomb = 1.75, exponent = 1 }
e6 = { type = "spring", between = ["n1", "n0"], stiffness = 106 }
e7 = { type = "vfm", between = ["n1", "n3"], damping = 10.8, stiffness = 487 }
m8 = { type = "mass", at = "n3", mass = 0.11 }
f = { type = "motion", at = "n0", velocity = { triangle = 0.716, frequency = 0.949 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"a small force of friction that follows from the balance of large ones", R"([elements]
e1 = { type = "vfm", between = ["n0", "ground"], damping = 1.7, stiffness = 234 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 986, coulomb = 2.39, damping = 0.43, exponent = 2 }
e3 = { type = "sfm", between = ["n1", "n0"], stiffness = 349, coulomb = 3, exponent = 0.5 }
e4 = { type = "sfm", between = ["n2", "n1"], stiffness = 14.3, coulomb = 0.147, exponent = 1 }
e5 = { type = "cfm", between = ["n2", "n1"], stiffness = 231, coulomb = 0.772, damping = 9.24, exponent = 0 }
e6 = { type = "spring", between = ["n3", "n2"], stiffness = 24.8 }
e7 = { type = "sfm", between = ["n3", "n2"], stiffness = 876, coulomb = 0.496, exponent = 1 }
e8 = { type = "dashpot", between = ["n0", "ground"], damping = 12.7 }
m9 = { type = "mass", at = "n2", mass = 0.673 }
m10 = { type = "mass", at = "n3", mass = 2.61 }
f = { type = "force", at = "n1", force = { sine = 1.42, frequency = 0.565 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"friction that stands beside friction that has slid far", R"([elements]
e1 = { type = "dashpot", between = ["n0", "ground"], damping = 1.94, flow_index = 0.7 }
e2 = { type = "slider", between = ["n1", "ground"], coulomb = 0.215, breakaway = 0.3225 }
e3 = { type = "cfm", between = ["n2", "n1"], stiffness = 28.5, coulomb = 0.487, damping = 0.364, exponent = 3 }
e4 = { type = "cfm", between = ["n2", "n1"], stiffness = 958, coulomb = 1.16, damping = 3.45, exponent = 0.5 }
e5 = { type = "sfm", between = ["n3", "n2"], stiffness = 86.5, coulomb = 1.65, exponent = 0.5 }
e6 = { type = "slider", between = ["n0", "n2"], coulomb = 0.268, breakaway = 0.3216 }
m7 = { type = "mass", at = "n1", mass = 0.761 }
m8 = { type = "mass", at = "n3", mass = 3.49 }
f = { type = "motion", at = "n3", position = { sine = 0.952, frequency = 0.535 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"a slider held by another one, whose force rises from its bound by the second order of time", R"([elements]
e1 = { type = "sfm", between = ["n0", "ground"], stiffness = 25, coulomb = 0.595, exponent = 1 }
e2 = { type = "slider", between = ["n0", "ground"], coulomb = 0.105, breakaway = 0.1575 }
e3 = { type = "slider", between = ["n1", "n0"], coulomb = 0.183 }
e4 = { type = "sfm", between = ["n2", "n1"], stiffness = 266, coulomb = 0.727, exponent = 1 }
e5 = { type = "spring", between = ["n2", "n1"], stiffness = 110 }
e6 = { type = "spring", between = ["n3", "n2"], stiffness = 5.37 }
e7 = { type = "sfm", between = ["n3", "n2"], stiffness = 79.8, coulomb = 0.202, exponent = 3 }
e8 = { type = "sfm", between = ["n3", "ground"], stiffness = 209, coulomb = 2.62, exponent = 1 }
m9 = { type = "mass", at = "n2", mass = 0.745 }
f = { type = "force", at = "n1", force = { sine = 2.9, frequency = 2.47 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"friction in series between masses, each on the edge of sliding", R"([elements]
e1 = { type = "sfm", between = ["n0", "ground"], stiffness = 52.5, coulomb = 1.21, exponent = 1 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 13.6, coulomb = 0.566, damping = 1.79, exponent = 1 }
e3 = { type = "sfm", between = ["n2", "n1"], stiffness = 272, coulomb = 2.23, exponent = 0 }
e4 = { type = "sfm", between = ["n3", "n2"], stiffness = 13.3, coulomb = 0.221, exponent = 2 }
e5 = { type = "spring", between = ["n3", "n2"], stiffness = 38.2 }
m6 = { type = "mass", at = "n2", mass = 0.487 }
m7 = { type = "mass", at = "n3", mass = 4.26 }
f = { type = "motion", at = "n3", position = { sine = 0.756, frequency = 0.5 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"friction that has relaxed to almost nothing after a long way, and is set in motion by a slider", R"([elements]
e2 = { type = "vfm", between = ["n1", "ground"], damping = 3.74, stiffness = 287 }
e3 = { type = "cfm", between = ["n2", "n1"], stiffness = 136, coulomb = 0.103, damping = 7.9, exponent = 0 }
e4 = { type = "cfm", between = ["n3", "n2"], stiffness = 419, coulomb = 1.81, damping = 1.17, exponent = 3 }
e5 = { type = "sfm", between = ["n3", "n2"], stiffness = 109, coulomb = 2.5, exponent = 1 }
e6 = { type = "slider", between = ["n1", "n3"], coulomb = 2.07 }
f = { type = "motion", at = "n3", velocity = { ramp = -0.628, offset = 0.628 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"a small viscous force between masses and friction, all of it on the move", R"([elements]
e1 = { type = "sfm", between = ["n0", "ground"], stiffness = 52, coulomb = 1.92, exponent = 3 }
e2 = { type = "sfm", between = ["n0", "ground"], stiffness = 313, coulomb = 0.312, exponent = 1 }
e3 = { type = "sfm", between = ["n1", "n0"], stiffness = 89.2, coulomb = 0.197, exponent = 0 }
e4 = { type = "sfm", between = ["n1", "n0"], stiffness = 31.2, coulomb = 0.934, exponent = 0 }
e5 = { type = "vfm", between = ["n2", "n1"], damping = 0.332, stiffness = 595 }
e6 = { type = "cfm", between = ["n3", "n2"], stiffness = 223, coulomb = 0.595, damping = 5.74, exponent = 1 }
e7 = { type = "slider", between = ["n3", "n2"], coulomb = 0.748 }
e8 = { type = "sfm", between = ["n2", "n1"], stiffness = 28.4, coulomb = 1.67, exponent = 0 }
e9 = { type = "vfm", between = ["n3", "n2"], damping = 0.602, stiffness = 562 }
e10 = { type = "vfm", between = ["n1", "ground"], damping = 15.1, stiffness = 67.8 }
m11 = { type = "mass", at = "n2", mass = 0.119 }
m12 = { type = "mass", at = "n3", mass = 4.22 }
f = { type = "force", at = "n1", force = { ramp = 0.777 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "e9.force", "e10.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"a slider beside friction of exponent 0 that yields while it slips", R"([elements]
e1 = { type = "sfm", between = ["n0", "ground"], stiffness = 42, coulomb = 0.238, exponent = 3 }
e2 = { type = "slider", between = ["n0", "ground"], coulomb = 0.16, breakaway = 0.192 }
e3 = { type = "sfm", between = ["n1", "n0"], stiffness = 60.2, coulomb = 0.141, exponent = 0 }
e4 = { type = "sfm", between = ["n2", "n1"], stiffness = 61.7, coulomb = 2.39, exponent = 0.5 }
e5 = { type = "sfm", between = ["n2", "n1"], stiffness = 392, coulomb = 0.954, exponent = 1 }
e6 = { type = "sfm", between = ["n0", "n1"], stiffness = 39.4, coulomb = 0.222, exponent = 0 }
f = { type = "motion", at = "n1", velocity = { sine = 0.125, frequency = 2.24 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "n0.velocity", "n1.velocity", "n2.velocity"]
)"},
    {"a slider that slips as slowly as the one beside it stops", R"([elements]
e1 = { type = "slider", between = ["n0", "ground"], coulomb = 1.3 }
e2 = { type = "sfm", between = ["n1", "n0"], stiffness = 279, coulomb = 1.66, exponent = 0 }
e3 = { type = "slider", between = ["n1", "n0"], coulomb = 0.184, breakaway = 0.2208 }
e4 = { type = "vfm", between = ["n2", "n1"], damping = 7.6, stiffness = 31.9 }
e5 = { type = "sfm", between = ["n2", "n1"], stiffness = 436, coulomb = 1.93, exponent = 0 }
m6 = { type = "mass", at = "n1", mass = 0.189 }
m7 = { type = "mass", at = "n2", mass = 1.54 }
f = { type = "force", at = "n1", force = { sine = 1.16, frequency = 1.82, phase = 3.85556 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "n0.velocity", "n1.velocity", "n2.velocity"]
)"},
    {"friction that stands to within a thousandth of its way of starting", R"([elements]
e1 = { type = "slider", between = ["n0", "ground"], coulomb = 1.44, breakaway = 2.16 }
e2 = { type = "cfm", between = ["n0", "ground"], stiffness = 139, coulomb = 0.285, damping = 1.09, exponent = 1 }
e3 = { type = "cfm", between = ["n1", "n0"], stiffness = 61.1, coulomb = 0.108, damping = 0.751, exponent = 0.5 }
e4 = { type = "cfm", between = ["n2", "n1"], stiffness = 774, coulomb = 0.335, damping = 4.74, exponent = 3 }
e5 = { type = "dashpot", between = ["n2", "n1"], damping = 1.75 }
e6 = { type = "slider", between = ["ground", "n0"], coulomb = 1.04 }
e7 = { type = "slider", between = ["ground", "n2"], coulomb = 2.56 }
e8 = { type = "cfm", between = ["n1", "n2"], stiffness = 36.1, coulomb = 1.22, damping = 6.83, exponent = 1 }
m9 = { type = "mass", at = "n0", mass = 4.67 }
m10 = { type = "mass", at = "n2", mass = 0.257 }
f = { type = "force", at = "n1", force = { ramp = -1.67, offset = 1.67 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "n0.velocity", "n1.velocity", "n2.velocity"]
)"},
    {"friction far beyond its bound beside friction that yields", R"([elements]
e1 = { type = "sfm", between = ["n0", "ground"], stiffness = 712, coulomb = 0.528, exponent = 2 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 242, coulomb = 1.12, damping = 2.36, exponent = 0 }
e3 = { type = "dashpot", between = ["n2", "n1"], damping = 31 }
e4 = { type = "cfm", between = ["n3", "n2"], stiffness = 22, coulomb = 1.26, damping = 6.05, exponent = 0 }
e5 = { type = "spring", between = ["ground", "n0"], stiffness = 189 }
e6 = { type = "cfm", between = ["n0", "n2"], stiffness = 11, coulomb = 0.162, damping = 1.82, exponent = 2 }
e7 = { type = "cfm", between = ["n3", "n2"], stiffness = 392, coulomb = 0.226, damping = 0.695, exponent = 1 }
f = { type = "motion", at = "n3", position = { sine = 0.332, frequency = 2.66 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"friction that stops beside a pseudoplastic dashpot, and is to turn at once", R"([elements]
e1 = { type = "slider", between = ["n0", "ground"], coulomb = 0.46 }
e2 = { type = "cfm", between = ["n0", "ground"], stiffness = 11.4, coulomb = 1.83, damping = 2.15, exponent = 1 }
e3 = { type = "slider", between = ["n1", "n0"], coulomb = 1.07 }
e4 = { type = "sfm", between = ["n1", "n0"], stiffness = 243, coulomb = 2.16, exponent = 2 }
e5 = { type = "cfm", between = ["n2", "n1"], stiffness = 21.7, coulomb = 0.301, damping = 1.91, exponent = 1 }
e6 = { type = "dashpot", between = ["n2", "n1"], damping = 7.91, flow_index = 0.5 }
e7 = { type = "slider", between = ["n3", "n2"], coulomb = 2.28, breakaway = 2.736 }
e8 = { type = "vfm", between = ["ground", "n2"], damping = 2.12, stiffness = 35.1 }
e9 = { type = "slider", between = ["n2", "n3"], coulomb = 0.389 }
m10 = { type = "mass", at = "n0", mass = 0.423 }
m11 = { type = "mass", at = "n2", mass = 0.394 }
m12 = { type = "mass", at = "n3", mass = 2.39 }
f = { type = "motion", at = "n0", position = { sine = 0.109, frequency = 0.611 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "e9.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"friction that goes on so long at its bound that its slope is lost, among others", R"([elements]
e1 = { type = "slider", between = ["n0", "ground"], coulomb = 0.346 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 390, coulomb = 0.419, damping = 1.43, exponent = 1 }
e3 = { type = "cfm", between = ["n2", "n1"], stiffness = 25.7, coulomb = 2.25, damping = 1.52, exponent = 1 }
e4 = { type = "cfm", between = ["n2", "n1"], stiffness = 943, coulomb = 0.101, damping = 0.378, exponent = 0 }
e5 = { type = "cfm", between = ["n3", "n2"], stiffness = 44.7, coulomb = 2.5, damping = 3.3, exponent = 1 }
e6 = { type = "dashpot", between = ["n1", "n3"], damping = 0.496, flow_index = 0.7 }
e7 = { type = "vfm", between = ["n0", "n3"], damping = 0.425, stiffness = 35.9 }
e8 = { type = "spring", between = ["n2", "n0"], stiffness = 98.7 }
m9 = { type = "mass", at = "n2", mass = 1.8 }
m10 = { type = "mass", at = "n3", mass = 0.132 }
f = { type = "motion", at = "n0", velocity = { sine = 0.934, frequency = 1.81 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "e8.force", "n0.velocity", "n1.velocity", "n2.velocity", "n3.velocity"]
)"},
    {"a slider beside friction that saturates, and springs that hold the same node", R"([elements]
e1 = { type = "spring", between = ["n0", "ground"], stiffness = 32.4 }
e2 = { type = "vfm", between = ["n1", "n0"], damping = 0.504, stiffness = 80.6 }
e3 = { type = "slider", between = ["n1", "n0"], coulomb = 2 }
e4 = { type = "cfm", between = ["n2", "n1"], stiffness = 109, coulomb = 0.236, damping = 0.586, exponent = 1 }
e5 = { type = "vfm", between = ["n2", "n1"], damping = 0.397, stiffness = 83 }
e6 = { type = "vfm", between = ["n0", "n2"], damping = 4.71, stiffness = 258 }
e7 = { type = "dashpot", between = ["n2", "ground"], damping = 2.17 }
m8 = { type = "mass", at = "n2", mass = 2.85 }
f = { type = "force", at = "n1", force = { sine = 5.91, frequency = 2.27, phase = 3.35012 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "n0.velocity", "n1.velocity", "n2.velocity"]
)"},
    {"a slider that breaks away between springs, a little late", R"([elements]
e1 = { type = "spring", between = ["n0", "ground"], stiffness = 9.97 }
e2 = { type = "dashpot", between = ["n1", "n0"], damping = 0.733, flow_index = 0.7 }
e3 = { type = "spring", between = ["n1", "n0"], stiffness = 6.06 }
e4 = { type = "sfm", between = ["n2", "n1"], stiffness = 392, coulomb = 0.401, exponent = 0 }
e5 = { type = "vfm", between = ["n2", "n1"], damping = 5.43, stiffness = 195 }
e6 = { type = "slider", between = ["n0", "n2"], coulomb = 0.938, breakaway = 1.407 }
e7 = { type = "sfm", between = ["n2", "ground"], stiffness = 19.7, coulomb = 0.498, exponent = 1 }
f = { type = "force", at = "n1", force = { ramp = -3.47, offset = 3.47 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["e1.force", "e2.force", "e3.force", "e4.force", "e5.force", "e6.force", "e7.force", "n0.velocity", "n1.velocity", "n2.velocity"]
)"},
};

}  // namespace

// Networks drawn at random in which several frictions and sliders are at their bounds at once. Each switched over and over, or
// went on in ever shorter steps: an instant and the equations after it saw the edge between standing and sliding differently, or
// what rounding and the errors of steps leave was taken for motion.
TEST_CASE("where many frictions meet at their bounds runs end, each record within twice the accuracy asked") {
  for (const Crowd& crowd : crowds) {
    CAPTURE(crowd.what);
    const RunTable best = simulate(crowd.toml, 1e-9);
    for (const double accuracy : {1e-3, 1e-6}) {
      CAPTURE(accuracy);
      CHECK(largest_error(simulate(crowd.toml, accuracy), best) <= 2 * accuracy);
    }
  }
}

}  // namespace rheonet::test::crowded_friction_test
