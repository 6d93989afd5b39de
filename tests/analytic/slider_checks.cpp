#include "tests/analytic/slider_checks.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"

namespace rheonet::test {

namespace {

double length(const RunTable& rows) { return rows.time().back() - rows.time().front(); }

RunTable away_from(const RunTable& rows, const std::vector<double>& jumps, double accuracy) {
  const double distance = accuracy * length(rows);
  RunTable result{{}, rows.header};
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    const double t = rows.time()[row];
    if (std::any_of(jumps.begin(), jumps.end(), [=](double jump) { return std::abs(t - jump) <= distance; })) continue;
    for (const std::string& name : rows.header) result.columns[name].push_back(rows[name][row]);
  }
  return result;
}

double nearest(const std::vector<double>& times, double t) {
  double distance = HUGE_VAL;
  for (const double other : times) distance = std::min(distance, std::abs(other - t));
  return distance;
}

}  // namespace

void check_between(const std::string& toml, const Expectations& expected, const std::vector<double>& jumps) {
  INFO(toml);
  for (const double accuracy : accuracies) {
    try {
      const RunTable rows = simulate(toml, accuracy), kept = away_from(rows, jumps, accuracy);
      CHECK_GT(kept.time().size(), 0.4 * double(rows.time().size()));
      for (const Expectation& one : expected) check_against(kept, one, accuracy);
    } catch (const std::runtime_error& refused) {
      FAIL_CHECK(fmt::format("at accuracy {:g}: {}", accuracy, refused.what()));
    }
  }
}

void check_events(const std::string& toml, const std::vector<double>& changes, const std::vector<double>& drive,
                  const std::function<bool(double t, double accuracy)>& creeps) {
  INFO(toml);
  std::vector<double> instants = changes;
  instants.insert(instants.end(), drive.begin(), drive.end());
  const auto at_stop = [](const RunTable& rows, double t) { return t == rows.time().back(); };  // the drive may end there
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    try {
      const RunTable rows = simulate(toml, accuracy);
      std::vector<double> found;
      for (std::size_t row = 1; row < rows.time().size(); ++row) {
        if (rows.time()[row] == rows.time()[row - 1]) found.push_back(rows.time()[row]);
      }
      const double allowed = accuracy * length(rows);
      for (const double t : changes) {
        CHECK_MESSAGE(nearest(found, t) <= allowed,
                      fmt::format("no event at t = {:.12g} s, the nearest is {:.3g} s away", t, nearest(found, t)));
      }
      for (const double t : found) {
        if (at_stop(rows, t) || (creeps && creeps(t, accuracy))) continue;
        CHECK_MESSAGE(
            nearest(instants, t) <= allowed,
            fmt::format("an event at t = {:.12g} s, {:.3g} s from any that there is", t, nearest(instants, t)));
      }
    } catch (const std::runtime_error& refused) {
      FAIL_CHECK(fmt::format("at accuracy {:g}: {}", accuracy, refused.what()));
    }
  }
}

namespace {

void check_within(const RunTable& rows, const std::string& column, double value, double since, double until,
                  double rounding) {
  const std::vector<double>& x = rows[column];
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double t = rows.time()[row];
    if (t < since || t > until || std::abs(x[row] - value) <= rounding) continue;
    FAIL_CHECK(fmt::format("{} at t = {:.9g} s is {:.17g}, not {:.17g}", column, t, x[row], value));
    return;
  }
}

}  // namespace

void check_exactly(const RunTable& rows, const std::string& column, double value, double since, double until) {
  check_within(rows, column, value, since, until, 0);
}

double check_constant(const RunTable& rows, const std::string& column, double since, double rounding) {
  const auto first = std::lower_bound(rows.time().begin(), rows.time().end(), since) - rows.time().begin();
  REQUIRE_LT(std::size_t(first) + 1, rows.time().size());
  const double value = rows[column][std::size_t(first)];
  check_within(rows, column, value, since, HUGE_VAL, rounding);
  return value;
}

Outcome outcome(const std::string& toml, double accuracy) {
  Outcome result;
  result.rows = simulate(scene_of(toml, accuracy), &result.summary);
  return result;
}

int notes_naming(const Summary& summary, const std::vector<std::string>& names) {
  return int(std::count_if(summary.notes.begin(), summary.notes.end(), [&](const std::string& note) {
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return note.find("`" + name + "`") != std::string::npos; });
  }));
}

void check_account(const std::string& toml, const Account& exact) {
  INFO(toml);
  const double scale = std::max({std::abs(exact.supplied), std::abs(exact.stored), exact.dissipated});
  REQUIRE_LE(std::abs(exact.supplied - exact.stored - exact.dissipated), 1e-12 * scale);
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const Summary summary = outcome(toml, accuracy).summary;
    CHECK_LE(std::abs(summary.supplied - exact.supplied), 10 * accuracy * scale);
    CHECK_LE(std::abs(summary.stored - exact.stored), 10 * accuracy * scale);
    CHECK_LE(std::abs(summary.dissipated - exact.dissipated), 10 * accuracy * scale);
    CHECK_LE(std::abs(summary.missing), 10 * accuracy * summary.largest);
  }
}

}  // namespace rheonet::test
