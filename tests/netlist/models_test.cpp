#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"
#include "tests/netlist/summary.hpp"

namespace rheonet::test::models_test {

TEST_CASE("the model of the contract") {
  const Scene scene = sound_scene(R"~(
[models.bingham]
ports      = ["a", "b"]
parameters = { k = "100 N/m", B = "0.5 N*s/m", Fc = "2 N" }
[models.bingham.elements]
k1 = { type = "spring",  between = ["a", "mid"], stiffness = "k" }
c1 = { type = "dashpot", between = ["mid", "b"], damping = "B" }
s1 = { type = "slider",  between = ["mid", "b"], coulomb = "Fc" }

[elements]
pivot = { type = "bingham", between = ["drum", "ground"], Fc = "3 N" }
other = { type = "bingham", between = ["ground", "drum"], k = 7 }

[nodes]
"pivot.mid" = { velocity = "1 mm/s" }
drum = { position = 1 }

[simulate]
stop = 1
record = ["pivot.k1.force", "pivot.mid.velocity", "pivot.force", "pivot.velocity"]
)~");
  CHECK(nodes_of(scene) == "drum pivot.mid other.mid");
  CHECK(scene.nodes[2].velocity == 0.001);
  CHECK(scene.nodes[1].position == 1);
  CHECK(elements_of(scene) ==
        "pivot.k1: spring drum-pivot.mid 100 0\npivot.c1: dashpot pivot.mid-ground 0.5 1\n"
        "pivot.s1: slider pivot.mid-ground 3 3 0\n"
        "other.k1: spring ground-other.mid 7 0\nother.c1: dashpot other.mid-drum 0.5 1\n"
        "other.s1: slider other.mid-drum 2 2 0\n");
  CHECK(assemblies_of(scene) == "pivot: drum-ground = +pivot.k1\nother: ground-drum = +other.k1\n");
  CHECK(scene.records[2].subject == Record::Subject::assembly);
}

TEST_CASE("a model's force: everything at its first port, with its sign, and nothing else that is at the same node") {
  const Scene scene = sound_scene(R"~(
[models.mixed]
ports = ["a", "b"]
[models.mixed.elements]
k1 = { type = "spring", between = ["a", "b"], stiffness = 1 }
k2 = { type = "spring", between = ["mid", "a"], stiffness = 2 }
k3 = { type = "spring", between = ["mid", "ground"], stiffness = 3 }
m1 = { type = "mass", at = "a", mass = 4 }
f1 = { type = "force", at = "a", force = 5 }
f2 = { type = "force", between = ["mid", "a"], force = 6 }
g = { between = ["b", "a"], parallel = [ { type = "spring", stiffness = 7 } ] }
[elements]
x = { type = "mixed", between = ["ground", "b"] }
y = { type = "spring", between = ["b", "ground"], stiffness = 8 }
)~");
  // k3 is at ground, as the first port is here, but not at the port.
  CHECK(assemblies_of(scene) ==
        "x: ground-b = +x.k1 -x.k2 +x.m1 -x.f1 +x.f2 -x.g.spring1\nx.g: b-ground = +x.g.spring1\n");
  CHECK(scene.elements[1].b == ground);
}

TEST_CASE("scopes: a model sees its parameters and those of its file, and no node of the scene but ground") {
  const Scene scene = sound_scene(R"~(
[parameters]
k = "2*half"
half = "50 N/m"
c = 9
[models.m]
ports = ["p"]
parameters = { k = "3 N/m", twice = "2*k" }
[models.m.elements]
k = { type = "spring", between = ["p", "drum"], stiffness = "k" }
t = { type = "spring", between = ["drum", "ground"], stiffness = "twice" }
c = { type = "dashpot", between = ["drum", "ground"], damping = "c" }
[models.outer]
ports = ["p"]
parameters = ["k"]
elements = { inner = { type = "m", at = "p", k = "1.1*k" } }
[elements]
k = { type = "spring", between = ["drum", "ground"], stiffness = "k" }
a = { type = "m", at = "drum" }
b = { type = "outer", at = "drum", k = "k/10" }
)~");
  CHECK(elements_of(scene) ==
        "k: spring drum-ground 100 0\n"
        "a.k: spring drum-a.drum 3 0\na.t: spring a.drum-ground 6 0\na.c: dashpot a.drum-ground 9 1\n"
        "b.inner.k: spring drum-b.inner.drum 11 0\nb.inner.t: spring b.inner.drum-ground 22 0\n"
        "b.inner.c: dashpot b.inner.drum-ground 9 1\n");
  CHECK(scene.assemblies.empty());  // one port: no displacement of its own
}

TEST_CASE("models in series, with three ports, and named as a group's members") {
  const Scene scene = sound_scene(R"~(
[models.two]
ports = ["a", "b"]
elements = { k = { type = "spring", between = ["a", "b"], stiffness = 1 } }
[models.three]
ports = ["a", "b", "c"]
[models.three.elements]
k = { type = "spring", between = ["a", "b"], stiffness = 1 }
l = { type = "spring", between = ["b", "c"], stiffness = 2 }
[elements]
t = { type = "three", between = ["x", "y", "ground"] }
g = { between = ["x", "y"], series = [ { type = "two" }, { type = "two" }, { name = "end", type = "two" } ] }
)~");
  CHECK(elements_of(scene) ==
        "t.k: spring x-y 1 0\nt.l: spring y-ground 2 0\n"
        "g.two1.k: spring x-g.node1 1 0\ng.two2.k: spring g.node1-g.node2 1 0\ng.end.k: spring g.node2-y 1 0\n");
  CHECK(assemblies_of(scene) ==
        "g: x-y = +g.two1.k\ng.two1: x-g.node1 = +g.two1.k\ng.two2: g.node1-g.node2 = +g.two2.k\ng.end: g.node2-y = "
        "+g.end.k\n");
}

TEST_CASE("a million million elements are refused before they are made") {
  std::string netlist =
      "[models.m0]\nports = [\"a\", \"b\"]\nelements = { k = { type = \"spring\", between = [\"a\", \"b\"], stiffness "
      "= 1 } }\n";
  for (int i = 1; i <= 40; ++i) {
    const std::string inner = "m" + std::to_string(i - 1);
    netlist += "[models.m" + std::to_string(i) + "]\nports = [\"a\", \"b\"]\nelements = { k = { type = \"" + inner +
               "\", between = [\"a\", \"c\"] }, l = { type = \"" + inner + "\", between = [\"c\", \"b\"] } }\n";
  }
  const ReadResult result = read(netlist + "[elements]\nall = { type = \"m40\", between = [\"a\", \"b\"] }\n");
  CHECK_FALSE(result.scene);
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].message == "the scene has more than 5000000 elements");
}

TEST_CASE("included models") {
  const Folder folder;
  folder.write("library/library/cells.toml", R"~(
title = "Cells"
include = ["parts.toml"]
[parameters]
k = "7 N/m"
[models.cell]
ports = ["a", "b"]
elements = { k = { type = "spring", between = ["a", "b"], stiffness = "k" }, p = { type = "part", at = "b" } }
)~");
  folder.write("library/library/parts.toml", R"~(
[models.part]
ports = ["a"]
parameters = { m = "3 kg" }
elements = { m = { type = "mass", at = "a", mass = "m" } }
)~");
  folder.write("scenes/own/more.toml", "include = [\"again.toml\"]\n");
  folder.write("scenes/own/again.toml", "");
  ReadOptions options;
  options.model_folders = {folder.path() / "library"};
  options.overrides = {"models.part.parameters.m=4"};
  // The same file twice is no circle, and the scene's parameters are not those of the library.
  const Scene scene = sound_scene(R"~(
include = ["library/cells.toml", "own/more.toml", "own/again.toml", "library/parts.toml"]
[parameters]
k = "1 N/m"
[elements]
c = { type = "cell", between = ["x", "y"] }
k = { type = "spring", between = ["x", "y"], stiffness = "k" }
)~",
                               options, folder.path() / "scenes");
  CHECK(elements_of(scene) == "c.k: spring x-y 7 0\nc.p.m: mass y 4\nk: spring x-y 1 0\n");

  // The library is looked into last, and only at the path as given.
  folder.write("scenes/library/parts.toml",
               "[models.part]\nports = [\"a\"]\nelements = { m = { type = \"mass\", at = \"a\", mass = 5 } }\n");
  options.overrides = {};
  const Scene own = sound_scene("include = [\"library/parts.toml\"]\n[elements]\np = { type = \"part\", at = \"x\" }\n",
                             options, folder.path() / "scenes");
  CHECK(elements_of(own) == "p.m: mass x 5\n");
  CHECK_FALSE(read("include = [\"cells.toml\"]\n[elements]\np = { type = \"cell\", between = [\"x\", \"y\"] }\n",
                   options, folder.path() / "scenes")
                  .scene);
}

TEST_CASE("a model that is written with the names of translation serves a rotational scene too") {
  const std::string models = R"~(
[models.part]
ports = ["a"]
parameters = ["m", "F"]
elements = { m = { type = "mass", at = "a", mass = "m" }, f = { type = "force", at = "a", force = "F" } }
[parameters]
J = "3 kg*m^2"
T = "5 N*m"
)~";
  const std::string instance = "[elements]\np = { type = \"part\", at = \"x\", m = \"J\", F = \"T\" }\n";
  ReadOptions options;
  CHECK(elements_of(sound_scene("domain = \"rotation\"\n" + models + instance, options)).starts_with("p.m: mass x 3\n"));
  options.overrides = {"p.m.mass=\"7 kg*m^2\""};
  CHECK(elements_of(sound_scene("domain = \"rotation\"\n" + models + instance, options)).starts_with("p.m: mass x 7\n"));
  options.overrides = {"p.m.inertia=\"7 kg*m^2\""};
  CHECK(elements_of(sound_scene("domain = \"rotation\"\n" + models + instance, options)).starts_with("p.m: mass x 7\n"));
  CHECK(messages(read(models + instance, options)).find("`inertia` is called `mass` in a translational scene") !=
        std::string::npos);
  options.overrides = {};
  CHECK_FALSE(read(models + instance, options).scene);  // kg*m^2 is no mass
}

TEST_CASE("a model with some parameters that have defaults, and some that have none") {
  const Scene scene = sound_scene(R"~(
[models.m]
ports = ["a", "b"]
parameters = ["k", { factor = 3, more = "factor*k" }, "B", { again = "2*more" }]
[models.m.elements]
k = { type = "spring", between = ["a", "b"], stiffness = "again" }
c = { type = "dashpot", between = ["a", "b"], damping = "B" }
[elements]
x = { type = "m", between = ["p", "ground"], k = "2 N/m", B = "5 N*s/m" }
y = { type = "m", between = ["p", "ground"], k = "2 N/m", B = "5 N*s/m", factor = 1, more = "7 N/m" }
)~");
  CHECK(elements_of(scene) == "x.k: spring p-ground 12 0\nx.c: dashpot p-ground 5 1\ny.k: spring p-ground 14 0\ny.c: dashpot p-ground 5 1\n");
}

}  // namespace rheonet::test::models_test
