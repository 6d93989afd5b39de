// Derivatives by values of generated networks with at least three events, against differences of an independent solution in long double.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/sensitivities.hpp"
#include "tests/support/random.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/piecewise_linear_network.hpp"
#include "tests/support/stored_rows.hpp"

namespace rheonet::test::generated_sensitivities_test {

namespace {

constexpr double stop = 4;
constexpr int points = 81;

PiecewiseLinearNetwork random_network(Random& random) {
  PiecewiseLinearNetwork network;
  const int n = 1 + random.below(4);
  const bool from_rest = random.below(2) == 0;
  network.frequency = random.around(0.8, 2);
  network.drive_velocity = random.sign() * random.around(0.3, 3);
  const auto other = [&](int a) { return a == 0 ? (random.below(2) == 0 ? PiecewiseLinearNetwork::drive : PiecewiseLinearNetwork::ground) : random.below(a); };
  for (int i = 0; i < n; ++i) {
    network.masses.push_back({random.around(1, 3), from_rest ? 0 : random.uniform(-2, 2), random.uniform(-1, 1), random.around(2, 3)});
    network.springs.push_back({i, other(i), random.around(20, 4)});
  }
  for (int i = random.below(3); i > 0; --i) {
    const int a = random.below(n);
    network.dashpots.push_back({a, random.below(2) == 0 ? PiecewiseLinearNetwork::ground : other(a), random.around(0.5, 4)});
  }
  // At most one way of sliders from any node to another: ground and the drive count as one node, the last one.
  std::vector<int> group(static_cast<std::size_t>(n) + 1);
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<int>(i);
  for (int i = 1 + random.below(3); i > 0; --i) {
    const int a = random.below(n), b = random.below(2) == 0 ? PiecewiseLinearNetwork::ground : other(a);
    const int mine = group[static_cast<std::size_t>(a)], its = group[b >= 0 ? static_cast<std::size_t>(b) : static_cast<std::size_t>(n)];
    if (mine == its) continue;
    std::replace(group.begin(), group.end(), mine, its);
    const double sliding = random.around(1, 3);
    network.sliders.push_back({a, b, sliding, random.below(2) == 0 ? 0 : sliding * random.uniform(1.05, 1.6)});
  }
  return network;
}

struct Value {
  std::string path;
  std::function<long double&(PiecewiseLinearNetwork&)> of;
};

std::vector<Value> values_of(const PiecewiseLinearNetwork& network) {
  std::vector<Value> values;
  for (std::size_t i = 0; i < network.masses.size(); ++i) {
    values.push_back({fmt::format("m{}.mass", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.masses[i].mass; }});
    values.push_back({fmt::format("f{}.force.sine", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.masses[i].amplitude; }});
    values.push_back({fmt::format("f{}.force.offset", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.masses[i].force; }});
    if (network.masses[i].velocity != 0) values.push_back({fmt::format("nodes.n{}.velocity", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.masses[i].velocity; }});
  }
  for (std::size_t i = 0; i < network.springs.size(); ++i)
    values.push_back({fmt::format("k{}.stiffness", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.springs[i].value; }});
  for (std::size_t i = 0; i < network.dashpots.size(); ++i)
    values.push_back({fmt::format("c{}.damping", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.dashpots[i].value; }});
  for (std::size_t i = 0; i < network.sliders.size(); ++i) {
    values.push_back({fmt::format("s{}.coulomb", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.sliders[i].sliding; }});
    if (network.sliders[i].breakaway > 0) values.push_back({fmt::format("s{}.breakaway", i), [i](PiecewiseLinearNetwork& n) -> long double& { return n.sliders[i].breakaway; }});
  }
  return values;
}

std::vector<long double> row_times() {
  std::vector<long double> times;
  for (int i = 0; i < points; ++i) times.push_back(static_cast<long double>(stop) * i / (points - 1));
  return times;
}

/// The derivatives p dr/dp of the rows, to the fourth order; rows between an event of one run and the same event of another are left out.
struct Derivatives {
  std::vector<bool> known;
  std::vector<std::vector<double>> rows;
};

/// Nothing where a change of the value changes the events, where there are too few, or where the change is too large for a fourth order.
std::optional<Derivatives> derivatives(const PiecewiseLinearNetwork& network, const Value& value) {
  constexpr long double change = 1e-5L;
  const std::vector<long double> times = row_times();
  const auto changed = [&](int steps) {
    PiecewiseLinearNetwork other = network;
    value.of(other) *= 1 + steps * change;
    return move(other, times);
  };
  const std::array<SliderMotion, 5> runs{changed(-2), changed(-1), changed(0), changed(1), changed(2)};
  if (runs[2].events.size() < 3) return {};
  Derivatives result{std::vector<bool>(times.size(), true), {}};
  for (std::size_t e = 0; e < runs[2].events.size(); ++e) {
    long double first = runs[2].events[e].time, last = first;
    for (const SliderMotion& run : runs) {
      if (run.events.size() != runs[2].events.size()) return {};
      const SliderEvent& event = run.events[e];
      if (event.slider != runs[2].events[e].slider || event.direction != runs[2].events[e].direction) return {};
      first = std::min(first, event.time);
      last = std::max(last, event.time);
    }
    for (std::size_t row = 0; row < times.size(); ++row)
      if (times[row] >= first && times[row] <= last) result.known[row] = false;
  }
  long double left = 0, largest = 0;
  for (std::size_t row = 0; row < times.size(); ++row) {
    std::vector<double>& derivative = result.rows.emplace_back();
    for (std::size_t k = 0; k < runs[2].rows[row].size(); ++k) {
      const long double near = (runs[3].rows[row][k] - runs[1].rows[row][k]) / (2 * change), far = (runs[4].rows[row][k] - runs[0].rows[row][k]) / (4 * change);
      derivative.push_back(static_cast<double>((4 * near - far) / 3));
      if (result.known[row]) left = std::max(left, std::abs(near - far));
      largest = std::max(largest, std::abs(near));
    }
  }
  if (left > 1e-5L * largest) return {};
  return result;
}

/// The next network with a value for which the independent solution has derivatives.
struct Case {
  PiecewiseLinearNetwork network;
  Value value;
  Derivatives exact;
};

Case next_case(Random& random) {
  for (;;) {
    PiecewiseLinearNetwork network = random_network(random);
    const std::vector<Value> values = values_of(network);
    Value value = values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
    try {
      if (std::optional<Derivatives> exact = derivatives(network, value)) return {std::move(network), std::move(value), *std::move(exact)};
    } catch (const std::runtime_error&) {
      // No modes fit, or several: the motion of such a network is not defined.
    }
  }
}

std::string netlist_of(const Case& of, const std::string& method) { return netlist_of(of.network, stop, points, method, 1e-9); }

/// Largest magnitude of a record or of another series of rows.
double largest_of(const std::vector<std::vector<double>>& rows, std::size_t record) {
  double largest = 0;
  for (const std::vector<double>& row : rows) largest = std::max(largest, std::abs(row[record]));
  return largest;
}

std::vector<std::vector<double>> records_of(const PiecewiseLinearNetwork& network) {
  std::vector<std::vector<double>> rows;
  for (const std::vector<long double>& row : move(network, row_times()).rows) rows.emplace_back(row.begin(), row.end());
  return rows;
}

/// Largest difference from the exact derivatives, of the largest magnitude of the record or its derivative, or of a thousandth of another record
/// of the same unit: some masses never move. Also checks that the stated errors cover the differences.
double off(const Case& of, const std::string& toml) {
  const Sensitivity found = sensitivity(
      [&](double factor) {
        ReadOptions options;
        options.overrides = {fmt::format("{}*={:.17g}", of.value.path, factor)};
        ReadResult read = read_scene_text(toml, "scene.toml", ".", declarations(), options);
        if (!read.scene) throw std::runtime_error(read.diagnostics.front().message);
        return *std::move(read.scene);
      },
      of.value.path);
  const RowsInMemory rows = read_back(found.rows);
  REQUIRE(rows.times.size() == of.exact.rows.size());
  const std::vector<std::vector<double>> records = records_of(of.network);
  double worst = 0;
  for (std::size_t k = 0; k < of.exact.rows[0].size(); ++k) {
    double scale = std::max(largest_of(of.exact.rows, k), largest_of(records, k));
    const std::size_t n = of.network.masses.size(), first = k < n ? 0 : n;
    for (std::size_t other = first; other < first + n; ++other) scale = std::max({scale, largest_of(of.exact.rows, other) / 1000, largest_of(records, other) / 1000});
    double difference = 0;
    for (std::size_t row = 0; row < rows.times.size(); ++row)
      if (of.exact.known[row]) difference = std::max(difference, std::abs(rows.values[row][k] - of.exact.rows[row][k]));
    CHECK(difference <= found.records[k].error + 1e-12 * scale);
    worst = std::max(worst, difference / scale);
  }
  return worst;
}

/// How many cases: `RHEONET_SENSITIVITIES=N`, or these.
int cases(int usual) {
  const char* const given = std::getenv("RHEONET_SENSITIVITIES");
  return given ? std::max(1, std::atoi(given)) : usual;
}

}  // namespace

TEST_CASE("rows of slider networks in closed form agree with the independent solution") {
  Random random(2701);
  for (int i = cases(200); i > 0; --i) {
    const Case of = next_case(random);
    const std::string toml = netlist_of(of, "exact");
    CAPTURE(toml);
    const RunTable rows = simulate(toml);
    const std::vector<std::vector<double>> exact = records_of(of.network);
    REQUIRE(rows.time().size() == exact.size());
    for (std::size_t k = 0; k < exact[0].size(); ++k) {
      const std::size_t n = of.network.masses.size();
      const std::vector<double>& column = rows[fmt::format("n{}.{}", k % n, k < n ? "position" : "velocity")];
      double worst = 0;
      for (std::size_t row = 0; row < column.size(); ++row) worst = std::max(worst, std::abs(column[row] - exact[row][k]));
      CHECK(worst < 1e-12 * largest_of(exact, k));
    }
  }
}

TEST_CASE("derivatives across three events and more") {
  const struct { const char* method; int count; double allowed; } methods[] = {{"exact", 200, 1e-8}, {"ida", 40, 1e-5}};
  for (const auto& [method, count, allowed] : methods) {
    Random random(2702);
    for (int i = cases(count); i > 0; --i) {
      const Case of = next_case(random);
      const std::string toml = netlist_of(of, method);
      CAPTURE(of.value.path);
      CAPTURE(toml);
      CHECK(off(of, toml) < allowed);
    }
  }
}

}  // namespace rheonet::test::generated_sensitivities_test
