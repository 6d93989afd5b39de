// The first scene of the playground.
export const firstScene = `title = "A spring and a mass"

[elements]
k1 = { type = "spring", between = ["block", "ground"], stiffness = "100 N/m" }
m1 = { type = "mass",   at = "block", mass = "1 kg" }

[nodes]
block = { position = "1 cm" }

[simulate]
stop = "2 s"
`;

// The text of a new scene.
export const emptyScene = `title = "New scene"

[elements]

[simulate]
stop = "10 s"
output = { points = 1001 }
`;
