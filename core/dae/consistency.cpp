#include "core/dae/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/unknown_names.hpp"
#include "core/network/adjacent_elements.hpp"

namespace rheonet {

Consistency::Consistency(Dae& dae) : dae_(dae), elimination_(dae.pattern()) {
  const std::size_t n = at(dae.size());
  kind_.assign(n, 0);
  const auto set = [&](int unknown, unsigned char kind) {
    if (unknown >= 0) kind_[at(unknown)] = kind;
  };
  branch_.assign(n, -1);
  for (std::size_t j = 0; j < dae.network().deflections.size(); ++j) {
    const int unknown = dae.indices().deflection[j];
    set(unknown, 1);
    if (unknown >= 0) branch_[at(unknown)] = static_cast<int>(j);
  }
  for (std::size_t r = 0; r < dae.network().rates.size(); ++r) set(dae.indices().force[r], 2);
  for (std::size_t k = 0; k < dae.structure().kind.size(); ++k) set(dae.indices().position[k], 3);
  for (std::size_t k = 0; k < dae.inputs().blocks().states(); ++k) set(dae.indices().block[k], 4);
}

void Consistency::wake() {
  if (!zero_.empty()) return;
  values_.resize(at(dae_.pattern().entries()));
  for (std::vector<double>* work : {&r0_, &r1_, &zero_}) work->assign(at(dae_.size()), 0);
}

void Consistency::rest() {
  elimination_.release();
  for (std::vector<double>* work : {&values_, &r0_, &r1_, &zero_}) std::vector<double>().swap(*work);
}

void Consistency::factorise(double t, const std::vector<double>& y) {
  dae_.consistency_matrix(t, y.data(), values_.data());
  eliminate(t);
}

void Consistency::eliminate(double t) {
  if (!elimination_.factorise(values_)) report_singular(t);
}

double Consistency::collocate(double t, double rate, std::vector<double>& y, std::vector<double>& yp) {
  wake();
  const std::size_t n = y.size();
  std::vector<double> change(n), scale(n, 0);
  double last = 0;
  for (int iteration = 0; iteration < numerics::collocation_iterations; ++iteration) {
    dae_.jacobian(t, rate, y.data(), yp.data(), values_.data());
    // Too close to singular for a better state: the interpolated one stands.
    if (!elimination_.factorise(values_)) break;
    dae_.residual(t, y.data(), yp.data(), r0_.data());
    for (std::size_t i = 0; i < n; ++i) change[i] = -r0_[i];
    elimination_.solve(change);
    double size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      scale[i] = std::max({scale[i], std::abs(y[i]), std::abs(change[i])});
      if (scale[i] > 0) size = std::max(size, std::abs(change[i]) / scale[i]);
    }
    const double damping = iteration > 0 && size > numerics::collocation_slow * last ? numerics::collocation_damping : 1;
    const bool done = size <= numerics::last_digit_ulps * std::numeric_limits<double>::epsilon() ||
                      (iteration > 0 && !dae_.rough() && (size <= numerics::collocation_change || size > last / 2));
    last = size;
    for (std::size_t i = 0; i < n; ++i) {
      y[i] += damping * change[i];
      yp[i] += damping * rate * change[i];
    }
    if (done) break;
  }
  return last;
}

void Consistency::report_singular(double t) {
  const Network& network = dae_.network();
  const Structure& structure = dae_.structure();
  std::vector<NodeId> nodes;
  std::vector<std::string> names;
  for (std::size_t n = 0; n < structure.kind.size(); ++n) {
    if (structure.kind[n] != Kind::floating && structure.kind[n] != Kind::viscous) continue;
    nodes.push_back(static_cast<NodeId>(n));
    names.push_back(network.node_name(nodes.back()));
  }
  if (nodes.empty()) report_unsolved(t);
  throw UndeterminedError(network.spot_of_node(nodes.front()), fmt::format(
      "{} nothing determines the motion of {} {}: every element there has come to a constant force, or the values of {} lie "
      "too far apart for double precision; give the node a mass, a dashpot or a spring",
      at_time(*network.scene, t), nodes.size() > 1 ? "one of the massless nodes" : "massless node", format_list(names),
      format_list(elements_at(network, nodes))));
}

void Consistency::report_unsolved(double t) {
  // The unknown whose equation is the least balanced at the last evaluation.
  dae_.magnitudes(r1_.data());
  int worst = 0;
  double most = -1;
  for (std::size_t i = 0; i < r0_.size(); ++i) {
    const double share = std::abs(r0_[i]) / (r1_[i] > 0 ? r1_[i] : 1);
    if (dae_.differential(static_cast<int>(i)) || !(share > most || std::isnan(share))) continue;
    worst = static_cast<int>(i);
    most = std::isnan(share) ? std::numeric_limits<double>::infinity() : share;
  }
  throw UndeterminedError(UnknownNames(dae_).spot_of(worst), fmt::format(
      "{} no state was found in which the forces balance, least of all for {}: the values of {} may lie too far "
      "apart for double precision; check them",
      at_time(*dae_.network().scene, t), UnknownNames(dae_).describe(worst), UnknownNames(dae_).around(worst)));
}

/// One infinite rate makes the rates that are solved with it infinite: report the first equation that yields one by itself.
/// Equation number i belongs to unknown number i (see Dae): the balance of forces at a node has the number of its velocity.
void Consistency::report_rate(double t, int unknown) {
  for (int equation = 0; equation < dae_.size(); ++equation) {
    const double right = dae_.differential(equation) ? r0_[at(equation)] : r1_[at(equation)];
    if (std::isfinite(elimination_.scaled(equation, right))) continue;
    unknown = equation;
    break;
  }
  throw UndeterminedError(UnknownNames(dae_).spot_of(unknown), fmt::format(
      "{} {} changes at a rate beyond the range of double precision: a force or velocity there is too large, or a mass, "
      "damping or stiffness too small against it; check the values of {}",
      at_time(*dae_.network().scene, t), UnknownNames(dae_).describe(unknown), UnknownNames(dae_).around(unknown)));
}

void Consistency::derivative(double t, const std::vector<double>& y, std::vector<double>& yp) {
  wake();
  factorise(t, y);
  dae_.time_derivative(r1_.data());
  dae_.residual(t, y.data(), zero_.data(), r0_.data());
  yp.resize(y.size());
  for (int i = 0; i < dae_.size(); ++i) yp[at(i)] = -(dae_.differential(i) ? r0_[at(i)] : r1_[at(i)]);
  elimination_.solve(yp);
  const auto wild = std::find_if(yp.begin(), yp.end(), [](double x) { return !std::isfinite(x); });
  if (wild != yp.end()) report_rate(t, static_cast<int>(wild - yp.begin()));
}

void Consistency::second_derivative(double t, double dt, const std::vector<double>& y, const std::vector<double>& yp,
                                    std::vector<double>& ypp) {
  std::vector<double> ahead(y);
  for (std::size_t i = 0; i < y.size(); ++i) ahead[i] += dt * yp[i];
  derivative(t + dt, ahead, ypp);
  for (std::size_t i = 0; i < y.size(); ++i) ypp[i] = (ypp[i] - yp[i]) / dt;
}

/// A few steps of power iteration with y' as a function of y. The growth of each unknown over two steps is free of units (an
/// oscillator turns displacement into velocity and back) and gives the square of a rate. Sizes are compared within each kind.
double Consistency::fastest_rate(double t, double within, const std::vector<double>& y, const std::vector<double>& yp) {
  const std::size_t n = y.size();
  std::vector<double> u(yp), next, moved(n), before(n, 0);
  using Sizes = std::array<double, kinds>;
  const auto largest = [this](const std::vector<double>& x) {
    Sizes m{};
    for (std::size_t i = 0; i < x.size(); ++i) m[kind_[i]] = std::max(m[kind_[i]], std::abs(x[i]));
    return m;
  };
  Sizes there = largest(y);
  const Sizes soon = largest(yp);
  for (std::size_t k = 0; k < kinds; ++k) there[k] = std::max(there[k], within * soon[k]);
  // Deflections that are about to change imply velocities of that rate where there are none yet.
  constexpr std::size_t velocity = 0, deflection = 1, position = 3;
  if (there[velocity] == 0) there[velocity] = std::max(soon[deflection], soon[position]);
  double rate = 0;
  for (int k = 0; k < numerics::power_iterations; ++k) {
    double step = std::numeric_limits<double>::infinity();
    const Sizes size = largest(u);
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      if (size[kind] > 0 && there[kind] > 0) step = std::min(step, numerics::rate_probe * there[kind] / size[kind]);
    }
    if (!std::isfinite(step)) break;
    for (std::size_t i = 0; i < n; ++i) moved[i] = y[i] + step * u[i];
    derivative(t, moved, next);
    for (std::size_t i = 0; i < n; ++i) next[i] = (next[i] - yp[i]) / step;
    const Sizes most = largest(before);
    for (std::size_t i = 0; i < n && k > 0; ++i) {
      if (std::abs(before[i]) <= numerics::rate_probe_floor * most[kind_[i]]) continue;
      rate = std::max(rate, std::sqrt(std::abs(next[i] / before[i])));
    }
    before = u;
    u = next;
  }
  return rate;
}

}  // namespace rheonet
