#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/consistency.hpp"

namespace rheonet {

namespace {

/// While it exists, slopes are secants.
struct Secants {
  explicit Secants(Dae& d) : dae(d) { dae.use_secants(true); }
  ~Secants() { dae.use_secants(false); }
  Secants(const Secants&) = delete;
  Secants& operator=(const Secants&) = delete;
  Dae& dae;
};

}  // namespace

/// Solves the algebraic equations for y; the integrals of the differential ones stay, M (y - before) = 0. Mostly the equations
/// are almost linear, and full Newton steps reach the round-off of their terms at once. If they fail, secants follow where laws
/// are infinitely steep or flat at rest, and then damped steps.
class Consistency::Projection {
 public:
  Projection(Consistency& consistency, double t, std::vector<double>& y)
      : c_(consistency),
        dae_(consistency.dae_),
        t_(t),
        y_(y),
        n_(y.size()),
        before_(y),
        defect_(consistency.r0_),
        magnitude_(consistency.r1_),
        change_(n_),
        trial_(n_),
        next_(n_),
        scale_(n_, 0) {
    for (const double v : dae_.inputs().velocity) known_velocity_ = std::max(known_velocity_, std::abs(v));
    fastest_ = known_velocity_;
    for (std::size_t i = 0; i < n_; ++i) {
      if (c_.kind_[i] == velocity) fastest_ = std::max(fastest_, std::abs(y_[i]));
    }
  }

  void solve() {
    if (rests()) return;
    if (whole_steps(numerics::projection_steps, numerics::projection_idle_steps)) return finish();
    if (dae_.rough()) {
      y_ = before_;
      const Secants secants(dae_);
      if (whole_steps(numerics::secant_steps, numerics::secant_idle_steps)) return finish();
    }
    y_ = before_;
    damped_steps();
    finish();
  }

 private:
  enum Kind : std::size_t { velocity, deflection, force, position, block_state };

  bool differential(std::size_t i) const { return dae_.differential(static_cast<int>(i)); }

  void find_defects(const std::vector<double>& y) {
    dae_.residual(t_, y.data(), c_.zero_.data(), defect_.data());
    for (std::size_t i = 0; i < n_; ++i) {
      if (differential(i)) defect_[i] = 0;
    }
    const Pattern& pattern = dae_.pattern();
    for (std::size_t column = 0; column < n_; ++column) {
      for (int e = pattern.column_start[column]; e < pattern.column_start[column + 1]; ++e) {
        const int row = pattern.row[at(e)];
        if (dae_.differential(row)) defect_[at(row)] += c_.values_[at(e)] * (y[column] - before_[column]);
      }
    }
  }

  /// Whether the residuals are round-off.
  bool within_rounding(const std::vector<double>& y) {
    find_defects(y);
    dae_.magnitudes(magnitude_.data());
    add_unknown_velocities();
    for (std::size_t i = 0; i < n_; ++i) {
      if (!differential(i) && std::abs(defect_[i]) > numerics::equation_roundoff * magnitude_[i]) return false;
    }
    return true;
  }

  /// Where friction held at rest makes velocities from force balances agree, they agree only to the round-off that these forces
  /// give them: all may be at rest, without a size of their own.
  void add_unknown_velocities() {
    const Pattern& pattern = dae_.pattern();
    for (std::size_t column = 0; column < n_; ++column) {
      if (c_.kind_[column] != velocity || differential(column)) continue;
      double own = 0;  // diagonal entry: its balance has its number
      for (int e = pattern.column_start[column]; e < pattern.column_start[column + 1]; ++e) {
        if (at(pattern.row[at(e)]) == column) own = std::abs(c_.values_[at(e)]);
      }
      if (own == 0) continue;
      for (int e = pattern.column_start[column]; e < pattern.column_start[column + 1]; ++e) {
        const std::size_t row = at(pattern.row[at(e)]);
        if (c_.kind_[row] == deflection && !differential(row)) magnitude_[row] += std::abs(c_.values_[at(e)]) * magnitude_[column] / own;
      }
    }
  }

  /// Newton's step for these residuals.
  void find_change(std::vector<double>& change) const {
    for (std::size_t i = 0; i < n_; ++i) change[i] = -defect_[i];
    c_.elimination_.solve(change);
  }

  /// Tries rest: if rest solves the equations exactly, it is the solution.
  bool rests() {
    trial_ = y_;
    for (std::size_t i = 0; i < n_; ++i) {
      if (!dae_.differentiated(static_cast<int>(i)) && c_.kind_[i] != deflection) trial_[i] = 0;
    }
    c_.factorise(t_, trial_);
    find_defects(trial_);
    if (!std::all_of(defect_.begin(), defect_.end(), [](double d) { return d == 0; })) return false;
    y_ = trial_;
    return true;
  }

  /// Full Newton steps; false if they do not converge.
  bool whole_steps(int most, int patience) {
    std::vector<double> best = y_;
    double least = std::numeric_limits<double>::infinity();
    int idle = 0;
    for (int iteration = 0; iteration < most; ++iteration) {
      c_.factorise(t_, y_);
      if (within_rounding(y_)) return true;
      double error = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        if (!differential(i) && defect_[i] != 0) error = std::max(error, std::abs(defect_[i]) / magnitude_[i]);
      }
      // A small balance may have reached its round-off already, while another one still gains much.
      idle = error < least / 2 ? 0 : idle + 1;
      if (error < least) {
        least = error;
        best = y_;
      }
      if (idle == patience || !std::isfinite(error)) break;
      find_change(change_);
      for (std::size_t i = 0; i < n_; ++i) y_[i] += change_[i];
    }
    y_ = best;
    return least <= numerics::stalled_projection_balance;
  }

  /// Newton's method, damped by the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear Problems, 2004, 3.3),
  /// which does not depend on the units of the equations.
  void damped_steps() {
    double damping = 1;
    for (int iteration = 0; iteration < numerics::damped_steps; ++iteration) {
      c_.factorise(t_, y_);
      if (within_rounding(y_)) return;
      find_change(change_);
      find_scales();
      const double size = norm(change_);
      if (!std::isfinite(size)) c_.report_unsolved(t_);
      if (size <= numerics::damped_change) return;
      for (;; damping /= 2) {
        for (std::size_t i = 0; i < n_; ++i) trial_[i] = y_[i] + damping * change_[i];
        if (within_rounding(trial_)) {
          y_ = trial_;
          return;
        }
        find_change(next_);
        if (norm(next_) <= (1 - damping / 4) * size || norm(next_) <= numerics::damped_change) break;
        if (damping < numerics::least_damping) {
          if (size <= numerics::stalled_projection_change || within_rounding(y_) || lost_in_rounding()) return;
          c_.report_unsolved(t_);
        }
      }
      y_ = trial_;
      if (damping == 1 && norm(next_) <= numerics::full_step_change) return;
      damping = std::min(1.0, 2 * damping);
    }
    c_.report_unsolved(t_);
  }

  /// Whether Newton's step is within the effect of round-off of the equations' terms. The round-off of a large force may reach
  /// far: through the deflection of its spring to another deflection, and from there to a velocity with hardly any force.
  bool lost_in_rounding() {
    constexpr double grains = numerics::sum_ulps * std::numeric_limits<double>::epsilon();
    within_rounding(y_);
    const Pattern& pattern = dae_.pattern();
    std::vector<double> lost = magnitude_, reach(n_, 0), moved(n_);
    for (std::size_t column = 0; column < n_; ++column) {
      for (int e = pattern.column_start[column]; e < pattern.column_start[column + 1]; ++e) {
        const std::size_t row = at(pattern.row[at(e)]);
        if (differential(row)) lost[row] += std::abs(c_.values_[at(e)] * y_[column]);
      }
    }
    for (unsigned p = 0; p < numerics::roundoff_patterns; ++p) {
      // Rows of a Hadamard matrix: of any few rows the signs come in every combination.
      for (std::size_t i = 0; i < n_; ++i) moved[i] = std::popcount(static_cast<unsigned>(i) & p) % 2 ? -grains * lost[i] : grains * lost[i];
      c_.elimination_.solve(moved);
      for (std::size_t i = 0; i < n_; ++i) reach[i] = std::max(reach[i], std::abs(moved[i]));
    }
    for (std::size_t i = 0; i < n_; ++i) {
      if (!(std::abs(change_[i]) <= std::max(numerics::roundoff_reach * reach[i], numerics::damped_change * scale_[i]))) return false;
    }
    return true;
  }

  /// An unknown that is small beside others of its kind may be their round-off.
  void find_scales() {
    std::array<double, kinds> largest{};
    largest[velocity] = known_velocity_;
    // A deflection counts by the force that it causes.
    double largest_force = 0;
    for (double r : magnitude_) largest_force = std::max(largest_force, r);
    const std::vector<double>& slope = dae_.slopes();
    const auto size_of = [&](std::size_t i) {
      if (c_.kind_[i] >= position) return std::max(std::abs(before_[i]), std::abs(y_[i]));
      if (c_.kind_[i] != deflection) return std::max({scale_[i], std::abs(y_[i]), std::abs(change_[i])});
      const double stiffness = std::abs(slope[at(c_.branch_[i])]);
      return std::max(std::abs(before_[i]), stiffness > 0 ? numerics::projection_scale_floor * largest_force / stiffness : 0);
    };
    for (std::size_t i = 0; i < n_; ++i) largest[c_.kind_[i]] = std::max(largest[c_.kind_[i]], size_of(i));
    for (std::size_t i = 0; i < n_; ++i) scale_[i] = std::max(size_of(i), numerics::projection_scale_floor * largest[c_.kind_[i]]);
  }

  double norm(const std::vector<double>& x) const {
    double largest = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (!std::isfinite(x[i])) return std::numeric_limits<double>::infinity();
      if (scale_[i] > 0) largest = std::max(largest, std::abs(x[i]) / scale_[i]);
    }
    return largest;
  }

  void finish() {
    // A velocity that is round-off becomes 0. A mass keeps the smallest velocity, and so do the nodes of a train.
    const auto tied = [&](std::size_t row) {
      const std::vector<Structure::TrainEquation>& trains = dae_.structure().train_equations;
      return std::any_of(trains.begin(), trains.end(), [&](const Structure::TrainEquation& train) { return dae_.indices().velocity[at(train.pivot)] == static_cast<int>(row); });
    };
    for (std::size_t i = 0; i < n_; ++i) {
      if (c_.kind_[i] == velocity && !differential(i) && !tied(i) && std::abs(y_[i]) <= numerics::equal_velocities * fastest_) y_[i] = 0;
    }
    // Integrals that nothing changes keep their last digit.
    trial_ = y_;
    for (std::size_t i = 0; i < n_; ++i) {
      if (c_.kind_[i] == deflection || c_.kind_[i] >= position) y_[i] = before_[i];
    }
    if (!within_rounding(y_)) y_ = trial_;
  }

  Consistency& c_;
  Dae& dae_;
  double t_;
  std::vector<double>& y_;
  std::size_t n_;
  const std::vector<double> before_;
  std::vector<double>& defect_;     ///< residual of each equation
  std::vector<double>& magnitude_;  ///< sum of the magnitudes of its terms
  std::vector<double> change_, trial_, next_;
  std::vector<double> scale_;                  ///< of each unknown
  double known_velocity_ = 0, fastest_ = 0;  ///< the largest known velocity, and the largest of all at first
};

void Consistency::project(double t, std::vector<double>& y) {
  wake();
  Projection(*this, t, y).solve();
}

}  // namespace rheonet
