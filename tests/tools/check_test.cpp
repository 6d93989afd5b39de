#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::check_test {

TEST_CASE("check says that a scene is right, and simulates nothing") {
  const Folder folder(endless);
  const Finished result = folder.shell("timeout 20 rheonet check scene.toml", 0);
  CHECK(contains(result.out, "scene.toml: no mistake found (2 elements, 1 node)"));
}

TEST_CASE("no control character of a file or a command line reaches the terminal") {
  const Folder folder;
  const std::string scene = std::string("title = \"a\\u001B[31m\\nb\"\n") + (std::string(oscillator).substr(17));
  folder.write("scene.toml", scene);
  folder.write("e\x1B.toml", scene);
  for (const std::string words :
       {"check -v scene.toml", "check e\x1B.toml", "run e\x1B.toml", "run scene.toml \x1B[31m",
        "run scene.toml -o no/\x1B", "run \x1B.toml", "run scene.toml --set 'k1.\x1B=\x1B'",
        "run scene.toml -o \x1B.csv", "run e\x1B.toml -o e\x1B.toml"}) {
    CAPTURE(words);
    const Finished result = folder.shell("rheonet " + words);
    CHECK_FALSE(contains(result.out, "\x1B"));
    CHECK_FALSE(contains(result.err, "\x1B"));
    CHECK(contains(result.out + result.err, words == "run scene.toml --set 'k1.\x1B=\x1B'" ? "\u241B" : "\\u001B"));
  }
}

TEST_CASE("check -v prints the network in SI") {
  const Folder folder;
  folder.write("scene.toml", R"(title = "drum"
domain = "rotation"
[elements]
drive = { type = "motion", at = "drum", velocity = { step = "60 rpm" } }
c1 = { type = "dashpot", between = ["drum", "ground"], damping = "2 N*cm*s/rad" }
rotor = { type = "inertia", at = "shaft", inertia = 2 }
worm = { type = "gear", between = ["shaft", "drum"], ratio = 7, efficiency = [0.6, -0.2], bearing = 3 }
[elements.pivot]
between = ["drum", "ground"]
series = [ { name = "k1", type = "spring", stiffness = 3 }, { type = "dashpot", damping = 4 } ]
[simulate]
stop = "200 ms"
output = { points = 5 }
)");
  const Finished result = folder.shell("rheonet check -v scene.toml", 0);
  for (const std::string part :
       {"drum (rotation)", "0 s to 0.2 s", "5 output times", "velocity = step of 6.283185307 rad/s at 0 s",
        "  never moves", "drum - ground ", "  damping = 0.02 N*m*s/rad", "pivot.k1", "stiffness = 3 N*m/rad",
        "pivot.dashpot1", "assemblies:", "recorded:\n  ", "efficiency = [0.6, -0.2]  bearing = 3 N*m\n"}) {
    CAPTURE(part);
    CHECK(contains(result.out, part));
  }
}

TEST_CASE("check finds what run would refuse, with the same status") {
  const Folder folder;
  folder.write("mistaken.toml", mistaken);
  folder.write("contradictory.toml", contradictory);
  const Finished two = folder.shell("rheonet check mistaken.toml");
  CHECK(two.status == 2);
  CHECK(two.err == folder.shell("rheonet run mistaken.toml").err);
  CHECK(two.out == "");
  const Finished one = folder.shell("rheonet check contradictory.toml");
  CHECK(one.status == 1);
  CHECK(contains(one.err, "left"));
  CHECK(contains(one.err, "right"));
  CHECK(folder.shell("rheonet check contradictory.toml --set right.at=other").status == 0);
}

TEST_CASE("what is wrong with a network has its place in the netlist, and what would mend it") {
  const Folder folder;
  const std::string spring = "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 3 }\n";
  const std::string inertia = "m = { type = \"mass\", at = \"a\", mass = 1 }\n";
  struct Case { std::string elements, start; };
  const Case cases[] = {
      {spring + inertia + "d = { type = \"motion\", at = \"ground\", velocity = 1 }\n",
       "scene.toml:4:1: error: motion `d` moves `ground`, which never moves; prescribe another node\n"},
      {spring + inertia + "k2 = { type = \"spring\", between = [\"b\", \"c\"], stiffness = 3 }\n",
       "scene.toml:4:36: error: nothing determines the motion of nodes `b`, `c`: "},
      {spring + inertia + "push = { type = \"force\", at = \"b\", force = 1 }\n",
       "scene.toml:4:31: error: nothing determines the motion of node `b`: "},
      {"one = { type = \"motion\", at = \"a\", velocity = 1 }\n"
       "two = { type = \"motion\", at = \"b\", velocity = 2 }\n"
       "link = { type = \"slider\", between = [\"a\", \"b\"], coulomb = \"inf\" }\n",
       "scene.toml:4:1: error: rigid link `link` joins node `b`, which motion `two` moves at 2 m/s, to node `a`, which motion `one` moves at 1 m/s, at t = 0 s; leave out the link or one of the motions"},
      {inertia + "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 3, d0 = 1 }\n"
                 "[nodes]\na = { position = 2 }\n",
       "scene.toml:3:1: error: element `k` cannot start with the displacement d0 = 1"},
      {spring + "d = { type = \"motion\", at = \"a\", velocity = 1 }\n[nodes]\na = { velocity = 2 }\n",
       "scene.toml:5:1: error: node `a` cannot start with velocity 2 m/s: motion `d` gives it 1 m/s"},
  };
  for (const auto& [elements, start] : cases) {
    CAPTURE(elements);
    folder.write("scene.toml", "[elements]\n" + elements + "[simulate]\nstop = 1\n");
    const Finished result = folder.shell("rheonet check scene.toml");
    CHECK(result.status == 1);
    CHECK_MESSAGE(contains('\n' + result.err, '\n' + std::string(start)), result.err);  // warnings may come before it
    CHECK(contains(result.err, "| "));  // the line itself
    CHECK(contains(folder.shell("rheonet run scene.toml").err, start));
  }
}

TEST_CASE("a node at which a single element ends is told, with the name that may be meant") {
  const Folder folder;
  const auto warnings = [&](const std::string& from, const std::string& to) {
    folder.write("scene.toml", "[elements]\nm = { type = \"mass\", at = \"seat\", mass = 1 }\n"
                               "k = { type = \"spring\", between = [\"" + from + "\", \"" + to + "\"], stiffness = 3 }\n"
                               "c = { type = \"dashpot\", between = [\"seat\", \"ground\"], damping = 2 }\n"
                               "f = { type = \"force\", at = \"seat\", force = 1 }\n"
                               "[simulate]\nstop = 1\n");
    const Finished result = folder.shell("rheonet run scene.toml -q -o rows.csv");
    CHECK(result.status == 0);
    return result.err;
  };
  CHECK(warnings("seat", "ground") == "");
  CHECK(warnings("sat", "ground") == R"(scene.toml:3:35: warning: nothing but `k` is at node `sat`: it carries no force
    3 | k = { type = "spring", between = ["sat", "ground"], stiffness = 3 }
      |                                   ^
  did you mean `seat`?
)");
  CHECK(warnings("seat", "elsewhere") == R"(scene.toml:3:43: warning: nothing but `k` is at node `elsewhere`: it carries no force
    3 | k = { type = "spring", between = ["seat", "elsewhere"], stiffness = 3 }
      |                                           ^
  a node is free until something holds it; the one that never moves is `ground`
)");
  CHECK(warnings("seat", "grond") == R"(scene.toml:3:43: warning: nothing but `k` is at node `grond`: it carries no force
    3 | k = { type = "spring", between = ["seat", "grond"], stiffness = 3 }
      |                                           ^
  did you mean `ground`?
)");
  // Its own other end is not suggested: an element needs two different ends.
  CHECK(warnings("seat", "seta") == R"(scene.toml:3:43: warning: nothing but `k` is at node `seta`: it carries no force
    3 | k = { type = "spring", between = ["seat", "seta"], stiffness = 3 }
      |                                           ^
  a node is free until something holds it; the one that never moves is `ground`
)");
  CHECK(warnings("seat", "Ground") == R"(scene.toml:3:43: warning: node `Ground` moves as any other does
    3 | k = { type = "spring", between = ["seat", "Ground"], stiffness = 3 }
      |                                           ^
  the node that never moves is `ground`
)");
}

TEST_CASE("more loose nodes than are mistyped are meant: none is guessed") {
  const Folder folder;
  const auto guesses = [&](int loose) {
    std::string scene = "[elements]\nm = { type = \"mass\", at = \"seat\", mass = 1 }\n";
    for (int n = 0; n < loose; ++n) {
      const std::string number = std::to_string(n);
      scene += "k" + number + " = { type = \"spring\", between = [\"seat\", \"end" + number + "\"], stiffness = 3 }\n";
    }
    folder.write("scene.toml", scene + "[simulate]\nstop = 1\n");
    const std::string told = folder.shell("rheonet check scene.toml", 0).err;
    CHECK(told.find("is at node `end1`: it carries no force") != std::string::npos);
    return told.find("did you mean") != std::string::npos;
  };
  CHECK(guesses(20));
  CHECK(!guesses(21));
}

TEST_CASE("a delay so short that the run takes millions of steps is told before") {
  const Folder folder;
  const auto notes = [&](const std::string& delay) {
    folder.write("scene.toml", "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                               "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 3 }\n"
                               "slow = { type = \"lag\", in = \"m.velocity\", time_constant = 0.1 }\n"
                               "late = { type = \"delay\", in = \"slow\", delay = \"" + delay + "\" }\n"
                               "f = { type = \"motion\", at = \"b\", velocity = { block = \"late\" } }\n"
                               "c = { type = \"dashpot\", between = [\"a\", \"b\"], damping = 0.2 }\n[simulate]\nstop = 3\n");
    const Finished result = folder.shell("rheonet check scene.toml");
    CHECK(result.status == 0);
    return result.out + result.err;
  };
  CHECK(!contains(notes("1 ms"), "delay"));
  CHECK(contains(notes("1 ns"), "no step can be longer than the shortest delay in front of a prescribed motion, or behind what has no mass, 1e-09 s: this run takes 3.0e+09 of them"));
}

TEST_CASE("check -v lists what was not given and had to be chosen") {
  const Folder folder;
  folder.write("scene.toml", R"([elements]
drive = { type = "motion", at = "a", velocity = 1 }
v1 = { type = "vfm", between = ["a", "m"], damping = 2, stiffness = 10, f0 = 3 }
v2 = { type = "vfm", between = ["n", "m"], damping = 2, stiffness = 10 }
k = { type = "spring", between = ["n", "ground"], stiffness = 10 }
[simulate]
stop = 1
)");
  const Finished verbose = folder.shell("rheonet check -v scene.toml");
  CHECK(verbose.status == 0);
  CHECK(contains(verbose.out,
                 "chosen at the start:\n"
                 "  element `v2` starts with a force of -3 N: it has no f0, and has to balance what is given at node `m`\n"
                 "  node `n` starts at position 0.3 m: it has no mass, and there the forces balance\n"));
  CHECK_FALSE(contains(folder.shell("rheonet check scene.toml").out, "starts"));
  const Finished noted = folder.shell("rheonet check scene.toml --set nodes.n.velocity=7");
  CHECK(contains(noted.out, "note: node `n` starts with a velocity of "));
  CHECK(contains(noted.out, ", not with the 7 that is given: it has no mass, and the elements there decide"));
  const Finished refused = folder.shell("rheonet check scene.toml --set v2.f0=3");
  CHECK(refused.status == 1);
  CHECK(contains(refused.err, "scene.toml:3:1: error: the initial forces at node `m` do not balance"));
}

TEST_CASE("values that contradict each other are mistakes of the netlist, each at its place") {
  const std::pair<const char*, const char*> cases[] = {
      {"slider\", coulomb = 2, breakaway = 1.9999 }",
       "scene.toml:2:76: error: `breakaway` must be at least `coulomb`: under a force between the two the slider could neither "
       "stick nor slip\n"},
      {"sfm\", stiffness = 31, coulomb = 1.7, f0 = -1.70001 }",
       "scene.toml:2:84: error: `f0` lies beyond `coulomb`: a force that it cannot have\n"},
      {"cfm\", stiffness = 31, damping = 3, coulomb = 1.7, f0 = 1.70001 }",
       "scene.toml:2:97: error: `f0` lies beyond `coulomb`: a force that it cannot have\n"},
      {"cfm\", damping = 3, coulomb = 1.7, stiffness = \"inf\" }", "scene.toml:2:88: error: `stiffness` = inf needs "},
      {"slider\", coulomb = 2, breakaway = 2 }", ""},
      {"sfm\", stiffness = 31, coulomb = 1.7, f0 = -1.7 }", ""},
  };
  for (const auto& [element, start] : cases) {
    CAPTURE(element);
    const Folder folder(std::string("[elements]\ne = { between = [\"a\", \"ground\"], type = \"") + element +
                        "\nm = { type = \"mass\", at = \"a\", mass = 1 }\n[simulate]\nstop = 1\n");
    const Finished result = folder.shell("rheonet check scene.toml", *start ? 2 : 0);
    CHECK_MESSAGE(result.err.starts_with(start), result.err);
  }
}

TEST_CASE("models are included from the library: the one named by RHEONET_LIBRARY, or the one that comes along") {
  const Folder folder;
  folder.write("scene.toml", R"(include = ["library/rheology.toml"]
[elements]
drive = { type = "motion", at = "a", velocity = 1 }
m1 = { type = "maxwell", between = ["a", "ground"], k = 1, B = 1 }
[simulate]
stop = 1
output = { points = 5 }
)");
  CHECK(folder.shell("rheonet check scene.toml").status == 0);
  CHECK(folder.shell("RHEONET_LIBRARY= rheonet check scene.toml").status == 0);
  const Finished absent = folder.shell("RHEONET_LIBRARY=\"$PWD\" rheonet check scene.toml");
  CHECK(absent.status == 2);
  CHECK(contains(absent.err, "library/rheology.toml"));

  folder.write("mine/library/rheology.toml", R"([models.maxwell]
ports = ["a", "b"]
parameters = ["k", "B"]
[models.maxwell.elements]
only = { type = "dashpot", between = ["a", "b"], damping = 7 }
)");
  const Finished own = folder.shell("RHEONET_LIBRARY=\"$PWD/mine\" rheonet check -v scene.toml", 0);
  CHECK(contains(own.out, "m1.only"));
}

TEST_CASE("check, run and explain give advice, each with its place, and do what they are asked for") {
  const Folder folder(R"([parameters]
slack = "3 mm"
[elements]
drive = { type = "motion", at = "hand", velocity = { table = [[0, 0], [1, 2]] } }
k1 = { type = "spring", between = ["hand", "body"], stiffness = 3 }
c1 = { type = "dashpot", between = ["body", "ground"], damping = 2 }
m1 = { type = "mass", at = "Body", mass = 1 }
k2 = { type = "spring", between = ["Body", "ground"], stiffness = 3 }
[simulate]
stop = 2
output = { points = 3 }
)");
  const std::string advice = R"(scene.toml:2:1: warning: no expression uses parameter `slack`: its value changes nothing
    2 | slack = "3 mm"
      | ^
  use it, as in stiffness = "slack", or leave it out
command line: warning: nothing in the scene has delay: to leave it out changes nothing
      | --without delay
      |           ^
  its effects are `inertia`, `elasticity` and `viscosity`
scene.toml:4:1: warning: the table of `drive` ends at 1 s, before the run does at 2 s: its last value is held from there on
    4 | drive = { type = "motion", at = "hand", velocity = { table = [[0, 0], [1, 2]] } }
      | ^
  end the run there, or give its last value once more at a later time
scene.toml:7:28: warning: nodes `body` and `Body` differ in capital letters only: they are two nodes, and nothing joins them
    7 | m1 = { type = "mass", at = "Body", mass = 1 }
      |                            ^
  write `body` everywhere if one node is meant
)";
  for (const char* const command : {"check", "run -q -o rows.csv", "explain"}) {
    CAPTURE(command);
    CHECK(folder.shell(std::string("rheonet ") + command + " scene.toml --without delay", 0).err == advice);
  }
}

}  // namespace rheonet::test::check_test
