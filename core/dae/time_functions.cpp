#include "core/dae/time_functions.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/base/numerics.hpp"

namespace rheonet {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TimeFunctions TimeFunctions::within(double interval) const {
  TimeFunctions result{.degree = degree, .omegas = {}};
  for (const double omega : omegas) {
    if (omega * interval > numerics::arc_slow_phase) result.omegas.push_back(omega);
    else result.degree = std::max(result.degree, numerics::arc_slow_terms);
  }
  return result;
}

VectorXd TimeFunctions::at(double tau) const {
  VectorXd values(count());
  values(0) = 1;
  Index k = 1;
  for (; k <= degree; ++k) values(k) = values(k - 1) * tau / static_cast<double>(k);
  for (const double omega : omegas) {
    values(k++) = std::sin(omega * tau);
    values(k++) = std::cos(omega * tau);
  }
  return values;
}

MatrixXd TimeFunctions::shifted(const MatrixXd& c, double by) const {
  MatrixXd moved = c;
  double power = 1;  // by^n/n!
  for (Index n = 1; n <= degree; ++n) {
    power *= by / static_cast<double>(n);
    moved.leftCols(degree + 1 - n) += power * c.middleCols(n, degree + 1 - n);
  }
  Index k = degree + 1;
  for (const double omega : omegas) {
    const double sine = std::sin(omega * by), cosine = std::cos(omega * by);
    moved.col(k) = c.col(k) * cosine - c.col(k + 1) * sine;
    moved.col(k + 1) = c.col(k) * sine + c.col(k + 1) * cosine;
    k += 2;
  }
  return moved;
}

MatrixXd TimeFunctions::derivative(const MatrixXd& c) const {
  MatrixXd rate = MatrixXd::Zero(c.rows(), c.cols());
  for (Index k = 0; k < degree; ++k) rate.col(k) = c.col(k + 1);
  Index k = degree + 1;
  for (const double omega : omegas) {
    rate.col(k) = -omega * c.col(k + 1);
    rate.col(k + 1) = omega * c.col(k);
    k += 2;
  }
  return rate;
}

MatrixXd TimeFunctions::fit(const std::vector<double>& times, const MatrixXd& values, VectorXd& misfit) const {
  const Index varying = count() - 1, samples = static_cast<Index>(times.size()) - 1;
  MatrixXd coefficients = MatrixXd::Zero(values.cols(), count());
  coefficients.col(0) = values.row(0).transpose();
  misfit = VectorXd::Zero(values.cols());
  if (varying == 0) return coefficients;
  MatrixXd basis(samples, varying);
  for (Index s = 0; s < samples; ++s) {
    const double tau = times[static_cast<std::size_t>(s) + 1];
    basis.row(s) = at(tau).tail(varying).transpose();
    // A cosine less its value at the beginning, without the difference of numbers near 1.
    Index k = degree + 1;
    for (const double omega : omegas) {
      const double half = std::sin(omega * tau / 2);
      basis(s, k) = -2 * half * half;
      k += 2;
    }
  }
  const MatrixXd change = values.bottomRows(samples).rowwise() - values.row(0);
  VectorXd scale = basis.cwiseAbs().colwise().maxCoeff().transpose();
  for (double& of : scale) of = of > 0 ? of : 1;
  const MatrixXd scaled = basis * scale.cwiseInverse().asDiagonal();
  const MatrixXd solved = scaled.colPivHouseholderQr().solve(change);
  misfit = (scaled * solved - change).cwiseAbs().colwise().maxCoeff().transpose();
  coefficients.rightCols(varying) = (scale.cwiseInverse().asDiagonal() * solved).transpose();
  for (Index k = degree + 2; k < count(); k += 2) coefficients.col(0) -= coefficients.col(k);
  return coefficients;
}

}  // namespace rheonet
