#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/probe.hpp"

namespace rheonet::test::jacobian_test {

namespace {

/// Typical magnitude of each unknown.
std::vector<double> scales(Probe& probe, Domain domain) {
  Dae& dae = probe.dae();
  std::vector<double> scale(at(dae.size()), 1);
  const auto set = [&](int unknown, Quantity quantity) {
    if (unknown >= 0) scale[at(unknown)] = typical.of(quantity, domain);
  };
  for (std::size_t n = 0; n < probe.structure().kind.size(); ++n) {
    set(dae.indices().velocity[n], Quantity::velocity);
    set(dae.indices().position[n], Quantity::position);
  }
  for (std::size_t j = 0; j < probe.network().deflections.size(); ++j) {
    set(dae.indices().deflection[j], Quantity::position);
  }
  for (std::size_t r = 0; r < probe.network().rates.size(); ++r) {
    set(dae.indices().force[r], Quantity::force);
  }
  return scale;
}

struct Result {
  double worst = 0;  ///< Largest ratio of error to allowed error.
  long conclusive = 0, tried = 0;
};

/// dF/dy + cj dF/dy' by columns against central differences of F along (y, y') = (e, cj e).
void compare(Dae& dae, double t, const std::vector<double>& y, const std::vector<double>& yp, double cj,
             const std::vector<double>& scale, Result& result) {
  constexpr double tolerance = 1e-7;  // relative to the largest entry of the row, in units of the scales
  const std::size_t n = y.size();
  std::vector<double> values(at(dae.pattern().entries())), dense(n * n, 0);
  dae.jacobian(t, cj, y.data(), yp.data(), values.data());
  for (std::size_t c = 0; c < n; ++c) {
    for (int e = dae.pattern().column_start[c]; e < dae.pattern().column_start[c + 1]; ++e) {
      dense[at(dae.pattern().row[at(e)]) * n + c] += values[at(e)];
    }
  }
  std::vector<double> y_moved(y), yp_moved(yp), r(n);
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t row = 0; row < n; ++row) {
      const auto residual = [&](double x) {
        y_moved[c] = x;
        yp_moved[c] = yp[c] + cj * (x - y[c]);
        dae.residual(t, y_moved.data(), yp_moved.data(), r.data());
        return r[row];
      };
      double largest = 0;
      for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(dense[row * n + k]) * scale[k]);
      const double allowed = tolerance * largest / scale[c];
      const Difference d = difference(residual, y[c], 1e-3 * scale[c], allowed);
      y_moved[c] = y[c];
      yp_moved[c] = yp[c];
      ++result.tried;
      if (d.doubt > allowed) continue;
      ++result.conclusive;
      const double error = std::abs(dense[row * n + c] - d.value);
      if (error > 0) result.worst = std::max(result.worst, std::isfinite(error) ? error / allowed : HUGE_VAL);
    }
  }
}

}  // namespace

TEST_CASE("contract: Jacobian of the assembled equations") {
  for_each(cases(), [](const Case& c, const Situation& situation) {
    Probe probe(situation.scene);
    Random random(c.seed);
    Result result;
    probe.along(29, 1, [&](double t, std::vector<double> y, std::vector<double> yp) {
      const std::vector<double> scale = scales(probe, c.place.domain);
      // Beside the trajectory, as the iterates of a solver are.
      for (std::size_t k = 0; k < y.size(); ++k) {
        y[k] += 0.02 * random.uniform(-1, 1) * scale[k];
        yp[k] += random.uniform(-1, 1) * scale[k] / typical.time;
      }
      compare(probe.dae(), t, y, yp, random.around(1, 100) / typical.time, scale, result);
    });
    CHECK_MESSAGE(result.worst <= 1, "off by " << result.worst << " times what is allowed");
    CHECK_MESSAGE(10 * result.conclusive >= 9 * result.tried,
                  result.conclusive << " of " << result.tried << " could be told");
  });
}

}  // namespace rheonet::test::jacobian_test
