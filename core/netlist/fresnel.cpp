#include "core/netlist/fresnel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace rheonet {

namespace {

using Complex = std::complex<double>;

/// 10-point Gauss-Legendre rule on [-1, 1] (Abramowitz and Stegun, table 25.4), the positive half: abscissa, weight.
constexpr std::pair<double, double> gauss[] = {{0.14887433898163121088, 0.29552422471475287017},
                                               {0.43339539412924719080, 0.26926671930999635509},
                                               {0.67940956829902440623, 0.21908636251598204400},
                                               {0.86506336668898451073, 0.14945134915058059315},
                                               {0.97390652851717172008, 0.06667134430868813759}};
// 10 points integrate a quarter turn to round-off, even if the frequency passes through 0.
constexpr double panel_angle = std::numbers::pi / 2;
// Largest number of panels. Longer intervals take the closed form, a difference of two tails, which loses digits over less
// than a turn.
constexpr double most_panels = 4;

/// sin(phase + omega t + chirp t^2/2).
struct Sweep {
  double phase, omega, chirp;

  double angle(double t) const { return phase + (omega + chirp * t / 2) * t; }

  /// The integral from a to b of this function times (b - t)^power.
  double by_panels(double a, double b, double panels, int power = 0) const {
    const double half = (b - a) / panels / 2;
    double sum = 0;
    for (double panel = 0; panel < panels; ++panel) {
      const double centre = a + (2 * panel + 1) * half;
      for (const auto& [x, weight] : gauss)
        for (const double t : {centre - x * half, centre + x * half}) sum += weight * (power == 0 ? 1 : b - t) * std::sin(angle(t));
    }
    return half * sum;
  }

  /// Panels that the interval takes.
  double panels(double a, double b) const {
    return std::max(1.0, std::ceil(std::max(std::abs(omega + chirp * a), std::abs(omega + chirp * b)) * std::abs(b - a) / panel_angle));
  }

  /// Integral from t to infinity, for chirp > 0; the frequency at t is `rate` >= 0 [rad/s].
  double tail(double t, double rate) const {
    const double root = std::sqrt(chirp);
    return (std::polar(1.0, angle(t)) * fresnel_tail(rate / root)).imag() / root;
  }
};

}  // namespace

// F(x), which is 1/sqrt(pi) exp(-i pi/4) times the integral of exp(i t^2) from x to infinity, by the trapezium rule,
// corrected for the poles of the integrand: Alazah, Chandler-Wilde and La Porte, Numer. Math. 128 (2014) 635, equation
// (11), with G(z) = sqrt(2 pi) exp(i (pi/4 - x^2)) F(x), x = z/sqrt(2).
Complex fresnel_tail(double z) {
  constexpr double furthest = 1e9;  // beyond, G is i/z to round-off: the next term of its series is 1/z^3
  if (z > furthest) return {0, 1 / z};
  struct Node { double t2, weight; };
  constexpr int nodes = 12;  // the error is below round-off for all x
  static const double A = std::sqrt((nodes + 0.5) * std::numbers::pi);
  static const std::array<Node, nodes> table = [] {
    std::array<Node, nodes> result;
    for (int k = 0; k < nodes; ++k) {
      const double t = (k + 0.5) * std::numbers::pi / A;
      result[static_cast<std::size_t>(k)] = {t * t, std::exp(-t * t)};
    }
    return result;
  }();
  static const Complex factor = std::polar(std::sqrt(2 * std::numbers::pi), std::numbers::pi / 4);
  const double x = z / std::numbers::sqrt2, x2 = x * x;
  Complex sum = 0;
  for (const auto& [t2, weight] : table) {
    const double share = weight / (x2 * x2 + t2 * t2);
    sum += Complex(share * x2, -share * t2);
  }
  // The residue of the poles. Beyond this exponent it is negligible, and exp would finally overflow.
  constexpr double last_residue = 40;  // exp(-40) is below round-off of the sum
  const double exponent = std::numbers::sqrt2 * A * x;
  const Complex residue = exponent > last_residue ? 0 : std::polar(1.0, -x2) / (1.0 + std::polar(std::exp(exponent), -exponent));
  return factor * (residue + std::polar(x / A, std::numbers::pi / 4) * sum);
}

double integral_of_chirp(double phase, double omega, double chirp, double a, double b) {
  if (chirp < 0) return -integral_of_chirp(-phase, -omega, -chirp, a, b);
  if (b < a) return -integral_of_chirp(phase, omega, chirp, b, a);
  const Sweep sweep{phase, omega, chirp};
  const double before = omega + chirp * a, after = omega + chirp * b;
  const double panels = sweep.panels(a, b);
  if (panels <= most_panels) return sweep.by_panels(a, b, panels);
  if (before >= 0) return sweep.tail(a, before) - sweep.tail(b, after);
  // In mirrored time the frequency also rises from its zero towards earlier times.
  const Sweep mirrored{phase, -omega, chirp};
  if (after <= 0) return mirrored.tail(-b, -after) - mirrored.tail(-a, -before);
  const double turn = -omega / chirp;
  return (mirrored.tail(-turn, 0) - mirrored.tail(-a, -before)) + (sweep.tail(turn, 0) - sweep.tail(b, after));
}

// With the angle phi, (b - t) sin(phi) = (phi'(b) sin(phi) - phi' sin(phi))/chirp.
double area_of_chirp(double phase, double omega, double chirp, double a, double b) {
  const Sweep sweep{phase, omega, chirp};
  if (const double panels = sweep.panels(a, b); panels <= most_panels) return sweep.by_panels(a, b, panels, 1);
  return ((omega + chirp * b) * integral_of_chirp(phase, omega, chirp, a, b) + std::cos(sweep.angle(b)) - std::cos(sweep.angle(a))) / chirp;
}

}  // namespace rheonet
