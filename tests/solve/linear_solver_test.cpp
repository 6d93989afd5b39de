#include "core/solve/linear_solver.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace rheonet::test::linear_solver_test {

// As friction goes on at its bound its slope falls towards 0, by any number of digits, and stays an entry of the matrix.
TEST_CASE("a pivot that has become a small one costs no digits") {
  const Pattern pattern{.size = 2, .column_start = {0, 2, 4}, .row = {0, 1, 0, 1}};
  const std::vector<double> tolerance{1, 1};
  for (const bool sparse : {true, false}) {
    CAPTURE(sparse);
    LinearSolver linear(pattern, sparse, tolerance);
    for (const double pivot : {1e3, 1.0, 1e-2, 1e-4, 1e-5, 1e-6, 1e-8, 1e-12, 1e-20, 0.0, 1e3}) {
      CAPTURE(pivot);
      const double first = 0.7, second = -1.3;
      const std::vector<double> values{pivot, 2, 3, pivot};  // by columns
      std::copy(values.begin(), values.end(), linear.entries());
      REQUIRE(linear.factorise());
      std::vector<double> x{pivot * first + 3 * second, 2 * first + pivot * second};
      linear.solve(x.data());
      CHECK(x[0] == doctest::Approx(first).epsilon(1e-13));
      CHECK(x[1] == doctest::Approx(second).epsilon(1e-13));
    }
  }
}

}  // namespace rheonet::test::linear_solver_test
