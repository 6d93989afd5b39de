#include <algorithm>
#include <cmath>
#include <vector>

#include "components/spring_to_slider.hpp"
#include "core/netlist/scene.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// Davidenkov's hysteresis. With x the travel on the first loading, and X = n/(n - 1) Fc/sigma the travel to the bound,
//
//     g(x) = sigma (x - x^n/(n X^(n-1))),   g(X) = Fc,   g'(X) = 0;  Fc beyond
//
// and every branch after a reversal at (p_r, f_r) is the same curve scaled by 2: f = f_r + 2 s g(s (p - p_r)/2) (Masing).
// In a cycle of amplitude a this is Davidenkov's loop sigma [d -/+ (eta/n) ((a +/- d)^n - 2^(n-1) a^n)] with
// eta = (2 X)^(1-n). A branch that returns to the point where an earlier branch turned continues that earlier branch
// (Madelung), so the memory consists of the reversals that are still open.
//
// The law is a bundle of Prandtl elements of all yield travels up to X (Iwan), which gives the energies. With z = x/X on
// the first loading, and half of that after a reversal, the heat per travel is Fc z^n.
struct Davidenkov {
  static constexpr bool creeping = false;

  struct Reversal {
    double p, f, stored;
  };

  double sigma;  // N/m
  double Fc;     // N
  double n;      // exponent
  double X;      // m

  double s = 1;                // direction of motion
  bool virgin = true;          // the outermost entry of `open` is the unloaded state, where no loop begins
  std::vector<Reversal> open;  // outermost first; the present branch begins at the last. Empty: the force is at its bound

  explicit Davidenkov(std::span<const double> v) : sigma(v[0]), Fc(v[1]), n(v[2]), X(n / (n - 1) * Fc / sigma) {
    begin(0, std::isnan(v[3]) ? 0 : v[3]);
  }

  // g(x) = sigma x secant(x/X) and g'(x) = sigma tangent(x/X): 1 - z^(n-1)/n and 1 - z^(n-1), without cancellation for n
  // near 1.
  double secant(double z) const { return -std::expm1((n - 1) * std::log(z) - std::log(n)); }
  double tangent(double z) const { return -std::expm1((n - 1) * std::log(z)); }

  double size() const { return virgin && open.size() == 1 ? 1 : 2; }
  double travelled(double p) const { return s * (p - open.back().p); }

  template <class T>
  T force(const T& p) const {
    if (open.empty()) return T(s * Fc);
    const Reversal& r = open.back();
    const double z = s / size() * (value_of(p) - r.p) / X;
    // A branch has no states behind its reversal. Solver iterates may go there: continue along the tangent.
    if (z <= 0) return r.f + sigma * (p - r.p);
    if (z >= 1) return T(r.f + s * size() * Fc);
    return r.f + s * size() * sigma * X * z * secant(z) + sigma * tangent(z) * (p - value_of(p));
  }
  template <class T>
  T creep(const T&) const {
    return T(0.0);
  }
  double slope_along(double p, int direction) const {
    if (direction != s) return sigma;
    return open.empty() ? 0 : sigma * tangent(part(p));
  }
  bool constant() const { return open.empty(); }
  int direction() const { return s < 0 ? -1 : 1; }

  // Root of z secant(z) = wanted, for 0 < wanted < (n-1)/n. The logarithm of the left side is a concave function of ln z
  // with a slope of at most 1. Started from z = wanted, which is too small, Newton's method therefore rises without passing
  // the root, whatever the size of z. At worst, near z = 1 where the slope is 0, each step halves the error.
  double part_under(double wanted) const {
    constexpr double rounding = 4e-16;  // of z, relative
    constexpr int most_steps = 100;     // twice the bits of a double, for steps that halve the error
    double z = wanted;
    for (int i = 0; i < most_steps && z < 1; ++i) {
      const double step = secant(z) / tangent(z) * std::log(wanted / (z * secant(z)));
      if (!(step > rounding)) break;
      z = std::min(1.0, z * std::exp(step));
    }
    return z;
  }

  // Loads from the unloaded state to the force f, reached at deflection p.
  void begin(double p, double f) {
    s = f < 0 ? -1 : 1;
    virgin = std::abs(f) < Fc;
    open.clear();
    if (!virgin) return;
    const double z = f == 0 ? 0 : part_under(std::abs(f) / (sigma * X));
    open.push_back({p - s * z * X, 0, 0});
  }
  double start(double) const { return 0; }
  double start_with(double f) {
    begin(0, f);
    return 0;
  }
  DeflectionBatch::Steady steady() const { return {Fc, 0, Fc}; }
  double settle(double p, double f, int direction) {
    begin(p, f);
    set_direction(p, 0, direction);
    return p;
  }

  // Travel at which the present branch ends, because it meets the branch before it or reaches the bound.
  double closing() const {
    if (open.size() == 1) return size() * X;
    const double loop = std::abs(open.back().p - open[open.size() - 2].p);
    return virgin && open.size() == 2 ? 2 * loop : loop;  // the first loading continues from the mirror point of its reversal
  }
  // Narrower loops are ignored, because their ends cannot be distinguished. In travel the width is a few units of round-off
  // of the deflection; in force, even for n near 1 where X is long, z (1 - ln z) = 3e-12 of Fc.
  double narrow(double p) const {
    constexpr double narrow_part = 1e-13, place_rounding = 1e-15;
    return narrow_part * X + place_rounding * std::abs(p);
  }

  void close() {
    if (open.size() == 1) {
      open.clear();
      virgin = false;
    } else {
      open.pop_back();
      if (!(virgin && open.size() == 1)) open.pop_back();
    }
  }
  void turn(double p) {
    if (!open.empty() && closing() - travelled(p) <= narrow(p)) close();
    if (open.empty()) {
      open.push_back({p, s * Fc, stored_energy(p)});
    } else if (travelled(p) > narrow(p)) {
      open.push_back({p, force(p), stored_energy(p)});
    } else if (size() == 2) {  // turned again where it had just turned: undo the reversal
      open.pop_back();
    }
    s = -s;
  }

  int event_count() const { return 2; }
  void event_functions(double p, double, double w, double dead_band, double* g) const {
    g[0] = s * w + dead_band;  // reversal
    g[1] = open.empty() ? 1 : closing() - travelled(p);
  }
  void switch_memory(int which, double p, double) {
    if (which == 0) {
      turn(p);
    } else {
      close();
    }
  }
  bool fits(double w) const { return w * s >= 0; }
  bool set_direction(double p, double, int direction) {
    if (direction == 0 || direction == s) return false;
    turn(p);
    return true;
  }
  bool can_hold() const { return false; }
  void hold_rates(const Dual&, Dual&, Dual&) const {}
  bool hold(double, int) { return false; }
  bool holds() const { return false; }

  // Updates the memory for a motion from p to p + step; returns the heat.
  double follow(double p, double step) {
    if (step == 0) return 0;
    set_direction(p, step, step < 0 ? -1 : 1);
    double heat = 0, left = std::abs(step);
    while (!open.empty()) {
      const double x = travelled(p), end = std::min(x + left, closing());
      heat += heat_until(end) - heat_until(x);
      if (x + left < closing()) return heat;
      left -= std::max(0.0, end - x);
      p += s * std::max(0.0, end - x);
      close();
    }
    return heat + Fc * left;
  }
  double jump(double p, double step) { return follow(p, step); }

  // Part z of the travel to the bound.
  double part(double p) const { return std::clamp(travelled(p) / (size() * X), 0.0, 1.0); }
  // Heat on the present branch up to the travel x.
  double heat_until(double x) const {
    return Fc * std::max(x, 0.0) * std::pow(std::clamp(x / (size() * X), 0.0, 1.0), n) / (n + 1);
  }
  double stored_energy(double p) const {
    if (open.empty()) return sigma * X * X * (n - 1) / (2 * (n + 1));  // all elements of the bundle have yielded
    const double x = std::min(travelled(p), size() * X);
    const double work = s * open.back().f * x + sigma * x * x * (0.5 - std::pow(part(p), n - 1) / (n * (n + 1)));
    return open.back().stored + work - heat_until(x);
  }
  double dissipated_power(double p, double, double w) const {
    return s * w * Fc * (open.empty() ? 1 : std::pow(part(p), n));
  }
};

const RegisterComponent register_davidenkov({
    .declaration =
        {
            .type = "davidenkov",
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .may_be_infinite = true,
                     .symbol = "sigma",
                     .description = "slope df/dd at the start and just after each reversal; 0 means no force"},
                    {.name = "coulomb", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true,
                     .symbol = "Fc",
                     .description = "force at which the slope is 0 and the element flows; 0 means no force"},
                    {.name = "exponent", .quantity = Quantity::number, .fallback = 2.0, .lower = 1,
                     .may_be_infinite = true, .symbol = "n",
                     .description = "shape of the loop: 2 is made of parabolas, inf is Prandtl's elastic-plastic law"},
                    {.name = "f0", .quantity = Quantity::force, .kind = Parameter::Kind::initial, .lower = -infinity,
                     .symbol = "f0",
                     .description = "force at the start (0 unless given), reached by a first loading, within +-Fc"},
                },
            .check = start_within_bound,
            .effects = friction_effects(),
            .summary = "Davidenkov's hysteresis: elastic to plastic along power curves, the same loops at any speed",
            .law = "f = f_r + 2 s g(abs(d - d_r)/2) after a reversal,  g(x) = sigma (x - x^n/(n X^(n-1)))",
            .equation = R"(f = f_r + 2 s\,g\!\left(\frac{|d - d_r|}{2}\right)\ \text{after a reversal},\qquad g(x) = \sigma\left(x - \frac{x^{n}}{n X^{n-1}}\right))",
            .source = "N. N. Davidenkov 1938 (Zh. Tekh. Fiz. 8, 483); nested loops: G. Masing 1926, E. Madelung 1905; "
                      "energies: W. D. Iwan 1966; P. L. Dahl 1982, Fig. 1",
            .notes = "First loading: f = s g(abs(d)), up to Fc at d = X = n/(n-1) Fc/sigma, and constant from there.\n"
                     "After each reversal the force follows the same curve from the turning point (d_r, f_r), scaled by 2 in both "
                     "directions. Where an inner loop closes, the force continues on the branch that the loop had left.\n"
                     "A cycle of amplitude a < X is Davidenkov's loop f = sigma [d -/+ (eta/n) ((a +/- d)^n - 2^(n-1) a^n)] with "
                     "eta = (2 X)^(1-n), upper signs while d grows. The element does not need to know the amplitude.\n"
                     "For a given eta choose coulomb = sigma (n-1)/(2 n) eta^(-1/(n-1)).\n"
                     "A loop dissipates sigma eta (2 a)^(n+1) (n-1)/(n (n+1)).\n"
                     "With `exponent = inf` the law is an `sfm` of exponent 0.",
        },
    .role = Role::deflection,
    .limits = spring_to_slider({{.when = "exponent = inf", .becomes = "sfm",
                                 .applies = [](std::span<const double> v) { return std::isinf(v[2]); },
                                 .values = [](std::span<const double> v) {
                                   return std::vector<double>{v[0], v[1], 0, v[3]};
                                 }}}),
    .deflection = deflection_batch<Davidenkov>,
    .drawing = {.outline = "M.14 .24 H.86 V.76 H.14 Z",
                .lines = "M0 .5 H.14 M.86 .5 H1 M.26 .68 C.3 .42 .46 .34 .74 .32 C.7 .58 .54 .66 .26 .68 Z",
                .thin = "M.5 .29 V.71 M.22 .5 H.78"},
});

}  // namespace
}  // namespace rheonet
