#include <fmt/format.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/dae/consistency.hpp"

namespace rheonet {

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
}  // namespace

/// Within an instant a linear dashpot turns a step into the impulse B dx; masses stay where they are; massless nodes
/// between dashpots go where the impulses balance, sum B (dx_a - dx_b) = 0. Laws that know no impulse do not resist.
void Consistency::position_steps(double t, std::vector<double>& dx, std::vector<double>& impulse,
                                 std::vector<std::string>& notes) {
  const Network& network = dae_.network();
  const Structure& structure = dae_.structure();
  dx.assign(structure.kind.size(), 0);
  impulse = dx;
  bool any = false;
  for (std::size_t m = 0; m < network.motions.size(); ++m) {
    dx[at(network.motions[m].node)] = dae_.drive().steps()[m];
    any = any || dae_.drive().steps()[m] != 0;
  }
  if (!any || network.rates.empty()) return;

  std::vector<double> damping(network.rates.size());
  double largest = 0;
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      damping[at(laws.first) + i] = laws.batch->impulse(i);
      if (std::isfinite(laws.batch->impulse(i))) largest = std::max(largest, laws.batch->impulse(i));
    }
  }
  if (largest == 0) largest = 1;
  for (double& b : damping) {  // shear thickening is rigid to a step, shear thinning no resistance
    if (!std::isfinite(b)) b = 1e9 * largest;
    if (b == 0) b = 1e-9 * largest;
  }

  std::vector<int> unknown(structure.kind.size(), -1);
  int n = 0;
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    if (structure.kind[k] == Kind::viscous) unknown[k] = n++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n);
  for (std::size_t r = 0; r < network.rates.size(); ++r) {
    const Branch& b = network.rates[r];
    const double B = damping[r];
    for (const auto& [node, other] : {std::pair{b.a, b.b}, std::pair{b.b, b.a}}) {
      const int row = unknown[at(node)];
      if (row < 0) continue;
      entries.emplace_back(row, row, B);
      if (unknown[at(other)] >= 0) {
        entries.emplace_back(row, unknown[at(other)], -B);
      } else {
        rhs[row] += B * dx[at(other)];
      }
    }
  }
  if (n > 0) {
    Eigen::SparseMatrix<double> laplacian(n, n);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(laplacian).solve(rhs);
    for (std::size_t k = 0; k < unknown.size(); ++k) {
      if (unknown[k] >= 0) dx[k] = x[unknown[k]];
    }
  }
  for (std::size_t r = 0; r < network.rates.size(); ++r) {
    const Branch& b = network.rates[r];
    const double step = dx[at(b.a)] - dx[at(b.b)];
    if (std::abs(step) <= 1e-12 * (std::abs(dx[at(b.a)]) + std::abs(dx[at(b.b)]))) continue;
    impulse[at(b.a)] -= damping[r] * step;
    impulse[at(b.b)] += damping[r] * step;
    notes.push_back(fmt::format(
        "at t = {:.6g} s a step in position moves dashpot `{}` by {:.6g} in no time: its force there is an impulse, which "
        "no row shows and the energy account leaves out",
        t, network.name_of(b), step));
  }
}

/// Solves the algebraic equations for y, with the integrals of the differential ones over the instant: M (y - before) +
/// terms = 0. Newton's method, damped by the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear Problems,
/// 2004, 3.3), which does not depend on the units of the equations.
void Consistency::newton(double t, const std::vector<double>& before, const std::vector<double>& terms,
                         std::vector<double>& y) {
  const std::size_t n = y.size();
  std::vector<double> change(n), trial(n), next(n), scale(n, 0), defect(n);
  const auto defects = [&](const std::vector<double>& at_y) {
    for (std::size_t i = 0; i < n; ++i) work_[i] = at_y[i] - before[i];
    dae_.residual(t, at_y.data(), work_.data(), r1_.data());
    dae_.residual(t, at_y.data(), zero_.data(), r0_.data());
    for (std::size_t i = 0; i < n; ++i) {
      defect[i] = dae_.differential(static_cast<int>(i)) ? r1_[i] - r0_[i] + terms[i] : r0_[i];
    }
  };
  const auto norm = [&](const std::vector<double>& x) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(x[i])) return std::numeric_limits<double>::infinity();
      if (scale[i] > 0) largest = std::max(largest, std::abs(x[i]) / scale[i]);
    }
    return largest;
  };
  double damping = 1;
  for (int iteration = 0; iteration < 500; ++iteration) {
    factorise(t, y);
    defects(y);
    for (std::size_t i = 0; i < n; ++i) change[i] = -defect[i];
    solve(change);
    for (std::size_t i = 0; i < n; ++i) scale[i] = std::max({scale[i], std::abs(y[i]), std::abs(change[i])});
    const double size = norm(change);
    if (!std::isfinite(size)) report_singular(t);
    if (size <= 1e-14) return;
    for (;; damping /= 2) {
      for (std::size_t i = 0; i < n; ++i) trial[i] = y[i] + damping * change[i];
      defects(trial);
      for (std::size_t i = 0; i < n; ++i) next[i] = -defect[i];
      solve(next);
      if (norm(next) <= (1 - damping / 4) * size || norm(next) <= 1e-14) break;
      if (damping < 1e-6) {
        if (size <= 1e-9) return;  // rounding stands in the way of the last digits
        report_singular(t);
      }
    }
    y = trial;
    if (damping == 1 && norm(next) <= 1e-15) return;
    damping = std::min(1.0, 2 * damping);
  }
}

void Consistency::project(double t, std::vector<double>& y) {
  const std::vector<double> before = y, terms(y.size(), 0.0);
  newton(t, before, terms, y);
}

Consistency::Jump Consistency::jump(double t, std::vector<double>& y) {
  Jump result;
  const Network& network = dae_.network();
  const Structure& structure = dae_.structure();
  std::vector<double> dx, impulse, terms(y.size());
  position_steps(t, dx, impulse, result.notes);
  dae_.jump_terms(dx, impulse, terms.data());

  const std::vector<double> before = y;
  std::vector<double> p_before(network.deflections.size());
  const auto floating = [&](const Branch& b) { return structure.group[at(b.a)] >= 0 || structure.group[at(b.b)] >= 0; };
  for (std::size_t j = 0; j < p_before.size(); ++j) {
    std::size_t i = 0;
    DeflectionBatch& batch = dae_.batch_of(static_cast<int>(j), i);
    if (batch.holds(i)) batch.set_direction(i, y[at(dae_.deflection_unknown(static_cast<int>(j)))], 0, 1);
  }
  dae_.update_holds();
  // Driven deflections have already gone along with the drive: their value before is the present one less the step.
  const std::vector<double> p_now = dae_.view(t, y.data(), zero_.data()).p;
  for (std::size_t j = 0; j < p_before.size(); ++j) {
    const Branch& b = network.deflections[j];
    const double step = dx[at(b.a)] - dx[at(b.b)];
    p_before[j] = p_now[j] - (structure.driven[j] ? step : 0);
    std::size_t i = 0;
    if (step != 0 && !floating(b)) result.heat += dae_.batch_of(static_cast<int>(j), i).jump(i, p_before[j], step);
  }

  // Between floating nodes a jump of the deflection comes out of the balance, and its direction decides the law.
  for (int sweep = 0; sweep < 20; ++sweep) {
    y = before;
    dae_.guess_forces(t, y.data());
    newton(t, before, terms, y);
    bool again = false;
    for (std::size_t j = 0; j < p_before.size(); ++j) {
      if (!floating(network.deflections[j])) continue;
      const double p = y[at(dae_.deflection_unknown(static_cast<int>(j)))], step = p - p_before[j];
      if (std::abs(step) <= 1e-12 * (std::abs(p) + std::abs(p_before[j]))) continue;
      std::size_t i = 0;
      DeflectionBatch& batch = dae_.batch_of(static_cast<int>(j), i);
      again = batch.set_direction(i, p_before[j], 0, step < 0 ? -1 : 1) || again;
    }
    if (!again) break;
  }
  for (std::size_t j = 0; j < p_before.size(); ++j) {
    if (!floating(network.deflections[j])) continue;
    const double p = y[at(dae_.deflection_unknown(static_cast<int>(j)))], step = p - p_before[j];
    if (std::abs(step) <= 1e-12 * (std::abs(p) + std::abs(p_before[j]))) continue;
    std::size_t i = 0;
    result.heat += dae_.batch_of(static_cast<int>(j), i).jump(i, p_before[j], step);
  }
  return result;
}

}  // namespace rheonet
