#include "core/solve/exact_arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/solve/linear_equations.hpp"

namespace rheonet {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct ExactArc::Implementation {
  Dae& dae;
  const std::vector<double>& tolerance;
  Index n;
  std::vector<LinearEquations> known;  ///< of the modes of the laws so far
  std::size_t present = 0;
  int next_level = 0;
  int limiting = -1;  ///< the unknown for which the last step is no longer; -1 if none
  TimePoint begin;
  double length = 0;
  double base = 0;             ///< Time of y0 [s since `begin`].
  VectorXd y0;
  MatrixXd given;              ///< Coefficients of h by the functions of time since `base`.
  VectorXd z;                  ///< At `from`.
  double from = 0, step = 0;   ///< The last step: its start [s since `begin`] and its length [s].
  StepNodes::Values y, yp;          ///< The solution less y0, and its rate, in the last step.
  StepNodes::Values states, rates;  ///< z and its rate there.
  MatrixXd pushes, given_part, given_rate;  ///< Coefficients of three vectors: L h, the part of d that h adds, its rate.
  VectorXd drive;              ///< See LinearEquations::drive.
  mutable double place = not_given;   ///< Where in the step the solution was asked for last, as a share of it.
  mutable StepNodes::Shares shares;   ///< StepNodes::at(place)
  std::vector<double> entries, at_rest;

  Implementation(Dae& d, const std::vector<double>& tol)
      : dae(d), tolerance(tol), n(d.size()), y0(n), y(n, StepNodes::count), yp(y), entries(at(d.pattern().entries())), at_rest(at(d.size()), 0) {}

  LinearEquations& equations() { return known[present]; }

  MatrixXd dense() const {
    MatrixXd matrix = MatrixXd::Zero(n, n);
    const Pattern& pattern = dae.pattern();
    for (int column = 0; column < pattern.size; ++column) {
      for (int e = pattern.column_start[at(column)]; e < pattern.column_start[at(column) + 1]; ++e) matrix(pattern.row[at(e)], column) += entries[at(e)];
    }
    return matrix;
  }

  /// Finds or makes the equations of the present modes of the laws, under these functions of time.
  void find_equations(const TimeFunctions& functions) {
    dae.jacobian(begin.t, 0, y0.data(), at_rest.data(), entries.data());
    MatrixXd K = dense();
    dae.consistency_matrix(begin.t, y0.data(), entries.data());
    MatrixXd both = dense();
    for (present = 0; present < known.size(); ++present) {
      if (equations().functions() != functions || !equations().are(K, both)) continue;
      if (!equations().serve(length)) {
        equations() = LinearEquations(dae, std::move(K), std::move(both), functions, length);
        next_level = 0;
      }
      return;
    }
    if (known.size() >= numerics::arc_modes_kept) known.clear();
    present = known.size();
    known.emplace_back(dae, std::move(K), std::move(both), functions, length);
    next_level = 0;
  }

  /// h at this time since `base`.
  VectorXd given_at(double tau) {
    const TimePoint t = begin + (base + tau);
    dae.refine(t);
    VectorXd residual(n);
    dae.residual(t.t, y0.data(), at_rest.data(), residual.data());
    return -residual;
  }

  /// Fits h by the functions of time. False where it is not made of them.
  bool find_given(const TimeFunctions& functions) {
    std::vector<double> times{0};
    if (functions.count() > 1) {
      // Spread evenly, but at no regular distance.
      const Index samples = 2 * functions.count();
      for (Index s = 1; s < samples; ++s) {
        const double turns = (std::numbers::phi - 1) * static_cast<double>(s);
        times.push_back((turns - std::floor(turns)) * (length - base));
      }
      times.push_back(length - base);
    }
    MatrixXd values(static_cast<Index>(times.size()), n);
    for (std::size_t s = 0; s < times.size(); ++s) values.row(static_cast<Index>(s)) = given_at(times[s]).transpose();
    dae.refine(begin);
    VectorXd misfit;
    given = functions.fit(times, values, misfit);
    const VectorXd terms = equations().terms(y0), largest = values.cwiseAbs().colwise().maxCoeff().transpose();
    return given.allFinite() && (misfit.array() <= numerics::arc_misfit * largest.cwiseMax(terms).array()).all();
  }

  /// Bounds of the sums of magnitudes from which the unknowns follow in the last step, which had this level, and their rates.
  struct Magnitudes {
    VectorXd values, rates;
  };
  Magnitudes magnitudes(const LinearEquations::Level& level) {
    const auto of_states = equations().of_states().cwiseAbs();
    const VectorXd largest = level.largest_states * drive.cwiseAbs();
    return {of_states * largest + given_part.cwiseAbs() * level.largest_functions,
            of_states * (equations().rate_of_states().cwiseAbs() * largest + pushes.cwiseAbs() * level.largest_functions) + given_rate.cwiseAbs() * level.largest_functions};
  }

  /// Whether the polynomials of the unknowns, and what their rates change within the step, are right to negligible parts of the tolerances.
  bool converged(const LinearEquations::Level& level) {
    const StepNodes& nodes = step_nodes();
    const double round_off = numerics::arc_ulps * std::numeric_limits<double>::epsilon();
    std::optional<Magnitudes> sums;
    double worst = 1;
    bool all = true;
    for (Index i = 0; i < n; ++i) {
      const double negligible = std::max(numerics::arc_share * tolerance[at(static_cast<int>(i))], round_off * (y.row(i).array() + y0(i)).abs().maxCoeff());
      const double value = std::abs(y.row(i).dot(nodes.highest)) + std::abs(y.row(i).dot(nodes.second_highest));
      const double rate = step * (std::abs(yp.row(i).dot(nodes.highest)) + std::abs(yp.row(i).dot(nodes.second_highest)));
      if (value <= negligible && rate <= negligible) continue;
      // Small differences of large terms have their round-off, which no shorter step reduces.
      if (!sums) sums = magnitudes(level);
      if (value <= std::max(negligible, round_off * sums->values(i)) && rate <= std::max(negligible, round_off * step * sums->rates(i))) continue;
      all = false;
      if (std::max(value, rate) <= worst * negligible) continue;
      worst = std::max(value, rate) / negligible;
      limiting = static_cast<int>(i);
    }
    return all;
  }

  /// sum += matrix values, where most of the matrix may be 0.
  static void add(const MatrixXd& matrix, const StepNodes::Values& values, StepNodes::Values& sum) {
    for (Index k = 0; k < matrix.cols(); ++k) {
      for (Index i = 0; i < matrix.rows(); ++i) {
        if (matrix(i, k) != 0) sum.row(i) += matrix(i, k) * values.row(k);
      }
    }
  }

  /// Fills the nodes of a step of this level from `from` on.
  void look(int number) {
    LinearEquations& e = equations();
    const LinearEquations::Level& level = e.level(number);
    step = e.length(number);
    place = not_given;
    states.resize(z.size(), StepNodes::count);
    Eigen::Map<VectorXd>(states.data(), states.size()).noalias() = level.states * drive;
    rates.setZero(z.size(), StepNodes::count);
    add(e.rate_of_states(), states, rates);
    add(pushes, level.functions, rates);
    y.setZero();
    add(e.of_states(), states, y);
    add(given_part, level.functions, y);
    yp.setZero();
    add(e.of_states(), rates, yp);
    add(given_rate, level.functions, yp);
  }

  /// Where unknowns have become much smaller than they were at y0, y0 + d has lost their digits: takes the present values as y0.
  void renew_base(const StepNodes::Shares& now) {
    const VectorXd values = y0 + y * now;
    for (Index i = 0; i < n; ++i) {
      if (std::abs(values(i)) >= numerics::arc_base * std::abs(y0(i)) || std::abs(y0(i)) <= numerics::arc_share * tolerance[at(static_cast<int>(i))]) continue;
      const auto before = std::tuple(y0, base, given);
      y0 = values;
      base = from;
      if (find_given(equations().functions())) {
        z.setZero();
        equations().respond_to(given, length - base);
      } else {
        std::tie(y0, base, given) = before;
      }
      return;
    }
  }

  /// Goes on from a time in the last step.
  double go(double begin_of_step, double longest) {
    LinearEquations& e = equations();
    if (begin_of_step > from) {
      const StepNodes::Shares now = shares_at((begin_of_step - from) / step);
      z = states * now;
      from = begin_of_step;
      renew_base(now);
    }
    // Inputs as sums of functions of the time since the beginning of this step.
    const MatrixXd h = e.functions().shifted(given, from - base);
    pushes = e.pushes(h);
    given_part = e.of_given(h);
    given_rate = e.functions().derivative(given_part);
    drive = e.drive(z, pushes);
    const double left = length - from;
    int level = next_level;
    while (level > 0 && (e.length(level - 1) >= std::min(left, longest) || e.functions().fastest() * e.length(level) > numerics::arc_phase)) --level;
    limiting = -1;
    for (;; --level) {
      look(level);
      if (level == 0 || converged(equations().level(level))) break;
    }
    next_level = level + 1;
    return step >= left && longest >= left ? length : from + std::min(step, longest);
  }

  const StepNodes::Shares& shares_at(double share) const {
    if (share != place) shares = step_nodes().at(place = share);
    return shares;
  }
};

ExactArc::ExactArc(Dae& dae, const std::vector<double>& tolerance) : impl_(std::make_unique<Implementation>(dae, tolerance)) {}

ExactArc::~ExactArc() = default;

bool ExactArc::begin(TimePoint t, const std::vector<double>& y, double length) {
  Implementation& s = *impl_;
  if (s.dae.unknowns() == 0 || !std::isfinite(length)) return false;
  std::optional<TimeFunctions> functions = s.dae.inputs().time_functions();
  if (!functions) return false;
  functions = functions->within(length);
  s.begin = t;
  s.length = length;
  s.base = 0;
  s.y0 = Eigen::Map<const VectorXd>(y.data(), s.n);
  s.find_equations(*functions);
  LinearEquations& e = s.equations();
  if (!e.regular()) return false;
  if (e.too_stiff(length) || !s.find_given(*functions)) return false;
  e.respond_to(s.given, length);
  s.z = VectorXd::Zero(e.states());
  s.from = s.step = 0;
  return true;
}

double ExactArc::step(double from, double longest) { return impl_->go(from, longest); }

int ExactArc::limiting_unknown() const { return impl_->limiting; }

void ExactArc::evaluate(double since_begin, int derivative, double* out) const {
  const Implementation& s = *impl_;
  const StepNodes::Shares& shares = s.shares_at((since_begin - s.from) / s.step);
  Eigen::Map<VectorXd> value(out, s.n);
  if (derivative == 0) {
    value = s.y0;
    for (Index i = 0; i < s.n; ++i) value(i) += s.y.row(i).dot(shares);
  } else {
    for (Index i = 0; i < s.n; ++i) value(i) = s.yp.row(i).dot(shares);
  }
}

}  // namespace rheonet
