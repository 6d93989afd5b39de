// The properties that each law declares, at states of real runs: its derivative and its power balance.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/contract/situation.hpp"
#include "tests/support/probe.hpp"

namespace rheonet::test::law_test {

namespace {

/// A difference quotient over a kink says nothing of either side; this many of all must say something.
constexpr double conclusive_share = 0.9;
/// Relative to the slope, or to the force over a typical deflection if that is more.
constexpr double tolerance = 1e-7;

struct Tally {
  long tried = 0, conclusive = 0;
  double worst = 0;  ///< Largest ratio of error to allowed error.
};

double allowed(double derivative, double scale) { return tolerance * std::max(scale, std::abs(derivative)); }

void compare(double derivative, const Difference& d, double scale, Tally& tally) {
  ++tally.tried;
  const double limit = allowed(derivative, scale);
  if (d.doubt > limit) return;
  ++tally.conclusive;
  const double error = std::abs(derivative - d.value);
  if (error == 0) return;
  tally.worst = std::isfinite(error / limit) ? std::max(tally.worst, error / limit) : HUGE_VAL;
}

/// One element of a batch as a function of its own argument.
template <class Evaluate>
auto of_element(const Evaluate& evaluate, std::vector<double> arguments, std::size_t i) {
  return [=](double x) mutable {
    arguments[i] = x;
    return evaluate(arguments)[i];
  };
}

void check_deflections(Probe& probe, const Dae::View& view, Tally& force, Tally& creep) {
  for (const Laws<DeflectionBatch>& laws : probe.network().deflection_laws) {
    const DeflectionBatch& batch = *laws.batch;
    const std::size_t n = batch.size();
    const std::vector<double> p(&view.p[static_cast<std::size_t>(laws.first)],
                                &view.p[static_cast<std::size_t>(laws.first)] + n);
    std::vector<double> f(n), df(n), c(n), dc(n), f_alone(n), c_alone(n);
    batch.linearise(p.data(), f.data(), df.data(), c.data(), dc.data());
    batch.evaluate(p.data(), f_alone.data(), c_alone.data());
    CHECK(f == f_alone);
    CHECK(c == c_alone);
    const auto forces = [&](const std::vector<double>& x) {
      batch.evaluate(x.data(), f_alone.data(), c_alone.data());
      return f_alone;
    };
    const auto creeps = [&](const std::vector<double>& x) {
      batch.evaluate(x.data(), f_alone.data(), c_alone.data());
      return c_alone;
    };
    const double length = typical.length;
    const auto slope = [&](const auto& function, std::size_t i, double derivative, double scale) {
      return difference(of_element(function, p, i), p[i], 1e-3 * length, allowed(derivative, scale));
    };
    for (std::size_t i = 0; i < n; ++i) {
      const double f_scale = std::abs(f[i]) / length, c_scale = std::abs(c[i]) / length;
      compare(df[i], slope(forces, i, df[i], f_scale), f_scale, force);
      if (batch.creeps(i)) {
        compare(dc[i], slope(creeps, i, dc[i], c_scale), c_scale, creep);
      } else {
        CHECK_EQ(c[i], 0);
        CHECK_EQ(dc[i], 0);
      }
    }
  }
}

void check_rates(Probe& probe, const Dae::View& view, Random& random, Tally& tally) {
  for (const Laws<RateBatch>& laws : probe.network().rate_laws) {
    const RateBatch& batch = *laws.batch;
    const std::size_t n = batch.size(), first = static_cast<std::size_t>(laws.first);
    std::vector<double> in(n), out(n), derivative(n), alone(n);
    for (std::size_t i = 0; i < n; ++i) {
      in[i] = (batch.by_force(i) ? view.rate_force : view.rate_velocity)[first + i];
      // A trajectory keeps to one magnitude; a power law has none of its own.
      in[i] *= random.around(1, 100) * random.sign();
    }
    batch.linearise(in.data(), out.data(), derivative.data());
    batch.evaluate(in.data(), alone.data());
    CHECK(out == alone);
    const auto outs = [&](const std::vector<double>& x) {
      batch.evaluate(x.data(), alone.data());
      return alone;
    };
    for (std::size_t i = 0; i < n; ++i) {
      // At rest a power law may have no slope, and among the smallest doubles none has its digits.
      if (std::abs(in[i]) < 1e-100 || std::abs(out[i]) < 1e-100) continue;
      const double scale = std::abs(out[i] / in[i]);
      compare(derivative[i],
              difference(of_element(outs, in, i), in[i], 1e-3 * std::abs(in[i]), allowed(derivative[i], scale)), scale,
              tally);
    }
  }
}

/// f w = d(stored)/dt + dissipated for each element by itself, at every instant.
void check_power(Probe& probe, const Dae::View& view, Tally& tally) {
  for (const Laws<DeflectionBatch>& laws : probe.network().deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = static_cast<std::size_t>(laws.first) + i;
      const double dissipated = laws.batch->dissipated_power(i, view.p[j], view.dp[j], view.flow[j]);
      const double supplied = view.f[j] * view.flow[j], rate = view.dp[j];
      // Where the force goes through 0 its rounding is that of larger ones.
      const double scale = std::abs(supplied) + std::abs(dissipated) + 1e-6 * typical.force * std::abs(view.flow[j]);
      // A delayed law is not passive: it may return energy.
      const bool passive = laws.batch->delay(i) == 0;
      CHECK_MESSAGE((!passive || dissipated >= -1e-9 * scale), "dissipated " << dissipated << " of " << supplied);
      if (rate == 0) continue;
      const auto stored = [&](double p) { return laws.batch->stored_energy(i, p); };
      const Difference d = difference(stored, view.p[j], 1e-3 * typical.length, tolerance * scale / std::abs(rate));
      compare((supplied - dissipated) / rate, d, scale / std::abs(rate), tally);
    }
  }
  for (std::size_t r = 0; r < view.rate_force.size(); ++r) CHECK(view.rate_force[r] * view.rate_velocity[r] >= 0);
}

void check(const Tally& tally) {
  CHECK_MESSAGE(tally.worst <= 1, "off by " << tally.worst << " times what is allowed");
  CHECK_MESSAGE(static_cast<double>(tally.conclusive) >= conclusive_share * static_cast<double>(tally.tried),
                tally.conclusive << " of " << tally.tried << " could be told");
}

}  // namespace

TEST_CASE("contract: derivatives and power of each law along trajectories") {
  for_each(cases(), [](const Case& c, const Situation& situation) {
    Probe probe(situation.scene);
    Random random(c.seed);
    Tally force, creep, rate, power;
    probe.along(3, 2, [&](double t, const std::vector<double>& y, const std::vector<double>& yp) {
      const Dae::View view = probe.dae().view(t, y.data(), yp.data());
      check_deflections(probe, view, force, creep);
      check_rates(probe, view, random, rate);
      check_power(probe, view, power);
    });
    for (const Tally* tally : {&force, &creep, &rate, &power}) check(*tally);
  });
}

}  // namespace rheonet::test::law_test
