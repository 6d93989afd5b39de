// Scenes of tools/bench/peers written out by hand for IDA, as a careful engineer would: what their netlists are compared with.
//
//   bench_by_hand SCENE TOLERANCE REPEATS
//
// prints the CPU time [s] (the median of the repeats) in a first line `# cpu ...`, then rows: time and the scene's records.
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int intervals = 500;

/// Equations F(t, y, y') = 0 with their Jacobian, the start, and what a row holds.
struct Problem {
  int n;             // unknowns
  double stop;       // s
  double scale;      // of the unknowns: absolute tolerances are relative to it
  bool sparse = false, switches = false;
  Problem(int size, double end, double typical) : n(size), stop(end), scale(typical) {}
  virtual ~Problem() = default;
  virtual void start(double* y, double* yp) = 0;
  virtual void residual(double t, const double* y, const double* yp, double* r) = 0;
  virtual void jacobian(double cj, SUNMatrix J) = 0;
  virtual double event(double, const double*) { return 1; }
  virtual void change(double, double*, double*) {}
  virtual void row(double t, const double* y, double* out) = 0;
};

/// f'/k + f/B = v.
struct Maxwell final : Problem {
  const double k = 1000, B = 50, w = 2 * M_PI;
  Maxwell() : Problem(1, 10, 50) {}
  void start(double* y, double* yp) override { y[0] = yp[0] = 0; }
  void residual(double t, const double* y, const double* yp, double* r) override { r[0] = yp[0] - k * (std::sin(w * t) - y[0] / B); }
  void jacobian(double cj, SUNMatrix J) override { SM_ELEMENT_D(J, 0, 0) = cj + k / B; }
  void row(double, const double* y, double* out) override {
    out[0] = y[0];
    out[1] = 0;
  }
};

/// A block on a spring: x' = v, m v' = F(t) - k (x - V t) - friction. Friction is a slider's, its mode frozen between events.
struct Block final : Problem {
  double m, k, V, x0, F, w, Fc, Fs;
  int mode = 0;  // 0 sticks, +-1 slips in that direction
  Block(double end, double typical, double mass, double stiffness, double pull, double from, double force, double omega, double coulomb,
        double breakaway)
      : Problem(2, end, typical), m(mass), k(stiffness), V(pull), x0(from), F(force), w(omega), Fc(coulomb), Fs(breakaway) {
    switches = Fc > 0;
  }
  bool slips() const { return mode != 0 || !switches; }
  double pull(double t, double x) const { return k * (V * t - x) + F * std::sin(w * t); }
  void start(double* y, double* yp) override {
    y[0] = x0;
    y[1] = yp[0] = 0;
    choose(0, y, yp);
  }
  void choose(double t, double* y, double* yp) {
    const double f = pull(t, y[0]);
    mode = !switches || std::abs(f) <= Fs ? 0 : f > 0 ? 1 : -1;
    yp[0] = y[1];
    yp[1] = slips() ? (f - mode * Fc) / m : 0;
  }
  void residual(double t, const double* y, const double* yp, double* r) override {
    r[0] = yp[0] - y[1];
    r[1] = slips() ? m * yp[1] - pull(t, y[0]) + mode * Fc : yp[1];
  }
  void jacobian(double cj, SUNMatrix J) override {
    SM_ELEMENT_D(J, 0, 0) = cj;
    SM_ELEMENT_D(J, 0, 1) = -1;
    SM_ELEMENT_D(J, 1, 0) = slips() ? k : 0;
    SM_ELEMENT_D(J, 1, 1) = slips() ? m * cj : cj;
  }
  double event(double t, const double* y) override { return mode ? mode * y[1] : Fs - std::abs(pull(t, y[0])); }
  void change(double t, double* y, double* yp) override {
    if (mode) {
      y[1] = 0;
      choose(t, y, yp);
      return;
    }
    mode = pull(t, y[0]) > 0 ? 1 : -1;
    yp[1] = (pull(t, y[0]) - mode * Fc) / m;
  }
  void row(double t, const double* y, double* out) override {
    out[0] = k * (V != 0 ? V * t - y[0] : y[0]);
    out[1] = y[1];
  }
};

/// Masses in a chain of springs and dashpots, from the free end (number 0) to the ground. y: x_0, v_0, x_1, v_1, ...
struct Ladder final : Problem {
  static constexpr int masses = 100;
  const double m = 1e-3, k = 1e3, c = 1, F = 1;
  Ladder() : Problem(2 * masses, 0.1, 1e-2) { sparse = true; }
  void start(double* y, double* yp) override {
    std::fill_n(y, n, 0.0);
    std::fill_n(yp, n, 0.0);
    yp[1] = F / m;
  }
  void residual(double, const double* y, const double* yp, double* r) override {
    double before = F;
    for (int i = 0; i < masses; ++i) {
      const bool last = i + 1 == masses;
      const double f = k * (y[2 * i] - (last ? 0 : y[2 * i + 2])) + c * (y[2 * i + 1] - (last ? 0 : y[2 * i + 3]));
      r[2 * i] = yp[2 * i] - y[2 * i + 1];
      r[2 * i + 1] = m * yp[2 * i + 1] - before + f;
      before = f;
    }
  }
  void jacobian(double cj, SUNMatrix J) override {
    sunindextype *column = SUNSparseMatrix_IndexPointers(J), *row = SUNSparseMatrix_IndexValues(J), z = 0;
    double* value = SUNSparseMatrix_Data(J);
    const auto put = [&](int r, double x) {
      row[z] = r;
      value[z++] = x;
    };
    for (int i = 0; i < masses; ++i) {
      const int neighbours = i > 0 ? 2 : 1;
      for (const bool velocity : {false, true}) {
        const double of_force = velocity ? c : k;
        column[2 * i + velocity] = z;
        if (i > 0) put(2 * i - 1, -of_force);
        put(2 * i, velocity ? -1 : cj);
        put(2 * i + 1, neighbours * of_force + (velocity ? m * cj : 0));
        if (i + 1 < masses) put(2 * i + 3, -of_force);
      }
    }
    column[n] = z;
  }
  void row(double, const double* y, double* out) override {
    out[0] = k * (y[0] - y[2]);
    out[1] = y[1];
  }
};

std::unique_ptr<Problem> problem(const std::string& name) {
  if (name == "maxwell") return std::make_unique<Maxwell>();
  if (name == "resonance") return std::make_unique<Block>(16.6, 0.01, 0.7, 90, 0, 0, 0.02, std::sqrt(90 / 0.7), 0, 0);
  if (name == "stick-slip") return std::make_unique<Block>(100, 0.1, 1, 10, 0.1, 0, 0, 0, 1, 1.5);
  if (name == "swing") return std::make_unique<Block>(7, 0.02, 0.7, 90, 0, 40.5 * 0.05 / 90, 0, 0, 0.05, 0.05);
  if (name == "ladder") return std::make_unique<Ladder>();
  throw std::invalid_argument("no scene " + name);
}

void require(bool fine, const char* what) {
  if (!fine) throw std::runtime_error(what);
}

Problem& of(void* user) { return *static_cast<Problem*>(user); }

/// Integrates; appends rows.
void integrate(Problem& p, double tolerance, std::vector<double>& rows) {
  SUNContext context;
  require(SUNContext_Create(nullptr, &context) == 0, "SUNContext_Create");
  N_Vector y = N_VNew_Serial(p.n, context), yp = N_VNew_Serial(p.n, context);
  p.start(N_VGetArrayPointer(y), N_VGetArrayPointer(yp));
  void* ida = IDACreate(context);
  const auto residual = [](double t, N_Vector u, N_Vector up, N_Vector r, void* user) {
    of(user).residual(t, N_VGetArrayPointer(u), N_VGetArrayPointer(up), N_VGetArrayPointer(r));
    return 0;
  };
  const auto jacobian = [](double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector, N_Vector) {
    of(user).jacobian(cj, J);
    return 0;
  };
  const auto root = [](double t, N_Vector u, N_Vector, double* g, void* user) {
    g[0] = of(user).event(t, N_VGetArrayPointer(u));
    return 0;
  };
  require(IDAInit(ida, residual, 0, y, yp) == 0, "IDAInit");
  IDASetUserData(ida, &p);
  require(IDASStolerances(ida, tolerance, tolerance * p.scale) == 0, "IDASStolerances");
  SUNMatrix A = p.sparse ? SUNSparseMatrix(p.n, p.n, 4 * p.n, CSC_MAT, context) : SUNDenseMatrix(p.n, p.n, context);
  SUNLinearSolver solver = p.sparse ? SUNLinSol_KLU(y, A, context) : SUNLinSol_Dense(y, A, context);
  require(IDASetLinearSolver(ida, solver, A) == 0, "IDASetLinearSolver");
  IDASetJacFn(ida, jacobian);
  IDASetMaxNumSteps(ida, 10000000);
  IDASetInitStep(ida, 1e-8 * p.stop);
  if (p.switches) {
    const int falling = -1;
    IDARootInit(ida, 1, root);
    IDASetRootDirection(ida, const_cast<int*>(&falling));
  }
  for (int k = 0; k <= intervals; ++k) {
    const double until = k * p.stop / intervals;
    double t = 0;
    for (int flag = k == 0 ? IDA_SUCCESS : IDA_ROOT_RETURN; flag == IDA_ROOT_RETURN;) {
      flag = IDASolve(ida, until, &t, y, yp, IDA_NORMAL);
      require(flag >= 0, "IDASolve");
      if (flag != IDA_ROOT_RETURN) continue;
      p.change(t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp));
      require(IDAReInit(ida, t, y, yp) == 0, "IDAReInit");
      IDASetInitStep(ida, 1e-8 * p.stop);
    }
    double out[2];
    p.row(until, N_VGetArrayPointer(y), out);
    rows.insert(rows.end(), {until, out[0], out[1]});
  }
  IDAFree(&ida);
  SUNLinSolFree(solver);
  SUNMatDestroy(A);
  N_VDestroy(y);
  N_VDestroy(yp);
  SUNContext_Free(&context);
}

}  // namespace

int main(int count, char** arguments) try {
  require(count == 4, "usage: bench_by_hand SCENE TOLERANCE REPEATS");
  std::vector<double> seconds, rows;
  for (int repeat = 0; repeat < std::atoi(arguments[3]); ++repeat) {
    const std::unique_ptr<Problem> p = problem(arguments[1]);
    rows.clear();
    const std::clock_t begin = std::clock();
    integrate(*p, std::atof(arguments[2]), rows);
    seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  require(!seconds.empty(), "nothing to repeat");
  std::sort(seconds.begin(), seconds.end());
  std::printf("# cpu %.9g\n", seconds[seconds.size() / 2]);
  for (std::size_t i = 0; i < rows.size(); i += 3) std::printf("%.17g,%.17g,%.17g\n", rows[i], rows[i + 1], rows[i + 2]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
