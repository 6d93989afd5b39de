#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/dae/unknown_names.hpp"
#include "tests/support/probe.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::derivative_test {

namespace {

/// One node of each kind, groups of two, loops, laws of each role, forces and motions that vary.
Scene everything() {
  SceneBuilder b;
  b.motion("drive", "end", "position", Signal(Signal::Sine{0.031, 1.9, 0, 0, 0}));
  b.motion("other", "far", "velocity", Signal(Signal::Chirp{0.23, 0.7, 2.9, 0.8, 0.4, 0, 0}));
  b.between("k1", "spring", "end", "n1", {{"stiffness", 131.0}});
  b.between("c1", "dashpot", "n1", "n2", {{"damping", 3.7}});
  b.between("k2", "spring", "n2", "far", {{"stiffness", 57.0}});
  b.between("f1", "sfm", "n1", "far", {{"stiffness", 219.0}, {"coulomb", 1.7}, {"exponent", 1.3}});
  b.between("v1", "vfm", "n2", "heavy", {{"damping", 2.3}, {"stiffness", 83.0}});
  b.at("m", "mass", "heavy", {{"mass", 0.37}});
  b.between("c2", "dashpot", "heavy", "n3", {{"damping", 1.9}, {"flow_index", 0.71}});
  b.between("k3", "spring", "n3", "ground", {{"stiffness", 47.0}, {"f0", 0.9}});
  b.between("c3", "dashpot", "n4", "n3", {{"damping", 0.9}});
  b.between("k4", "spring", "n4", "end", {{"stiffness", 29.0}});
  b.between("c4", "dashpot", "n4", "ground", {{"damping", 1.1}});
  b.force("push", "n2", Signal(Signal::Sine{0.7, 1.3, 0.6, 0, 0}));
  b.force("squeeze", "n4", "heavy", Signal(Signal::Sine{0.5, 2.1, 1.9, 0, 0}));
  b.start("heavy", 0.017, -0.13);
  return b.finish(0.83, 10, 1e-8);
}

}  // namespace

// y' solves the equations: differential ones as they stand, algebraic ones differentiated in time. The latter is
// checked by a difference of the residual along (1, y'), without any Jacobian.
TEST_CASE("y' of a consistent state satisfies the equations and their derivatives") {
  Probe probe(everything());
  Dae& dae = probe.dae();
  const std::size_t n = at(dae.size());
  int visits = 0, algebraic = 0;
  for (int i = 0; i < dae.size(); ++i) algebraic += !dae.differential(i);
  CHECK(algebraic >= 4);
  CHECK(algebraic + 4 <= dae.size());
  std::vector<double> r(n), largest(n, 0), worst(n, 0), moved(n);
  probe.along(7, 1, [&](double t, const std::vector<double>& y, const std::vector<double>& yp) {
    ++visits;
    Dae& dae = probe.dae();
    dae.residual(t, y.data(), yp.data(), r.data());
    for (std::size_t i = 0; i < n; ++i) {
      if (dae.differential(static_cast<int>(i))) worst[i] = std::max(worst[i], std::abs(r[i]));
    }
    const std::vector<double> zero(n, 0);
    const auto residual = [&](double h, std::size_t row) {
      for (std::size_t i = 0; i < n; ++i) moved[i] = y[i] + h * yp[i];
      dae.residual(t + h, moved.data(), zero.data(), r.data());
      return r[row];
    };
    for (std::size_t i = 0; i < n; ++i) {
      const Difference d = difference([&](double h) { return residual(h, i); }, 0, 1e-4, 1e-6);
      largest[i] = std::max(largest[i], std::abs(residual(0, i)));
      if (!dae.differential(static_cast<int>(i)) && d.doubt < 1e-5) worst[i] = std::max(worst[i], std::abs(d.value));
    }
  });
  CHECK(visits > 20);
  // Velocities are up to 0.5 m/s, forces up to 3 N, both change within 0.1 s: rates are up to 30 N/s.
  for (std::size_t i = 0; i < n; ++i) CHECK_MESSAGE(worst[i] < 3e-6, UnknownNames(dae).describe(static_cast<int>(i)) << worst[i]);
}

// Simpson's rule over three instants of one step: y' is the derivative of the trajectory itself.
TEST_CASE("y' of a consistent state is the slope of the trajectory") {
  // A slope is off by what y is off by, over the shortest time constant.
  Scene scene = everything();
  scene.accuracy = 1e-9;
  Probe probe(scene);
  Dae& dae = probe.dae();
  const std::size_t n = at(dae.size());
  struct EventTransition {
    double t;
    std::vector<double> y, yp;
  };
  std::vector<EventTransition> three;
  std::vector<double> worst(n, 0), largest(n, 0);
  int compared = 0;
  probe.along(5, 3, [&](double t, const std::vector<double>& y, const std::vector<double>& yp) {
    three.push_back({t, y, yp});
    if (three.size() < 3) return;
    const double h = three[1].t - three[0].t;
    ++compared;
    for (std::size_t i = 0; i < n; ++i) {
      const double slope = (three[0].yp[i] + 4 * three[1].yp[i] + three[2].yp[i]) / 6;
      largest[i] = std::max(largest[i], std::abs(slope));
      worst[i] = std::max(worst[i], std::abs((three[2].y[i] - three[0].y[i]) / (2 * h) - slope));
    }
    three.clear();
  });
  CHECK(compared > 20);
  for (std::size_t i = 0; i < n; ++i) {
    CHECK_MESSAGE(worst[i] <= 1e-3 * largest[i], UnknownNames(dae).describe(static_cast<int>(i))
                                                     << ": " << worst[i] << " of " << largest[i]);
  }
}

}  // namespace rheonet::test::derivative_test
