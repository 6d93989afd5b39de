#include "tools/plot/ticks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace rheonet::test::ticks_test {

using namespace rheonet::plot;

namespace {

std::string labels(const std::vector<Tick>& ticks) {
  std::string text;
  for (const Tick& tick : ticks) text += (text.empty() ? "" : " ") + (tick.label.empty() ? "." : tick.label);
  return text;
}

}  // namespace

TEST_CASE("ticks of a linear axis are at round numbers, on both sides of 0, and not beyond its ends") {
  CHECK(labels(linear_ticks(-150, 150, 5)) == "-150 -100 -50 0 50 100 150");
  CHECK(labels(linear_ticks(-149.9, 149.9, 5)) == "-100 -50 0 50 100");
  CHECK(labels(linear_ticks(0, 0.2, 8)) == "0 0.02 0.04 0.06 0.08 0.10 0.12 0.14 0.16 0.18 0.20");
  CHECK(labels(linear_ticks(0, 0.2, 7)) == "0 0.05 0.10 0.15 0.20");
  CHECK(labels(linear_ticks(-7.3, -2.1, 5)) == "-7 -6 -5 -4 -3");
  CHECK(labels(linear_ticks(1000, 1000.5, 4)) == "1000.0 1000.1 1000.2 1000.3 1000.4 1000.5");
}

TEST_CASE("numbers of many digits are powers of ten") {
  CHECK(labels(linear_ticks(0, 99'999, 3)) == "0 20000 40000 60000 80000");
  CHECK(labels(linear_ticks(0, 100'000, 4)) == "0 2·10^4 4·10^4 6·10^4 8·10^4 10·10^4");
  CHECK(labels(linear_ticks(-2e-5, 2e-5, 3)) == "-0.00002 -0.00001 0 0.00001 0.00002");
  CHECK(labels(linear_ticks(-2e-6, 2e-6, 3)) == "-2·10^-6 -10^-6 0 10^-6 2·10^-6");
  // All along an axis the same power.
  CHECK(labels(linear_ticks(8e-7, 1.6e-6, 4)) == "0.8·10^-6 1.0·10^-6 1.2·10^-6 1.4·10^-6 1.6·10^-6");
}

TEST_CASE("any range has ticks: 1, 2 or 5 times a power of ten apart, at least three, and not too many") {
  for (int k = 0; k < 2000; ++k) {
    const double width = std::pow(10.0, -8 + 0.008 * k), low = (k % 7 - 3) * 0.37 * width;
    const int wanted = 3 + k % 8;
    const std::vector<Tick> ticks = linear_ticks(low, low + width, wanted);
    CAPTURE(low);
    CAPTURE(width);
    REQUIRE(ticks.size() >= 2);
    CHECK(static_cast<double>(ticks.size()) <= 1.4 * wanted + 1);
    const double step = ticks[1].value - ticks[0].value,
                 digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    CHECK(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}) < 1e-6);
    std::set<std::string> different;
    for (const Tick& tick : ticks) {
      CHECK(tick.value >= low - 1e-5 * step);
      CHECK(tick.value <= low + width + 1e-5 * step);
      different.insert(tick.label);
    }
    CHECK(different.size() == ticks.size());
  }
}

TEST_CASE("ticks of a logarithmic axis are at powers of ten, with small ones between them") {
  CHECK(labels(logarithmic_ticks(0.001, 0.1, 8)) == "0.001 . . . . . . . . 0.01 . . . . . . . . 0.1");
  CHECK(labels(logarithmic_ticks(3e-5, 2e-4, 8)) ==
        "0.00004 0.00006 0.00008 0.00010 0.00012 0.00014 0.00016 0.00018 0.00020");
  CHECK(labels(logarithmic_ticks(3, 99, 8)) == ". . 5 . . . . 10 20 . . 50 . . . .");
  CHECK(labels(logarithmic_ticks(1e-5, 1e7, 4)) == ". 10^-4 . 10^-2 . 1 . 10^2 . 10^4 . 10^6 .");
  CHECK(labels(logarithmic_ticks(1e-4, 9e-3, 8)) == "10^-4 2·10^-4 . . 5·10^-4 . . . . 10^-3 2·10^-3 . . 5·10^-3 . . . .");
  CHECK(labels(logarithmic_ticks(1e-300, 1e300, 4)) == "10^-300 10^-200 10^-100 1 10^100 10^200 10^300");
}

}  // namespace rheonet::test::ticks_test
