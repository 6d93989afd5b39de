#include "core/solve/exact_arc.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Nodes of the Chebyshev polynomials are numbered from 0, the beginning of a step, to this, its end.
constexpr int last_node = numerics::arc_nodes;

struct ChebyshevNodes {
  std::array<double, last_node + 1> place;        ///< share of the step
  std::array<double, last_node + 1> barycentric;  ///< weights (J.-P. Berrut and L. N. Trefethen, SIAM Review 46 (2004) 501)
  std::array<double, last_node + 1> last, last_but_one;  ///< a value's share of the coefficients of the two highest polynomials
  ChebyshevNodes() {
    for (int i = 0; i <= last_node; ++i) {
      const bool end = i == 0 || i == last_node;
      const double sign = i % 2 == 0 ? 1 : -1, angle = std::numbers::pi * i / last_node;
      place[at(i)] = i == last_node ? 1 : (1 - std::cos(angle)) / 2;
      barycentric[at(i)] = end ? sign / 2 : sign;
      last[at(i)] = barycentric[at(i)] / last_node;
      last_but_one[at(i)] = barycentric[at(i)] * std::cos(angle) * 2 / last_node;
    }
  }
};

const ChebyshevNodes nodes_of_step;

using NodeShares = Eigen::Matrix<double, last_node + 1, 1>;

/// The functions of time that inputs are made of: 1, tau, tau^2/2, then the sine and the cosine of each frequency.
struct TimeFunctions {
  int degree = 0;
  std::vector<double> omegas;
  Index count() const { return degree + 1 + 2 * static_cast<Index>(omegas.size()); }
  bool operator==(const TimeFunctions&) const = default;

  void evaluate(double tau, double* value) const {
    const std::array<double, 3> powers{1, tau, tau * tau / 2};
    value = std::copy_n(powers.begin(), degree + 1, value);
    for (const double omega : omegas) {
      *value++ = std::sin(omega * tau);
      *value++ = std::cos(omega * tau);
    }
  }
  /// Coefficients (by columns) for time counted from `by` on.
  MatrixXd shifted(const MatrixXd& c, double by) const {
    MatrixXd moved = c;
    if (degree >= 1) moved.col(0) += by * c.col(1);
    if (degree == 2) {
      moved.col(0) += by * by / 2 * c.col(2);
      moved.col(1) += by * c.col(2);
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
  /// Coefficients of the derivative.
  MatrixXd derivative(const MatrixXd& c) const {
    MatrixXd rate = MatrixXd::Zero(c.rows(), c.cols());
    for (int k = 0; k < degree; ++k) rate.col(k) = c.col(k + 1);
    Index k = degree + 1;
    for (const double omega : omegas) {
      rate.col(k) = -omega * c.col(k + 1);
      rate.col(k + 1) = omega * c.col(k);
      k += 2;
    }
    return rate;
  }
};

/// Of z' = A z + sum of b_j times function j, at one time: z = z0 + change z0 + sum of response_j b_j.
struct Propagator {
  MatrixXd change;  ///< exp(A tau) - 1: what is small keeps its digits
  std::vector<MatrixXd> response;
};

/// By Taylor's series, for a short time.
Propagator short_propagator(const MatrixXd& A, const TimeFunctions& functions, double tau) {
  const MatrixXd one = MatrixXd::Identity(A.rows(), A.cols());
  const auto series = [&](const MatrixXd& begin, auto coefficient) {
    MatrixXd term = begin, sum = MatrixXd::Zero(A.rows(), A.cols());
    for (int n = 0; n < numerics::arc_terms; ++n) {
      term = (A * term + coefficient(n) * one) * (tau / (n + 1));
      sum += term;
    }
    return sum;
  };
  // The coefficient of tau^n of each function, times tau^n.
  Propagator p{.change = series(one, [](int) { return 0.0; }), .response = {}};
  const std::array<double, 3> powers{1, tau, tau * tau / 2};
  for (int k = 0; k <= functions.degree; ++k) {
    p.response.push_back(series(MatrixXd::Zero(A.rows(), A.cols()), [&](int n) { return n == k ? powers[at(k)] : 0.0; }));
  }
  for (const double omega : functions.omegas) {
    for (const bool cosine : {false, true}) {
      double term = 1;  // (omega tau)^n/n!
      p.response.push_back(series(MatrixXd::Zero(A.rows(), A.cols()), [&](int n) {
        if (n > 0) term *= omega * tau / n;
        if ((n % 2 == 0) != cosine) return 0.0;
        return n % 4 < 2 ? term : -term;
      }));
    }
  }
  return p;
}

/// At twice the time.
Propagator doubled(const Propagator& p, const TimeFunctions& functions, double tau) {
  Propagator twice{.change = p.change * p.change + 2 * p.change, .response = {}};
  for (const MatrixXd& response : p.response) twice.response.push_back(p.change * response + 2 * response);
  // The functions in the second half, by those in the first.
  if (functions.degree >= 1) twice.response[1] += tau * p.response[0];
  if (functions.degree == 2) twice.response[2] += tau * p.response[1] + tau * tau / 2 * p.response[0];
  std::size_t k = at(functions.degree) + 1;
  for (const double omega : functions.omegas) {
    const double sine = std::sin(omega * tau), half = std::sin(omega * tau / 2), less = -2 * half * half;  // the cosine less 1
    twice.response[k] += less * p.response[k] + sine * p.response[k + 1];
    twice.response[k + 1] += less * p.response[k + 1] - sine * p.response[k];
    k += 2;
  }
  return twice;
}

/// Makes the norms of each row and its column alike by powers of 2 (E. E. Osborne 1960). Returns the scales of the states.
VectorXd balance(MatrixXd& A) {
  VectorXd scale = VectorXd::Ones(A.rows());
  for (bool more = true; std::exchange(more, false);) {
    for (Index i = 0; i < A.rows(); ++i) {
      const double own = std::abs(A(i, i)), column = A.col(i).cwiseAbs().sum() - own, row = A.row(i).cwiseAbs().sum() - own;
      if (!(column > 0) || !(row > 0)) continue;
      const double by = std::exp2(std::round(std::log2(row / column) / 2));
      if (column * by + row / by >= numerics::arc_balance * (column + row)) continue;
      A.col(i) *= by;
      A.row(i) /= by;
      scale(i) *= by;
      more = true;
    }
  }
  return scale;
}

/// The matrices of one mode.
struct LinearEquations {
  MatrixXd K;
  MatrixXd both;  ///< [M; K]: the rows of M where there are derivatives, else those of K
  bool regular = false;
  MatrixXd A;
  MatrixXd L;               ///< b = L h
  MatrixXd of_states, of_given;  ///< d = of_states z + of_given h
  TimeFunctions functions;
  double shortest = 0;      ///< h0 [s]
  /// Steps of h0 2^k.
  struct Level {
    std::array<Propagator, last_node> at_node;  ///< of each node after the first
    MatrixXd states;                            ///< all their states, one below the other, by z and the columns of b below each other
    MatrixXd functions;                         ///< values of the functions of time (rows) at all nodes
  };
  std::vector<Level> levels;

  double length(int level) const { return std::ldexp(shortest, level); }

  void prepare(const Dae& dae) {
    const Index n = K.rows();
    std::vector<Index> states;
    for (Index i = 0; i < n; ++i) {
      if (dae.differential(static_cast<int>(i))) states.push_back(i);
    }
    // Units of rows and columns differ by decades.
    VectorXd rows = VectorXd::Ones(n), columns = VectorXd::Ones(n);
    const auto level = [](double most) { return most > 0 && std::isfinite(most) ? std::exp2(-std::round(std::log2(most))) : 1; };
    for (int round = 0; round < numerics::arc_scalings; ++round) {
      for (Index i = 0; i < n; ++i) rows(i) *= level((rows(i) * both.row(i) * columns.asDiagonal()).cwiseAbs().maxCoeff());
      for (Index i = 0; i < n; ++i) columns(i) *= level((rows.asDiagonal() * both.col(i) * columns(i)).cwiseAbs().maxCoeff());
    }
    const Eigen::FullPivLU<MatrixXd> factors(MatrixXd(rows.asDiagonal() * both * columns.asDiagonal()));
    if (!factors.isInvertible()) return;
    const MatrixXd S = columns.asDiagonal() * factors.inverse() * rows.asDiagonal();
    const auto r = static_cast<Index>(states.size());
    of_states.resize(n, r);
    of_given = S;
    for (Index k = 0; k < r; ++k) {
      of_states.col(k) = S.col(states[at(static_cast<int>(k))]);
      of_given.col(states[at(static_cast<int>(k))]).setZero();
    }
    MatrixXd Kd(r, n);
    L = MatrixXd::Zero(r, n);
    for (Index k = 0; k < r; ++k) {
      Kd.row(k) = K.row(states[at(static_cast<int>(k))]);
      L(k, states[at(static_cast<int>(k))]) = 1;
    }
    A = -Kd * of_states;
    L -= Kd * of_given;
    const VectorXd scale = balance(A);
    of_states = of_states * scale.asDiagonal();
    L = scale.cwiseInverse().asDiagonal() * L;
    regular = A.allFinite() && L.allFinite() && of_states.allFinite() && of_given.allFinite();
  }

  /// Chooses the length of the shortest steps for these inputs on an interval of this length.
  void respond_to(const TimeFunctions& inputs, double interval) {
    double fastest = A.size() == 0 ? 0 : A.cwiseAbs().colwise().sum().maxCoeff();
    for (const double omega : inputs.omegas) fastest = std::max(fastest, omega);
    const double slow_enough = fastest > 0 ? numerics::arc_shortest / fastest : std::numeric_limits<double>::infinity();
    const bool fits = shortest <= interval && (shortest == slow_enough || interval <= length(numerics::arc_levels));
    if (!levels.empty() && functions == inputs && fits) return;
    functions = inputs;
    levels.clear();
    // A power of 2, so that another interval seldom asks for another length.
    shortest = std::min(slow_enough, std::exp2(std::floor(std::log2(interval))));
  }

  const Level& level(int k) {
    if (levels.empty()) levels.push_back(make_level(shortest, nullptr));
    while (static_cast<int>(levels.size()) <= k) levels.push_back(make_level(length(static_cast<int>(levels.size())), &levels.back()));
    return levels[at(k)];
  }

  /// Steps of this length: by Taylor's series, or by doubling those of half the length.
  Level make_level(double of_step, const Level* half) const {
    Level level;
    const Index r = A.rows(), count = functions.count();
    level.states.resize(last_node * r, (count + 1) * r);
    level.functions.resize(count, last_node + 1);
    for (int i = 0; i <= last_node; ++i) {
      const double tau = nodes_of_step.place[at(i)] * of_step;
      functions.evaluate(tau, level.functions.col(i).data());
      if (i == 0) continue;
      Propagator& p = level.at_node[at(i) - 1];
      p = half ? doubled(half->at_node[at(i) - 1], functions, tau / 2) : short_propagator(A, functions, tau);
      auto rows = level.states.middleRows((i - 1) * r, r);
      rows.leftCols(r) = p.change + MatrixXd::Identity(r, r);
      for (Index j = 0; j < count; ++j) rows.middleCols((j + 1) * r, r) = p.response[at(static_cast<int>(j))];
    }
    return level;
  }
};

}  // namespace

struct ExactArc::Implementation {
  Dae& dae;
  const std::vector<double>& tolerance;
  Index n;
  std::vector<LinearEquations> known;  ///< of the modes of the laws so far
  std::size_t present = 0;
  int next_level = 0;
  TimePoint begin;
  double length = 0;
  VectorXd y0;
  MatrixXd given;              ///< coefficients of h by the functions of time since `begin`
  VectorXd z;                  ///< at `from`
  double from = 0, step = 0;   ///< of the last step [s since `begin`], [s]
  MatrixXd y, yp, states;      ///< less y0, at the nodes of the last step
  MatrixXd rates;              ///< of the states
  MatrixXd pushes, given_part, given_rate;  ///< b, what h adds to d, and its rate, by the functions of time
  VectorXd drive;              ///< z, and the columns of b
  mutable double place = not_given;  ///< share of the step, last asked for
  mutable NodeShares shares;         ///< there
  std::vector<double> entries, zero, at_rest;

  Implementation(Dae& d, const std::vector<double>& tol)
      : dae(d), tolerance(tol), n(d.size()), y0(n), y(n, last_node + 1), yp(n, last_node + 1), entries(at(d.pattern().entries())), zero(at(d.size()), 0), at_rest(zero) {}

  LinearEquations& equations() { return known[present]; }

  bool linear() const {
    const Network& network = dae.network();
    if (dae.unknowns() == 0 || dae.rough() || dae.inputs().history().any()) return false;
    for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        if (!laws.batch->linear(i)) return false;
      }
    }
    for (const Laws<RateBatch>& laws : network.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        if (!laws.batch->linear(i)) return false;
      }
    }
    return true;
  }

  MatrixXd dense() const {
    MatrixXd matrix = MatrixXd::Zero(n, n);
    const Pattern& pattern = dae.pattern();
    for (int column = 0; column < pattern.size; ++column) {
      for (int e = pattern.column_start[at(column)]; e < pattern.column_start[at(column) + 1]; ++e) matrix(pattern.row[at(e)], column) += entries[at(e)];
    }
    return matrix;
  }

  void find_equations() {
    dae.jacobian(begin.t, 0, y0.data(), zero.data(), entries.data());
    MatrixXd K = dense();
    dae.consistency_matrix(begin.t, y0.data(), entries.data());
    MatrixXd both = dense();
    for (present = 0; present < known.size(); ++present) {
      if (known[present].K == K && known[present].both == both) return;
    }
    if (known.size() >= numerics::arc_modes_kept) known.clear();
    present = known.size();
    known.push_back({});
    equations().K = std::move(K);
    equations().both = std::move(both);
    equations().prepare(dae);
    next_level = 0;
  }

  /// h at this time.
  VectorXd residual(double tau) {
    const TimePoint t = begin + tau;
    dae.refine(t);
    VectorXd h(n);
    dae.residual(t.t, y0.data(), zero.data(), h.data());
    return -h;
  }

  /// Fits h by the functions of time: exact for what the inputs are made of. False where h is not made of them.
  bool find_given(const TimeFunctions& functions) {
    const VectorXd first = residual(0);
    given = MatrixXd::Zero(n, functions.count());
    given.col(0) = first;
    const Index varying = functions.count() - 1;
    if (varying > 0) {
      const Index samples = 2 * varying + 2;
      MatrixXd values(samples, varying), change(samples, n);
      std::vector<double> value(at(static_cast<int>(functions.count())));
      for (Index s = 0; s < samples; ++s) {
        constexpr double golden = std::numbers::phi - 1;
        const double share = s + 1 == samples ? 1 : golden * static_cast<double>(s + 1) - std::floor(golden * static_cast<double>(s + 1));
        const double tau = share * length;
        functions.evaluate(tau, value.data());
        Index column = 0;
        for (int k = 1; k <= functions.degree; ++k) values(s, column++) = value[at(k)];
        std::size_t k = at(functions.degree) + 1;
        for (const double omega : functions.omegas) {
          const double half = std::sin(omega * tau / 2);
          values(s, column++) = value[k];
          values(s, column++) = -2 * half * half;
          k += 2;
        }
        change.row(s) = (residual(tau) - first).transpose();
      }
      VectorXd scale = values.cwiseAbs().colwise().maxCoeff().transpose();
      for (double& of : scale) of = of > 0 ? of : 1;
      const MatrixXd scaled = values * scale.cwiseInverse().asDiagonal();
      MatrixXd solved = scaled.colPivHouseholderQr().solve(change);
      const MatrixXd misfit = scaled * solved - change;
      for (Index i = 0; i < n; ++i) {
        const double terms = equations().K.row(i).cwiseAbs() * y0.cwiseAbs();
        if (!(misfit.col(i).cwiseAbs().maxCoeff() <= numerics::arc_misfit * std::max({change.col(i).cwiseAbs().maxCoeff(), std::abs(first(i)), terms}))) return false;
      }
      solved = scale.cwiseInverse().asDiagonal() * solved;
      given.rightCols(varying) = solved.transpose();
      // A cosine is 1 at the beginning.
      Index k = functions.degree + 2;
      for (std::size_t j = 0; j < functions.omegas.size(); ++j, k += 2) given.col(0) -= given.col(k);
    }
    dae.refine(begin);
    return given.allFinite();
  }

  bool converged() const {
    const ChebyshevNodes& c = nodes_of_step;
    for (Index i = 0; i < n; ++i) {
      double last = 0, before = 0, most = 0;
      for (int k = 0; k <= last_node; ++k) {
        last += c.last[at(k)] * y(i, k);
        before += c.last_but_one[at(k)] * y(i, k);
        most = std::max(most, std::abs(y(i, k) + y0(i)));
      }
      const double negligible = std::max(numerics::arc_share * tolerance[at(static_cast<int>(i))], numerics::arc_ulps * std::numeric_limits<double>::epsilon() * most);
      if (!(std::abs(last) + std::abs(before) <= negligible)) return false;
    }
    return true;
  }

  /// Fills the nodes of a step of this level from `from` on.
  void look(int number) {
    const LinearEquations::Level& level = equations().level(number);
    const Index r = z.size();
    step = equations().length(number);
    place = not_given;
    states.resize(r, last_node + 1);
    states.col(0) = z;
    Eigen::Map<VectorXd>(states.data() + r, r * last_node).noalias() = level.states * drive;
    y.noalias() = equations().of_states.lazyProduct(states);
    y.noalias() += given_part.lazyProduct(level.functions);
    rates.noalias() = equations().A.lazyProduct(states);
    rates.noalias() += pushes.lazyProduct(level.functions);
    yp.noalias() = equations().of_states.lazyProduct(rates);
    yp.noalias() += given_rate.lazyProduct(level.functions);
  }

  /// Goes on from a time in the last step.
  double go(double begin_of_step, double longest) {
    LinearEquations& e = equations();
    if (begin_of_step > from) {
      z = states * shares_at((begin_of_step - from) / step);
      from = begin_of_step;
    }
    // What acts in this step, by the functions of the time since its beginning.
    const MatrixXd h = e.functions.shifted(given, from);
    pushes = e.L * h;
    given_part = e.of_given * h;
    given_rate = e.functions.derivative(given_part);
    drive.resize(z.size() * (pushes.cols() + 1));
    drive.head(z.size()) = z;
    drive.tail(pushes.size()) = Eigen::Map<const VectorXd>(pushes.data(), pushes.size());
    const double left = length - from;
    int level = std::min(next_level, numerics::arc_levels);
    const double fastest = e.functions.omegas.empty() ? 0 : e.functions.omegas.back();
    while (level > 0 && (e.length(level - 1) >= std::min(left, longest) || fastest * e.length(level) > numerics::arc_phase)) --level;
    for (;; --level) {
      look(level);
      if (level == 0 || converged()) break;
    }
    next_level = level + 1;
    return step >= left && longest >= left ? length : from + std::min(step, longest);
  }

  /// The shares of the nodes in the value of their polynomial at a share of the step.
  const NodeShares& shares_at(double share) const {
    if (share == place) return shares;
    const ChebyshevNodes& c = nodes_of_step;
    place = share;
    double sum = 0;
    for (int k = 0; k <= last_node; ++k) {
      const double apart = share - c.place[at(k)];
      if (apart == 0) return shares = NodeShares::Unit(k);
      sum += shares(k) = c.barycentric[at(k)] / apart;
    }
    return shares /= sum;
  }
};

ExactArc::ExactArc(Dae& dae, const std::vector<double>& tolerance) : impl_(std::make_unique<Implementation>(dae, tolerance)) {}

ExactArc::~ExactArc() = default;

bool ExactArc::begin(TimePoint t, const std::vector<double>& y, double length) {
  Implementation& s = *impl_;
  if (!s.linear() || !std::isfinite(length)) return false;
  const auto functions = s.dae.inputs().time_functions();
  if (!functions) return false;
  s.begin = t;
  s.length = length;
  s.y0 = Eigen::Map<const VectorXd>(y.data(), s.n);
  s.find_equations();
  LinearEquations& e = s.equations();
  if (!e.regular) return false;
  const TimeFunctions of_inputs{functions->degree, functions->omegas};
  e.respond_to(of_inputs, length);
  if (length > numerics::arc_steps * e.length(numerics::arc_levels)) return false;
  if (!s.find_given(of_inputs)) return false;
  s.z = VectorXd::Zero(e.A.rows());
  s.from = 0;
  s.step = 0;
  return true;
}

double ExactArc::step(double from, double longest) { return impl_->go(from, longest); }

void ExactArc::evaluate(double since_begin, int derivative, double* out) const {
  const Implementation& s = *impl_;
  const NodeShares& shares = s.shares_at((since_begin - s.from) / s.step);
  Eigen::Map<VectorXd> value(out, s.n);
  if (derivative == 0) {
    value = s.y0;
    value.noalias() += s.y.lazyProduct(shares);
  } else {
    value.noalias() = s.yp.lazyProduct(shares);
  }
}

}  // namespace rheonet
