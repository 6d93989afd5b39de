#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/solve/linear_solver.hpp"

namespace rheonet {

/// Newton's iteration for the equations of an integrator's step, to a share of the step's allowed error, or to round-off. The
/// Jacobian is kept while the coefficient cj of the step hardly changes.
class Newton {
 public:
  /// A change of unknown i below `grain[i]` is round-off; `tolerance` is as for LinearSolver. All arguments outlive this.
  Newton(Dae& dae, bool sparse, const std::vector<double>& tolerance, const std::vector<double>& grain);

  /// Discards the Jacobian and the rate of convergence. Counts begin anew.
  void restart();

  /// A step to t. It ends at y = predicted_y + c, y' = predicted_yp + cj c, with the unknown correction c.
  struct Step {
    double t, cj;
    const double *predicted_y, *predicted_yp;
    double *y, *yp;  ///< the present iterate
  };
  /// Finds c, starting from 0, until the weighted root mean square of the next change is estimated to be at most `enough`.
  /// False if it does not converge.
  [[nodiscard]] bool solve(const Step& step, double* correction, const double* weight, double enough);

  struct Counts {
    long residuals = 0, jacobians = 0;
    long failures = 0;  ///< iterations that did not converge, including those that did so after a new Jacobian
  };
  const Counts& counts() const { return counts_; }
  /// The last Jacobian has no inverse.
  bool singular() const { return singular_; }

 private:
  enum class Verdict { converged, go_on, hopeless };
  bool stale(double cj) const;
  bool evaluate(const Step& step, const double* correction);
  bool renew(const Step& step);
  Verdict iterate(const Step& step, double* correction, const double* weight, double enough);
  Verdict judge(const Step& step, int iteration, const double* weight, double enough);
  Verdict smooth(const Step& step, int iteration, double size, const double* weight, double enough);
  Verdict rough(const Step& step, int iteration, double size, const double* weight, double enough);
  double norm(const double* weight) const;
  bool turns_back(const double* weight) const;
  double rounding(const Step& step, const double* weight) const;

  Dae& dae_;
  const std::vector<double>& grain_;
  LinearSolver linear_;
  bool singular_ = false;
  double jacobian_cj_ = 0;  // of the Jacobian; 0: no Jacobian
  double last_cj_ = 0;      // of the last step
  double foreseen_ = 0;     // estimate of the remaining error over the last change
  double first_change_ = 0; // norm of the first change
  std::vector<double> change_;
  std::vector<double> last_change_;  // for power laws only (Dae::rough)
  Counts counts_;
};

}  // namespace rheonet
