#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/solve/linear_solver.hpp"

namespace rheonet {

/// Newton's iteration for the equations of an integrator's step, up to a share of the step's allowed error, or as near as
/// rounding lets it. Jacobians are kept as long as the coefficient cj of the step is about the same.
class Newton {
 public:
  /// A change of unknown i below `grain[i]` is noise; `tolerance` is as for LinearSolver. All of them outlive this.
  Newton(Dae& dae, bool sparse, const std::vector<double>& tolerance, const std::vector<double>& grain);

  /// From here on nothing is known of the equations. Counts begin anew.
  void restart();

  /// A step to t. It ends at y = predicted_y + c, y' = predicted_yp + cj c, with the correction c that is looked for.
  struct Step {
    double t, cj;
    const double *predicted_y, *predicted_yp;
    double *y, *yp;  ///< where an iterate is held
  };
  /// Finds c, from 0 on, until the next change, each unknown times its weight, is foreseen to be no more than `enough` as a root
  /// mean square. False if it does not converge.
  [[nodiscard]] bool solve(const Step& step, double* correction, const double* weight, double enough);

  struct Counts {
    long residuals = 0, jacobians = 0;
    long failures = 0;  ///< iterations that did not converge, also those that did with a new Jacobian
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
  double jacobian_cj_ = 0;  // of the Jacobian; 0: there is none
  double last_cj_ = 0;      // of the last step
  double foreseen_ = 0;     // what is left after a change, in parts of it
  double first_change_ = 0; // as a norm
  std::vector<double> change_;
  std::vector<double> last_change_;  // of rough equations
  Counts counts_;
};

}  // namespace rheonet
