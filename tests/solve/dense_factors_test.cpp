#include "core/solve/dense_factors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rheonet::test::dense_factors_test {

TEST_CASE("a dense matrix in factors gives back what it was multiplied with, whatever the order of its pivots") {
  for (const int n : {1, 2, 3, 4, 9}) {
    CAPTURE(n);
    const std::size_t size = static_cast<std::size_t>(n);
    DenseFactors factors(n);
    std::vector<double> matrix(size * size), x(size), right(size, 0);
    for (std::size_t k = 0; k < matrix.size(); ++k) matrix[k] = std::sin(3.1 * static_cast<double>(k + 1));
    // Nothing on the diagonal but in the middle: rows have to be exchanged.
    for (std::size_t k = 0; k < size && n > 1; ++k) matrix[k * size + k] = k == size / 2 ? 0.1 : 0;
    for (std::size_t k = 0; k < size; ++k) x[k] = 1.5 - static_cast<double>(k);
    for (std::size_t column = 0; column < size; ++column) {
      for (std::size_t row = 0; row < size; ++row) right[row] += matrix[column * size + row] * x[column];
    }
    std::copy(matrix.begin(), matrix.end(), factors.matrix());
    REQUIRE(factors.factorise());
    factors.solve(right.data());
    for (std::size_t k = 0; k < size; ++k) CHECK(right[k] == doctest::Approx(x[k]).epsilon(1e-12));
  }
}

TEST_CASE("a singular matrix has no factors, one next to it does") {
  DenseFactors factors(2);
  for (const double off : {0.0, 1e-9, 0.0}) {
    CAPTURE(off);
    const std::vector<double> matrix{2, 4, 1, 2 + off};  // by columns
    std::copy(matrix.begin(), matrix.end(), factors.matrix());
    CHECK(factors.factorise() == (off != 0));
  }
}

}  // namespace rheonet::test::dense_factors_test
