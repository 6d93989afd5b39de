#pragma once

#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>

#include <vector>

namespace rheonet {

/// When Newton's iteration of an integrator's step has come to its solution: as near as a share of the step's allowed error,
/// or as near as rounding lets it.
class NewtonTest {
 public:
  /// `y` is the iterate, and a change of unknown i below `grain[i]` is noise; they are read whenever there is a test. Where the
  /// equations are `rough` (a power law's, near rest) one small change shows nothing. All of them outlive the test.
  NewtonTest(const std::vector<double>& y, const std::vector<double>& grain, bool rough);
  NewtonTest(const NewtonTest&) = delete;
  NewtonTest& operator=(const NewtonTest&) = delete;

  /// Puts this test before the one that IDA has given to its `newton` iteration. SUNDIALS' error, or 0.
  int attach(SUNNonlinearSolver newton);

 private:
  int smooth(SUNNonlinearSolver newton, N_Vector sum, N_Vector change, double tolerance, N_Vector weight) const;
  int rough(SUNNonlinearSolver newton, N_Vector change, double tolerance, N_Vector weight);
  bool turns_back(N_Vector change, N_Vector weight) const;
  double rounding(N_Vector weight) const;

  const std::vector<double>& y_;
  const std::vector<double>& grain_;
  bool rough_;
  SUNNonlinSolConvTestFn ida_test_ = nullptr;
  void* ida_data_ = nullptr;
  std::vector<double> last_change_;
  double first_change_ = 0;  // as a norm
};

}  // namespace rheonet
