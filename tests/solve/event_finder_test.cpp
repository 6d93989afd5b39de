// Functions of time alone, whose zeros are known.
#include "core/solve/event_finder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace rheonet::test::event_finder_test {

namespace {

using Function = std::function<double(double)>;

class Functions : public EventFunctions {
 public:
  explicit Functions(std::vector<Function> functions) : functions_(std::move(functions)) {}
  int count() const override { return static_cast<int>(functions_.size()); }
  void evaluate(double t, const double*, const double*, double* g) override {
    ++looks;
    for (std::size_t k = 0; k < functions_.size(); ++k) g[k] = functions_[k](t);
  }
  int looks = 0;

 private:
  std::vector<Function> functions_;
};

struct Found {
  std::optional<double> time;
  std::vector<int> fired;
  int looks;
};

Found find(std::vector<Function> of_time, double begin, double end, bool long_step) {
  Functions functions(std::move(of_time));
  EventFinder finder(functions, true, [&](double t, std::vector<double>& g) { functions.evaluate(t, nullptr, nullptr, g.data()); });
  functions.evaluate(begin, nullptr, nullptr, finder.at_begin().data());
  const std::optional<double> time = long_step ? finder.in_long_step(begin, end) : finder.in_step(begin, end);
  return {time, finder.fired(), functions.looks};
}

constexpr double zero = 1.2345678, least = 1e-14;

/// Hardly above 0 up to the zero, then falls.
Function rests_then(Function beyond) {
  return [=](double t) { return t < zero ? least : -beyond(t - zero); };
}

}  // namespace

TEST_CASE("an event is found just behind its zero, whatever the function is like before and after") {
  const Function linear = [](double t) { return 3.7 * t; }, bent = [](double t) { return 3.7 * t + 21 * t * t; },
                 flattening = [](double t) { return 1 - std::exp(-31 * t); }, tangent = [](double t) { return t * t; }, jump = [](double) { return 0.3; };
  struct Case { const char* name; Function function; int most; };
  for (const Case& one : {Case{"line", [](double t) { return zero - t; }, 6}, Case{"curve", [](double t) { return std::exp(zero - t) - 1; }, 12},
                          Case{"rests, then a line", rests_then(linear), 14}, Case{"rests, then faster and faster", rests_then(bent), 30},
                          Case{"rests, then slower and slower", rests_then(flattening), 50}, Case{"rests, then a parabola", rests_then(tangent), 70},
                          Case{"jumps", rests_then(jump), 90}}) {
    for (const bool long_step : {false, true}) {
      CAPTURE(one.name);
      CAPTURE(long_step);
      const Found found = find({one.function}, 1.1, 1.9, long_step);
      REQUIRE(found.time);
      CHECK(*found.time >= zero);
      CHECK(*found.time <= zero + (std::string(one.name).ends_with("parabola") ? 1e-7 : 1e-12));
      CHECK(found.fired == std::vector<int>{1});
      CHECK(found.looks <= one.most + (long_step ? 5 : 0));
    }
  }
}

TEST_CASE("of many functions the first to fall is found, whichever falls farther") {
  for (const bool long_step : {false, true}) {
    CAPTURE(long_step);
    std::vector<Function> functions;
    for (int k = 0; k < 40; ++k) functions.push_back([k](double t) { return t < zero + 0.003 * k ? least * (1 + k) : -(1 + k % 7) * (t - zero - 0.003 * k); });
    const Found found = find(functions, 1.1, 1.9, long_step);
    REQUIRE(found.time);
    CHECK(*found.time >= zero);
    CHECK(*found.time <= zero + 1e-12);
    CHECK(found.fired[0] == 1);
    CHECK(found.looks <= 30);
  }
}

TEST_CASE("a fall and rise within a long step is found, before another event but not behind it") {
  const auto dips_at = [](double place) { return Function([=](double t) { return (t - place) * (t - place) - 1e-8; }); };
  const Function falls = [](double t) { return zero - t; };
  for (const double place : {1.17, 1.231}) {
    const Found before = find({dips_at(place), falls}, 1.1, 1.9, true);
    REQUIRE(before.time);
    CHECK(std::abs(*before.time - (place - 1e-4)) <= 1e-12);
    CHECK(before.fired == std::vector<int>{1, 0});
  }
  // Just before the event, and nearer to a place at which the function is guessed behind it.
  for (const double share : {0.43, 0.46, 0.48, 0.49}) {
    const double place = 1.1 + 0.8 * share;
    const Found close = find({dips_at(place), [=](double t) { return place + 0.0032 - t; }}, 1.1, 1.9, true);
    REQUIRE(close.time);
    CHECK(std::abs(*close.time - (place - 1e-4)) <= 1e-12);
    CHECK(close.fired == std::vector<int>{1, 0});
  }
  const Found behind = find({dips_at(1.5), falls}, 1.1, 1.9, true), alone = find({falls}, 1.1, 1.9, true);
  REQUIRE(behind.time);
  CHECK(std::abs(*behind.time - zero) <= 1e-12);
  CHECK(behind.fired == std::vector<int>{0, 1});
  // Nothing is looked for behind the event.
  CHECK(behind.looks <= alone.looks + 12);
  // The event comes at once: there is no room for a dip before it.
  const Found at_once = find({dips_at(1.5), [](double t) { return 1.1000001 - t; }}, 1.1, 1.9, true);
  REQUIRE(at_once.time);
  CHECK(std::abs(*at_once.time - 1.1000001) <= 1e-12);
}

}  // namespace rheonet::test::event_finder_test
