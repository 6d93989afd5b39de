#include "core/solve/vectors.hpp"

#include <nvector/nvector_serial.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

using Values = Eigen::Map<Eigen::ArrayXd>;

Values of(N_Vector v) { return {NV_DATA_S(v), static_cast<Eigen::Index>(NV_LENGTH_S(v))}; }

// In each of these operations the result may be one of the operands.

void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const sunindextype length = NV_LENGTH_S(z);
  if (length <= numerics::plain_loop_limit)
    for (sunindextype i = 0; i < length; ++i) NV_DATA_S(z)[i] = a * NV_DATA_S(x)[i] + b * NV_DATA_S(y)[i];
  else if (a == 1 && b == 1)
    of(z) = of(x) + of(y);
  else
    of(z) = a * of(x) + b * of(y);
}

void scale(realtype c, N_Vector x, N_Vector z) {
  if (c == 1)
    std::copy_n(NV_DATA_S(x), NV_LENGTH_S(x), NV_DATA_S(z));
  else
    of(z) = c * of(x);
}

void fill(realtype c, N_Vector z) { of(z).setConstant(c); }

realtype norm_of_few(N_Vector x, N_Vector weight) {
  double sum = 0;
  for (sunindextype i = 0; i < NV_LENGTH_S(x); ++i) {
    const double term = NV_DATA_S(x)[i] * NV_DATA_S(weight)[i];
    sum += term * term;
  }
  return std::sqrt(sum / static_cast<double>(NV_LENGTH_S(x)));
}

realtype norm(N_Vector x, N_Vector weight) {
  if (NV_LENGTH_S(x) <= numerics::plain_loop_limit) return norm_of_few(x, weight);
  return std::sqrt((of(x) * of(weight)).square().sum() / static_cast<double>(NV_LENGTH_S(x)));
}

/// Norm of the elements whose `id` is positive; the mean is over all elements.
realtype norm_of_masked(N_Vector x, N_Vector weight, N_Vector id) {
  const double *value = NV_DATA_S(x), *w = NV_DATA_S(weight), *counts = NV_DATA_S(id);
  double sum = 0;
  for (sunindextype i = 0; i < NV_LENGTH_S(x); ++i) {
    if (counts[i] > 0) sum += (value[i] * w[i]) * (value[i] * w[i]);
  }
  return std::sqrt(sum / static_cast<double>(NV_LENGTH_S(x)));
}

/// Works in blocks, so that the sums stay in the cache.
int linear_combination(int count, realtype* c, N_Vector* x, N_Vector z) {
  constexpr sunindextype block = 64;
  std::array<double, block> sum;
  const sunindextype length = NV_LENGTH_S(z);
  if (length <= numerics::plain_loop_limit) {
    for (sunindextype i = 0; i < length; ++i) {
      double term = c[0] * NV_DATA_S(x[0])[i];
      for (int k = 1; k < count; ++k) term += c[k] * NV_DATA_S(x[k])[i];
      NV_DATA_S(z)[i] = term;
    }
    return 0;
  }
  for (sunindextype begin = 0; begin < length; begin += block) {
    const sunindextype n = std::min(block, length - begin);
    for (sunindextype i = 0; i < n; ++i) sum[static_cast<std::size_t>(i)] = c[0] * NV_DATA_S(x[0])[begin + i];
    for (int k = 1; k < count; ++k) {
      const double* term = NV_DATA_S(x[k]) + begin;
      for (sunindextype i = 0; i < n; ++i) sum[static_cast<std::size_t>(i)] += c[k] * term[i];
    }
    std::copy_n(sum.data(), n, NV_DATA_S(z) + begin);
  }
  return 0;
}

// One after the other: a result may be an operand of the next.

int linear_sums(int count, realtype a, N_Vector* x, realtype b, N_Vector* y, N_Vector* z) {
  for (int k = 0; k < count; ++k) linear_sum(a, x[k], b, y[k], z[k]);
  return 0;
}

int scales(int count, realtype* c, N_Vector* x, N_Vector* z) {
  for (int k = 0; k < count; ++k) scale(c[k], x[k], z[k]);
  return 0;
}

}  // namespace

void quicken(N_Vector vector) {
  N_Vector_Ops ops = vector->ops;
  ops->nvlinearsum = linear_sum;
  ops->nvscale = scale;
  ops->nvconst = fill;
  ops->nvwrmsnorm = norm;
  ops->nvwrmsnormmask = norm_of_masked;
  ops->nvlinearcombination = linear_combination;
  ops->nvlinearsumvectorarray = linear_sums;
  ops->nvscalevectorarray = scales;
}

}  // namespace rheonet
