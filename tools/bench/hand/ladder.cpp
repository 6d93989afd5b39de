// A chain of masses joined by springs and dashpots, pushed at the free end: position and velocity of each mass, KLU.

#include "tools/bench/hand/ida.hpp"

namespace rheonet::hand {
namespace {

constexpr double m = 1e-3, k = 1e3, c = 1, push = 1;

/// Mass 0 is pushed, the last one is held by ground. Unknowns: x of mass i is 2i, v is 2i + 1.
int residual(double, N_Vector y, N_Vector yp, N_Vector r, void* count) {
  const long n = *static_cast<int*>(count);
  const double *Y = N_VGetArrayPointer(y), *P = N_VGetArrayPointer(yp);
  double* R = N_VGetArrayPointer(r);
  double before = push;  // the force from the side of the pushed end
  for (long i = 0; i < 2 * n; i += 2) {
    const bool last = i + 2 == 2 * n;
    const double f = k * (Y[i] - (last ? 0 : Y[i + 2])) + c * (Y[i + 1] - (last ? 0 : Y[i + 3]));
    R[i] = P[i] - Y[i + 1];
    R[i + 1] = m * P[i + 1] - before + f;
    before = f;
  }
  return 0;
}

int jacobian(double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void* count, N_Vector, N_Vector, N_Vector) {
  const long n = *static_cast<int*>(count);
  sunindextype *columns = SUNSparseMatrix_IndexPointers(J), *rows = SUNSparseMatrix_IndexValues(J), entry = 0;
  double* values = SUNSparseMatrix_Data(J);
  const auto put = [&](sunindextype row, double value) {
    rows[entry] = row;
    values[entry++] = value;
  };
  for (long i = 0; i < 2 * n; i += 2) {
    const double sides = i == 0 ? 1 : 2;
    for (const bool velocity : {false, true}) {
      const double g = velocity ? c : k;
      columns[velocity ? i + 1 : i] = entry;
      if (i > 0) put(i - 1, -g);
      put(i, velocity ? -1 : cj);
      put(i + 1, sides * g + (velocity ? m * cj : 0));
      if (i + 2 < 2 * n) put(i + 3, -g);
    }
  }
  columns[2 * n] = entry;
  return 0;
}

}  // namespace

Run ladder(int masses, double tolerance, const std::vector<double>& times) {
  Ida ida(2 * masses, 8 * masses, residual, jacobian, tolerance, 1e-2 * tolerance);
  Ida::check(IDASetUserData(ida.memory, &masses), "IDASetUserData");
  Ida::check(IDASetInitStep(ida.memory, 1e-9), "IDASetInitStep");
  ida.P()[1] = push / m;
  Ida::check(IDAReInit(ida.memory, 0, ida.y, ida.yp), "IDAReInit");
  return follow(ida, times, [&](double, const double* y) { return std::vector{y[0], y[1], k * (y[0] - (masses > 1 ? y[2] : 0))}; });
}

}  // namespace rheonet::hand
