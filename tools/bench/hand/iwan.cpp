// A driven mass on springs in series with sliders, side by side: position, velocity, and the force of each pair; a root for
// each yield and one for the reversal, and a restart at each.

#include <cmath>
#include <numbers>

#include "tools/bench/hand/ida.hpp"

namespace rheonet::hand {
namespace {

constexpr double m = 1, drive = 8, stiffness = 400, strength = 10;  // of all springs, of all sliders

struct Bundle {
  std::vector<double> k, coulomb;
  std::vector<int> slips;  ///< 0, or the direction
};

const Bundle& of(void* bundle) { return *static_cast<Bundle*>(bundle); }

int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* data) {
  const Bundle& bundle = of(data);
  const double *Y = N_VGetArrayPointer(y), *P = N_VGetArrayPointer(yp);
  double *R = N_VGetArrayPointer(r), held = 0;
  for (std::size_t i = 0; i < bundle.k.size(); ++i) {
    held += Y[2 + i];
    R[2 + i] = bundle.slips[i] != 0 ? P[2 + i] : P[2 + i] - bundle.k[i] * Y[1];
  }
  R[0] = P[0] - Y[1];
  R[1] = m * P[1] + held - drive * std::sin(2 * std::numbers::pi * t);
  return 0;
}

int jacobian(double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
  const Bundle& bundle = of(data);
  const auto n = static_cast<sunindextype>(bundle.k.size());
  sunindextype *columns = SUNSparseMatrix_IndexPointers(J), *rows = SUNSparseMatrix_IndexValues(J), entry = 0;
  double* values = SUNSparseMatrix_Data(J);
  const auto put = [&](sunindextype row, double value) {
    rows[entry] = row;
    values[entry++] = value;
  };
  columns[0] = entry;
  put(0, cj);
  columns[1] = entry;
  put(0, -1);
  put(1, m * cj);
  for (sunindextype i = 0; i < n; ++i) {
    const auto pair = static_cast<std::size_t>(i);
    put(2 + i, bundle.slips[pair] != 0 ? 0 : -bundle.k[pair]);
  }
  for (sunindextype i = 0; i < n; ++i) {
    columns[2 + i] = entry;
    put(1, 1);
    put(2 + i, cj);
  }
  columns[n + 2] = entry;
  return 0;
}

int roots(double, N_Vector y, N_Vector, double* g, void* data) {
  const Bundle& bundle = of(data);
  const double* Y = N_VGetArrayPointer(y);
  const std::size_t n = bundle.k.size();
  for (std::size_t i = 0; i < n; ++i) g[i] = bundle.slips[i] != 0 ? 1 : bundle.coulomb[i] - std::abs(Y[2 + i]);
  g[n] = Y[1];
  return 0;
}

/// After a root: who yields slips at its bound; at a reversal all hold.
void switch_modes(Ida& ida, Bundle& bundle) {
  const std::size_t n = bundle.k.size();
  std::vector<int> found(n + 1);
  Ida::check(IDAGetRootInfo(ida.memory, found.data()), "IDAGetRootInfo");
  double *Y = ida.Y(), *P = ida.P(), held = 0;
  if (found[n] != 0) {
    Y[1] = 0;
    bundle.slips.assign(n, 0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (found[i] != 0) {
      bundle.slips[i] = Y[2 + i] > 0 ? 1 : -1;
      Y[2 + i] = bundle.slips[i] * bundle.coulomb[i];
    }
    held += Y[2 + i];
    P[2 + i] = bundle.slips[i] != 0 ? 0 : bundle.k[i] * Y[1];
  }
  P[0] = Y[1];
  P[1] = (drive * std::sin(2 * std::numbers::pi * ida.t) - held) / m;
  Ida::check(IDAReInit(ida.memory, ida.t, ida.y, ida.yp), "IDAReInit");
  Ida::check(IDASetInitStep(ida.memory, 1e-6), "IDASetInitStep");
}

}  // namespace

Run iwan(int pairs, double tolerance, const std::vector<double>& times) {
  const double n = pairs;
  Bundle bundle;
  for (int i = 0; i < pairs; ++i) {
    bundle.k.push_back(stiffness / n);
    bundle.coulomb.push_back(2 * strength * (i + 0.5) / (n * n));
  }
  bundle.slips.assign(bundle.k.size(), 0);
  Ida ida(2 + pairs, 3 * pairs + 3, residual, jacobian, tolerance, 1e-3 * tolerance);
  Ida::check(IDASetUserData(ida.memory, &bundle), "IDASetUserData");
  Ida::check(IDARootInit(ida.memory, pairs + 1, roots), "IDARootInit");
  Ida::check(IDASetInitStep(ida.memory, 1e-6), "IDASetInitStep");
  const auto row = [](double, const double* y) { return std::vector{y[0]}; };
  return follow(ida, times, row, [&] { switch_modes(ida, bundle); });
}

}  // namespace rheonet::hand
