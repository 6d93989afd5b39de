#include "tests/contract/compare.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rheonet::test {

namespace {

constexpr double margin = 10;
/// A record that is 0 except for round-off (the force balance of a massless node, a stop that just touches in a moving frame) is compared
/// relative to the largest record of its kind.
constexpr double rounding = 1e-10;

}  // namespace

void check_related(const Scene& scene, const RunTable& base, const RunTable& other,
                   const std::function<Relation(const Record&)>& relation, double time) {
  const std::vector<double>&t = base.time(), &t_other = other.time();
  REQUIRE_EQ(t.size(), t_other.size());
  REQUIRE_GT(t.size(), 10);
  for (std::size_t row = 0; row < t.size(); ++row) {
    CHECK(std::abs(t_other[row] - time * t[row]) <= 1e-12 * time * scene.stop);
  }
  std::map<Record::Channel, double> largest;
  for (const Record& r : scene.records) largest[r.channel] = std::max(largest[r.channel], base.scale(r.path));
  for (const Record& r : scene.records) {
    const Relation is = relation(r);
    const std::vector<double>&x = base[r.path], &y = other[r.path];
    const double scale =
        base.scale(r.path) + std::abs(is.offset / is.factor) + std::abs(is.drift / is.factor) * scene.stop;
    const double allowed = std::abs(is.factor) * (margin * scene.accuracy * scale + rounding * largest[r.channel]);
    double worst = -1;
    std::size_t at = 0;
    for (std::size_t row = 0; row < t.size(); ++row) {
      const double error = std::abs(y[row] - (is.factor * x[row] + is.offset + is.drift * t[row]));
      if (!(error <= worst)) worst = std::isnan(error) ? HUGE_VAL : error, at = row;
    }
    CHECK_MESSAGE(worst <= allowed,
                  fmt::format("{} at t = {:.6g} s: {:.12g} became {:.12g}, off by {:.3g}, {:.3g} times what is allowed",
                              r.path, t[at], x[at], y[at], worst, worst / allowed));
  }
}

void check_identical(const RunTable& base, const RunTable& other) {
  for (const std::string& name : other.header) CHECK_MESSAGE(base[name] == other[name], name);
}

}  // namespace rheonet::test
