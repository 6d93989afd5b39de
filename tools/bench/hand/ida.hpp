#pragma once

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tools/bench/hand/hand.hpp"

namespace rheonet::hand {

/// IDA with its vectors, matrix and linear solver: the common part of the hand-written programs.
class Ida {
 public:
  /// Starts from y = y' = 0. `entries`: number of nonzeros of a sparse matrix, solved with KLU; 0: a dense matrix.
  Ida(sunindextype size, sunindextype entries, IDAResFn residual, IDALsJacFn jacobian, double tolerance, double absolute) {
    SUNContext_Create(nullptr, &context);
    y = N_VNew_Serial(size, context);
    yp = N_VClone(y);
    N_VConst(0, y);
    N_VConst(0, yp);
    memory = IDACreate(context);
    check(IDAInit(memory, residual, 0, y, yp), "IDAInit");
    check(IDASStolerances(memory, tolerance, absolute), "IDASStolerances");
    matrix = entries > 0 ? SUNSparseMatrix(size, size, entries, CSC_MAT, context) : SUNDenseMatrix(size, size, context);
    solver = entries > 0 ? SUNLinSol_KLU(y, matrix, context) : SUNLinSol_Dense(y, matrix, context);
    check(IDASetLinearSolver(memory, solver, matrix), "IDASetLinearSolver");
    check(IDASetJacFn(memory, jacobian), "IDASetJacFn");
    check(IDASetMaxNumSteps(memory, 100'000'000), "IDASetMaxNumSteps");
    at_ = N_VClone(y);
  }
  ~Ida() {
    IDAFree(&memory);
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    for (N_Vector vector : {y, yp, at_}) N_VDestroy(vector);
    SUNContext_Free(&context);
  }
  Ida(const Ida&) = delete;
  Ida& operator=(const Ida&) = delete;

  static void check(int flag, const char* what) {
    if (flag < 0) throw std::runtime_error(std::string(what) + " returned " + std::to_string(flag));
  }

  double* Y() const { return N_VGetArrayPointer(y); }
  double* P() const { return N_VGetArrayPointer(yp); }

  /// One step; IDA's flag.
  int step(double end) {
    check(IDASetStopTime(memory, end), "IDASetStopTime");
    const int flag = IDASolve(memory, end, &t, y, yp, IDA_ONE_STEP);
    check(flag, "IDASolve");
    return flag;
  }
  /// Takes down row(t, y) at those of the times that the last step has reached.
  template <class Row>
  void take(const std::vector<double>& times, std::vector<std::vector<double>>& rows, Row row) {
    while (rows.size() < times.size() && times[rows.size()] <= t) {
      const double then = times[rows.size()];
      check(IDAGetDky(memory, then, 0, at_), "IDAGetDky");
      rows.push_back(row(then, N_VGetArrayPointer(at_)));
    }
  }
  long steps() const {
    long count = 0;
    IDAGetNumSteps(memory, &count);
    return count;
  }

  SUNContext context = nullptr;
  void* memory = nullptr;
  N_Vector y = nullptr, yp = nullptr;
  double t = 0;

 private:
  N_Vector at_ = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
};

/// Goes to the last of the times, and takes down row(t, y) at each of them. At every root `restart` begins anew.
template <class Row, class Restart>
Run follow(Ida& ida, const std::vector<double>& times, Row row, Restart restart) {
  Run run;
  run.rows.push_back(row(ida.t, ida.Y()));
  while (ida.t < times.back()) {
    const int flag = ida.step(times.back());
    ida.take(times, run.rows, row);
    if (flag != IDA_ROOT_RETURN) continue;
    ++run.events;
    run.steps += ida.steps();
    restart();
  }
  run.steps += ida.steps();
  return run;
}

/// The same for equations without root functions.
template <class Row>
Run follow(Ida& ida, const std::vector<double>& times, Row row) {
  return follow(ida, times, row, [] {});
}

}  // namespace rheonet::hand
