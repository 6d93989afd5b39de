#include "core/dae/consistency.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

namespace rheonet {

namespace {

constexpr int dense_limit = 40;  // above this many unknowns sparse elimination wins
std::size_t at(int i) { return static_cast<std::size_t>(i); }
int sign_of(double x) { return x < 0 ? -1 : x > 0 ? 1 : 0; }

}  // namespace

struct Consistency::Factor {
  bool dense = true;
  Eigen::MatrixXd matrix;
  Eigen::FullPivLU<Eigen::MatrixXd> lu;
  Eigen::SparseMatrix<double> sparse;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> sparse_lu;
  bool analysed = false;
  Eigen::VectorXd row_scale;
};

Consistency::Consistency(Dae& dae) : dae_(dae), factor_(std::make_unique<Factor>()) {
  const std::size_t n = at(dae.size());
  values_.resize(at(dae.pattern().entries()));
  r0_.resize(n);
  r1_.resize(n);
  work_.resize(n);
  zero_.assign(n, 0);
  factor_->dense = dae.size() <= dense_limit;
  factor_->row_scale.resize(dae.size());
}

Consistency::~Consistency() = default;

/// Rows hold newtons or metres a second: each is divided by its largest entry, so that pivots can be compared.
void Consistency::factorise(double t, const std::vector<double>& y) {
  const Pattern& pattern = dae_.pattern();
  const int n = dae_.size();
  dae_.consistency_matrix(t, y.data(), values_.data());
  Factor& f = *factor_;
  f.row_scale.setZero();
  for (std::size_t e = 0; e < values_.size(); ++e) {
    double& s = f.row_scale[pattern.row[e]];
    s = std::max(s, std::abs(values_[e]));
  }
  for (int r = 0; r < n; ++r) {
    if (!(f.row_scale[r] > 0) || !std::isfinite(f.row_scale[r])) report_singular(t);
    f.row_scale[r] = 1 / f.row_scale[r];
  }
  if (f.dense) {
    f.matrix.setZero(n, n);
    for (int c = 0; c < n; ++c) {
      for (int e = pattern.column_start[at(c)]; e < pattern.column_start[at(c) + 1]; ++e) {
        const int r = pattern.row[at(e)];
        f.matrix(r, c) = values_[at(e)] * f.row_scale[r];
      }
    }
    f.lu.setThreshold(1e-290);  // only an exact zero is singular: stiffness ratios of 1e12 are not
    f.lu.compute(f.matrix);
    if (!f.lu.isInvertible()) report_singular(t);
    return;
  }
  if (!f.analysed) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int c = 0; c < n; ++c) {
      for (int e = pattern.column_start[at(c)]; e < pattern.column_start[at(c) + 1]; ++e) {
        entries.emplace_back(pattern.row[at(e)], c, 1.0);
      }
    }
    f.sparse.resize(n, n);
    f.sparse.setFromTriplets(entries.begin(), entries.end());
    f.sparse.makeCompressed();
    f.sparse_lu.analyzePattern(f.sparse);
    f.analysed = true;
  }
  for (std::size_t e = 0; e < values_.size(); ++e) f.sparse.valuePtr()[e] = values_[e] * f.row_scale[pattern.row[e]];
  f.sparse_lu.factorize(f.sparse);
  if (f.sparse_lu.info() != Eigen::Success) report_singular(t);
}

void Consistency::solve(std::vector<double>& b) {
  Eigen::Map<Eigen::VectorXd> x(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::VectorXd scaled = x.cwiseProduct(factor_->row_scale);
  if (factor_->dense) {
    x = factor_->lu.solve(scaled);
  } else {
    x = factor_->sparse_lu.solve(scaled);
  }
}

void Consistency::report_singular(double t) const {
  const Network& network = dae_.network();
  const Structure& structure = dae_.structure();
  std::string nodes;
  for (std::size_t n = 0; n < structure.kind.size(); ++n) {
    if (structure.kind[n] != Kind::floating && structure.kind[n] != Kind::viscous) continue;
    if (nodes.size() > 100) {
      nodes += ", ...";
      break;
    }
    nodes += fmt::format("{}`{}`", nodes.empty() ? "" : ", ", network.node_name(static_cast<NodeId>(n)));
  }
  throw SimulationError(
      fmt::format("at t = {:.6g} s nothing determines the motion of a massless node (one of {}): every element there has "
                  "come to a constant force; give the node a mass, a dashpot or a spring",
                  t, nodes.empty() ? "none" : nodes));
}

void Consistency::derivative(double t, const std::vector<double>& y, std::vector<double>& yp) {
  factorise(t, y);
  dae_.time_derivative(r1_.data());
  dae_.residual(t, y.data(), zero_.data(), r0_.data());
  yp.resize(y.size());
  for (int i = 0; i < dae_.size(); ++i) yp[at(i)] = -(dae_.differential(i) ? r0_[at(i)] : r1_[at(i)]);
  solve(yp);
  for (double x : yp) {
    if (!std::isfinite(x)) report_singular(t);
  }
}

void Consistency::second_derivative(double t, double dt, const std::vector<double>& y, const std::vector<double>& yp,
                                    std::vector<double>& ypp) {
  std::vector<double> ahead(y);
  for (std::size_t i = 0; i < y.size(); ++i) ahead[i] += dt * yp[i];
  derivative(t + dt, ahead, ypp);
  for (std::size_t i = 0; i < y.size(); ++i) ypp[i] = (ypp[i] - yp[i]) / dt;
}

/// A few steps of power iteration with y' as a function of y. Two steps of it are compared, each unknown with itself, as
/// that is free of units: an oscillator turns displacement into velocity and back.
double Consistency::fastest_rate(double t, const std::vector<double>& y, const std::vector<double>& yp) {
  constexpr int steps = 6;
  const std::size_t n = y.size();
  std::vector<double> u(yp), next, moved(n), before(n, 0);
  const auto largest = [](const std::vector<double>& x) {
    double m = 0;
    for (double v : x) m = std::max(m, std::abs(v));
    return m;
  };
  double rate = 0;
  for (int k = 0; k < steps; ++k) {
    const double size = largest(u);
    if (size == 0) break;
    // A change this small keeps to the branch of every law, and its effect is far above rounding.
    const double step = 1e-7 * (largest(y) > 0 ? largest(y) : 1) / size;
    for (std::size_t i = 0; i < n; ++i) moved[i] = y[i] + step * u[i];
    derivative(t, moved, next);
    for (std::size_t i = 0; i < n; ++i) next[i] = (next[i] - yp[i]) / step;
    for (std::size_t i = 0; i < n && k > 0; ++i) {
      if (std::abs(before[i]) > 1e-3 * largest(before)) rate = std::max(rate, std::sqrt(std::abs(next[i] / before[i])));
    }
    before = u;
    u = next;
  }
  return rate;
}

/// A branch between two masses cannot be held still by its force at once: that takes an impulse.
bool Consistency::can_stand(int branch) const {
  const Branch& b = dae_.network().deflections[at(branch)];
  const auto massless = [&](NodeId node) {
    const Kind kind = dae_.structure().kind[at(node)];
    return kind == Kind::floating || kind == Kind::viscous;
  };
  return massless(b.a) || massless(b.b);
}

std::vector<int> Consistency::settle(double t, double dt, const std::vector<double>& y, std::vector<double>& yp) {
  std::vector<int> changed;
  derivative(t, y, yp);
  const Network& network = dae_.network();
  std::vector<int> watched;
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->events(i) > 0) watched.push_back(laws.first + static_cast<int>(i));
    }
  }
  if (watched.empty()) return changed;
  std::vector<double> ypp, ahead(y), ahead_p(yp);
  std::vector<int> turns(network.deflections.size(), 0);
  // Directions depend on each other through massless nodes. Two sweeps turn all that do not fit; after that one at a time
  // is turned, and one that turns back and forth is held still by both directions.
  const int sweeps = 10 + 4 * static_cast<int>(watched.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    second_derivative(t, dt, y, yp, ypp);
    for (std::size_t k = 0; k < y.size(); ++k) {
      ahead[k] = y[k] + dt * (yp[k] + dt / 2 * ypp[k]);
      ahead_p[k] = yp[k] + dt * ypp[k];
    }
    const std::vector<double> w = dae_.view(t + dt, ahead.data(), ahead_p.data()).flow;
    const Dae::View& now = dae_.view(t, y.data(), yp.data());
    double fastest = 0;
    for (double flow : w) fastest = std::max(fastest, std::abs(flow));
    // What is held still moves by rounding only: that is no direction.
    const double rounding = 1e-12 * fastest;
    std::vector<int> wrong;
    for (int j : watched) {
      std::size_t i = 0;
      const DeflectionBatch& batch = dae_.batch_of(j, i);
      if (batch.holds(i) || (w[at(j)] == 0) != (now.flow[at(j)] == 0)) continue;
      if (fastest > 0 && std::abs(w[at(j)]) <= rounding) continue;
      if (!batch.fits(i, w[at(j)])) wrong.push_back(j);
    }
    const auto turn = [&](int j) {
      std::size_t i = 0;
      dae_.batch_of(j, i).set_direction(i, now.p[at(j)], w[at(j)], sign_of(w[at(j)]));
      if (std::find(changed.begin(), changed.end(), j) == changed.end()) changed.push_back(j);
    };
    if (sweep < 2) {
      for (int j : wrong) turn(j);
    } else if (!wrong.empty()) {
      const int j = *std::max_element(wrong.begin(), wrong.end(),
                                      [&](int k, int l) { return std::abs(w[at(k)]) < std::abs(w[at(l)]); });
      turn(j);
      if (++turns[at(j)] >= 2 && can_stand(j)) dae_.hold_bundle(j);
    }
    const bool again = !wrong.empty();
    if (!again) break;
    dae_.update_holds();
    derivative(t, y, yp);
  }
  return changed;
}

}  // namespace rheonet
