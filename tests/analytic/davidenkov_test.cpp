// Davidenkov's hysteresis: loops of given amplitude by his own formula, any path by another road, and the energy of a
// loop.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::davidenkov_test {

namespace {

constexpr double sigma = 512.3, Fc = 2.71, pi = std::numbers::pi;
constexpr double exponents[] = {1.03, 1.3, 2, 2.7, 5};

/// Travel to the bound.
double bound(double n) { return n / (n - 1) * Fc / sigma; }

/// His formula: the side of the loop of amplitude a on which d grows (s = 1) or falls (s = -1).
double loop(double n, double a, double d, double s) {
  const double eta = std::pow(2 * bound(n), 1 - n);
  return sigma * (d - s * eta / n * (std::pow(std::max(0.0, a + s * d), n) - std::pow(2, n - 1) * std::pow(a, n)));
}

double first_loading(double n, double d) {
  const double X = bound(n), x = std::min(std::abs(d), X);
  return (d < 0 ? -1 : 1) * sigma * (x - std::pow(x, n) / (n * std::pow(X, n - 1)));
}

/// The same law as a bundle of Prandtl elements: those of yield travel r to r + dr have the stiffness
/// sigma (n - 1) r^(n-2)/X^(n-1) dr = -g''(r) dr, r up to X. Their deflections are a function of r of straight pieces,
/// and follow a motion exactly; no rule for loops is needed.
class Bundle {
 public:
  explicit Bundle(double n) : n_(n), X_(bound(n)), pieces_{{0, 0}, {X_, 0}} {}

  void move(double dx) {
    std::vector<Corner> after;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (k > 0) {  // new corners where a piece goes through +-r
        const Corner a = pieces_[k - 1], b = pieces_[k];
        std::vector<double> shares;
        for (const double side : {-1.0, 1.0}) {
          const double ga = a.e + dx - side * a.r, gb = b.e + dx - side * b.r;
          if (ga * gb < 0) shares.push_back(ga / (ga - gb));
        }
        std::sort(shares.begin(), shares.end());
        for (const double share : shares) {
          const double r = a.r + share * (b.r - a.r);
          after.push_back({r, std::clamp(a.e + share * (b.e - a.e) + dx, -r, r)});
        }
      }
      after.push_back({pieces_[k].r, std::clamp(pieces_[k].e + dx, -pieces_[k].r, pieces_[k].r)});
    }
    pieces_ = after;
  }

  double force() const {
    double sum = 0;
    for (std::size_t k = 1; k < pieces_.size(); ++k) {
      const auto [ra, ea] = pieces_[k - 1];
      const auto [rb, eb] = pieces_[k];
      if (rb - ra < 1e-15 * X_) continue;
      const double slope = (eb - ea) / (rb - ra);
      // The integral of (ea + slope (r - ra)) (n - 1) r^(n-2).
      sum += (ea - slope * ra) * (std::pow(rb, n_ - 1) - std::pow(ra, n_ - 1)) +
             slope * (n_ - 1) / n_ * (std::pow(rb, n_) - std::pow(ra, n_));
    }
    return sigma / std::pow(X_, n_ - 1) * sum;
  }

 private:
  struct Corner {
    double r, e;
  };
  double n_, X_;
  std::vector<Corner> pieces_;
};

std::string scene(double n, const std::string& drive, double stop, const std::string& more = "") {
  return netlist({{"sigma", sigma}, {"Fc", Fc}, {"n", n}}, R"(
[elements.drive]
at = "end"
)" + drive + R"(
[elements.friction]
type = "davidenkov"
between = ["end", "ground"]
stiffness = "sigma"
coulomb = "Fc"
exponent = "n"
)" + more,
                 stop);
}

/// Turning points in units of the travel to the bound. They contain nested loops that close one after the other, two loops that close at
/// once, the mirror of the first reversal, the continuation along the first loading, flow at the bound, and loops from the bound.
const std::vector<double> turns = {0,    0.61, -0.23, 0.37, 0.07, 0.29, -0.41, 0.53, 0.11, 0.47, 0.31, 0.57,
                                   0.19, 0.71, -0.83, 0.13, 1.47, 0.91, 1.73,  0.53, 1.21, 0.03, 2.11, -0.7};
constexpr double tick = 0.1137;  // a row falls on none of the corners

/// These, and others by chance: mostly small, at times beyond the bound.
std::vector<std::vector<double>> paths() {
  std::vector<std::vector<double>> result = {turns};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    std::vector<double> path = {0};
    for (int j = 0; j < 40; ++j) {
      path.push_back((j % 2 ? 1 : -1) * random.around(0.4, 6) + (random.below(7) ? 0 : 0.3 * random.sign()));
    }
    result.push_back(path);
  }
  return result;
}

struct Place {
  double t, x;  ///< s; in units of the travel to the bound
};

/// Checks that the force is the bundle's in a motion along straight lines between these places; two at one time are a jump.
void check_against_bundle(double n, const std::vector<Place>& places, double stop, const std::vector<std::string>& names) {
  const double X = bound(n);
  CAPTURE(n);
  std::string points;
  for (const Place& place : places) points += fmt::format("[{:.17g}, {:.17g}], ", place.t, X * place.x);
  const auto force = [&](double t) {
    Bundle bundle(n);
    for (std::size_t j = 1; j < places.size(); ++j) {
      const Place from = places[j - 1], to = places[j];
      const double share = to.t <= t ? 1 : (t - from.t) / (to.t - from.t);
      bundle.move(X * share * (to.x - from.x));
      if (share < 1) break;
    }
    return bundle.force();
  };
  Expectations expected;
  for (const std::string& name : names) expected.push_back({name, force});
  check_at_all_accuracies(scene(n, "type = \"motion\"\nposition = { table = [" + points + "] }", stop), expected);
}

}  // namespace

TEST_CASE("davidenkov: first loading, then the loop of the amplitude") {
  const double frequency = 2.13, omega = 2 * pi * frequency;
  for (const double n : exponents) {
    for (const double share : {0.27, 0.93}) {
      const double a = share * bound(n);
      CAPTURE(n);
      const auto place = [=](double t) { return a * std::sin(omega * t); };
      const auto force = [=](double t) {
        if (t < 0.25 / frequency) return first_loading(n, place(t));
        return loop(n, a, place(t), std::cos(omega * t) < 0 ? -1 : 1);
      };
      check_at_all_accuracies(
          scene(n, fmt::format("type = \"motion\"\nposition = {{ sine = {:.17g}, frequency = {} }}", a, frequency),
                1.137),
          {{"friction.force", force}, {"friction.displacement", place}});
    }
  }
}

TEST_CASE("davidenkov: along any path it is the bundle of Prandtl elements of its first loading") {
  for (const std::vector<double>& path : paths()) {
    std::vector<Place> places;
    for (std::size_t j = 0; j < path.size(); ++j) places.push_back({double(j) * tick, path[j]});
    for (const double n : exponents)
      check_against_bundle(n, places, double(path.size() - 1) * tick, {"friction.force", "drive.force"});
  }
}

TEST_CASE("davidenkov: steps go along the same curves as slow motion does") {
  for (const std::vector<double>& path : paths()) {
    std::vector<Place> places = {{0, 0}, {tick, 0}};
    for (std::size_t j = 1; j < path.size(); ++j)
      for (const double end : {double(j), double(j + 1)}) places.push_back({end * tick, path[j]});
    // No row is at a step.
    for (const double n : exponents)
      check_against_bundle(n, places, (double(path.size()) - 0.29) * tick, {"friction.force"});
  }
}

// For n = 2 the travel follows from the force: 1 - x/X = sqrt(1 - f/Fc) at first, all twice as large afterwards.
TEST_CASE("davidenkov loaded with a force below its bound") {
  const double X = bound(2), amplitude = 0.83 * Fc, frequency = 2.71, omega = 2 * pi * frequency;
  const auto travel = [=](double f, double size) { return size * X * (1 - std::sqrt(1 - f / (size * Fc))); };
  const double a = travel(amplitude, 1);
  const auto load = [=](double t) { return amplitude * std::sin(omega * t); };
  const auto displacement = [=](double t) {
    if (t < 0.25 / frequency) return travel(load(t), 1);
    const double s = std::cos(omega * t) < 0 ? -1 : 1;
    return s * (travel(amplitude + s * load(t), 2) - a);
  };
  check_at_all_accuracies(
      scene(2, fmt::format("type = \"force\"\nforce = {{ sine = {:.17g}, frequency = {} }}", amplitude, frequency),
            1.337),
      {{"friction.force", load}, {"friction.displacement", displacement}, {"end.position", displacement}});
}

TEST_CASE("davidenkov starts from a force as from a first loading, and goes either way") {
  for (const double n : exponents) {
    for (const double f0 : {1.93, -1.93}) {
      // The travel that has led to f0.
      double low = 0, high = bound(n);
      for (int k = 0; k < 200; ++k) (first_loading(n, (low + high) / 2) < std::abs(f0) ? low : high) = (low + high) / 2;
      CAPTURE(n);
      const auto force = [&](double t) {
        Bundle bundle(n);
        bundle.move(f0 < 0 ? -low : low);
        bundle.move(0.0217 * t);
        return bundle.force();
      };
      check_at_all_accuracies(scene(n, "type = \"motion\"\nvelocity = 0.0217", 1.613, fmt::format("f0 = {}\n", f0)),
                              {{"friction.force", force}});
    }
  }
}

TEST_CASE("davidenkov has the force at the start that is given, however small, and nearly that at which it flows") {
  for (const double n : {1.0000001, 1.03, 2.0})
    for (const double share : {1.3e-30, 1.3e-18, 3.7e-13, 3.7e-9, 0.0013, 0.37, 0.9999, 1 - 1e-9, 1 - 1e-15})
      for (const int s : {-1, 1}) {
        CAPTURE(n);
        CAPTURE(share);
        const double f0 = s * share * Fc;
        const std::string held = "type = \"motion\"\nposition = 0";
        const RunTable rows = simulate(scene(n, held, 1.3, fmt::format("f0 = {:.17g}\n", f0)));
        for (const double force : rows["friction.force"]) CHECK(std::abs(force - f0) <= 1e-14 * std::abs(f0));
      }
}

TEST_CASE("davidenkov: the heat of a loop, and nothing stored by a whole number of them") {
  const double n = 2.7, X = bound(n), a = 0.73 * X, frequency = 2.13;
  const double eta = std::pow(2 * X, 1 - n);
  const double per_loop = sigma * eta * std::pow(2 * a, n + 1) * (n - 1) / (n * (n + 1));
  double dissipated[2], stored[2];
  for (int cycles : {2, 5}) {
    SceneBuilder b;
    b.motion("drive", "end", "position", rheonet::Signal(rheonet::Signal::Sine{a, frequency, 0, 0, 0}));
    b.between("friction", "davidenkov", "end", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", n}});
    rheonet::Summary summary;
    simulate(b.finish((cycles + 0.37) / frequency, 10, 1e-6), &summary);
    dissipated[cycles == 5] = summary.dissipated;
    stored[cycles == 5] = summary.stored;
  }
  CHECK(dissipated[1] - dissipated[0] == doctest::Approx(3 * per_loop).epsilon(1e-5));
  CHECK(std::abs(stored[1] - stored[0]) < 1e-5 * per_loop);
}

}  // namespace rheonet::test::davidenkov_test
