#include "core/solve/vectors.hpp"

#include <doctest/doctest.h>
#include <nvector/nvector_serial.h>

#include <cmath>
#include <functional>
#include <vector>

namespace rheonet::test::vectors_test {

namespace {

/// A few vectors of one length, with values that differ.
class Vectors {
 public:
  Vectors(sunindextype length, bool quick) {
    REQUIRE(SUNContext_Create(nullptr, &context_) == 0);
    N_Vector first = N_VNew_Serial(length, context_);
    if (quick) quicken(first);
    vectors_.push_back(first);
    for (int k = 1; k < 8; ++k) vectors_.push_back(N_VClone(first));
    for (std::size_t k = 0; k < vectors_.size(); ++k) {
      for (sunindextype i = 0; i < length; ++i) NV_Ith_S(vectors_[k], i) = std::sin(static_cast<double>(1 + i) * (1.3 + static_cast<double>(k)));
    }
  }
  ~Vectors() {
    for (N_Vector v : vectors_) N_VDestroy(v);
    SUNContext_Free(&context_);
  }
  Vectors(const Vectors&) = delete;
  Vectors& operator=(const Vectors&) = delete;

  N_Vector operator[](std::size_t k) const { return vectors_[k]; }
  N_Vector* from(std::size_t k) { return &vectors_[k]; }
  double value(std::size_t k, sunindextype i) const { return NV_Ith_S(vectors_[k], i); }
  std::size_t count() const { return vectors_.size(); }

 private:
  SUNContext context_ = nullptr;
  std::vector<N_Vector> vectors_;
};

/// Checks that `operation` gives the same result for our vectors as for those of SUNDIALS.
void compare(const std::function<double(Vectors&)>& operation) {
  // Below, at and above the length of a block.
  for (const sunindextype length : {1, 2, 3, 63, 64, 65, 200}) {
    CAPTURE(length);
    Vectors ours(length, true), theirs(length, false);
    CHECK(operation(ours) == doctest::Approx(operation(theirs)).epsilon(1e-14));
    for (std::size_t k = 0; k < ours.count(); ++k) {
      for (sunindextype i = 0; i < length; ++i) CHECK(std::abs(ours.value(k, i) - theirs.value(k, i)) < 1e-14);
    }
  }
}

}  // namespace

TEST_CASE("sums and multiples of vectors are those of SUNDIALS, into a third one and in place") {
  for (const double a : {1.0, -1.0, 0.0, 2.7}) {
    for (const double b : {1.0, -1.0, a, -a, 0.3}) {
      CAPTURE(a);
      CAPTURE(b);
      compare([&](Vectors& v) { return N_VLinearSum(a, v[0], b, v[1], v[2]), 0.0; });
      compare([&](Vectors& v) { return N_VLinearSum(a, v[0], b, v[1], v[0]), 0.0; });
      compare([&](Vectors& v) { return N_VLinearSum(a, v[0], b, v[1], v[1]), 0.0; });
    }
    compare([&](Vectors& v) { return N_VScale(a, v[0], v[2]), 0.0; });
    compare([&](Vectors& v) { return N_VScale(a, v[0], v[0]), 0.0; });
    compare([&](Vectors& v) { return N_VConst(a, v[3]), 0.0; });
  }
}

TEST_CASE("norms of vectors are those of SUNDIALS") {
  compare([](Vectors& v) { return N_VWrmsNorm(v[0], v[1]); });
  compare([](Vectors& v) { return N_VWrmsNormMask(v[0], v[1], v[2]); });
}

TEST_CASE("operations on several vectors are those of SUNDIALS, one after the other") {
  std::vector<double> c{0.4, 1, -1.7, 3, 0.2};
  for (const int count : {1, 2, 5}) {
    CAPTURE(count);
    compare([&](Vectors& v) { return N_VLinearCombination(count, c.data(), v.from(1), v[0]); });
    compare([&](Vectors& v) { return N_VLinearCombination(count, c.data(), v.from(1), v[1]); });
    compare([&](Vectors& v) { return N_VScaleVectorArray(count, c.data(), v.from(1), v.from(1)); });
    // Each result is an operand of the next.
    compare([&](Vectors& v) { return N_VLinearSumVectorArray(count, 1, v.from(2), 1, v.from(1), v.from(1)); });
    compare([&](Vectors& v) { return N_VLinearSumVectorArray(count, 1, v.from(1), -0.6, v.from(2), v.from(2)); });
  }
}

}  // namespace rheonet::test::vectors_test
