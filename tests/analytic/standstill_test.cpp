// Combined friction at standstill. The massless node between a spring and a cfm may reach w = 0 where the law for w > 0 would move it back
// and the law for w < 0 forward. Then it stays at rest (Filippov's solution) until the force has changed. The reference below is integrated
// in fine steps, with every change of direction at the end of a step.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/check.hpp"

namespace rheonet::test::standstill_test {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double stop = 1.093;
constexpr int rows = 201;

/// df/dt = E (w - f/B), with E = k of a spring, else E = sigma (1 - s f/Fc)^i.
struct Element {
  std::string toml;
  double stiffness, coulomb = infinite, exponent = 1, damping = infinite;

  /// df/dt at velocity w in the direction s.
  double rate(double f, double w, int s) const { return slope(f, s) * (w - f / damping); }
  double slope(double f, int s) const {
    return std::isinf(coulomb) ? stiffness : stiffness * std::pow(1 - s * f / coulomb, exponent);
  }
};

Element spring(double k) { return {fmt::format("type = \"spring\", stiffness = {}", k), k}; }
Element sfm(double sigma, double Fc, double i) {
  return {fmt::format("type = \"sfm\", stiffness = {}, coulomb = {}, exponent = {}", sigma, Fc, i), sigma, Fc, i};
}
Element cfm(double sigma, double Fc, double i, double B) {
  return {fmt::format("type = \"cfm\", stiffness = {}, coulomb = {}, exponent = {}, damping = {}", sigma, Fc, i, B),
          sigma, Fc, i, B};
}

using Link = std::vector<Element>;  ///< elements in parallel
using Chain = std::vector<Link>;    ///< links in series, from `end` to the ground

/// Where a link stands still, both directions have a part in it: `forward` that of w > 0.
struct Going {
  double w, forward;
  int direction() const { return w > 0 ? 1 : w < 0 ? -1 : 0; }
};

class Reference {
 public:
  Reference(Chain chain, Exact velocity) : chain_(std::move(chain)), velocity_(std::move(velocity)) {
    for (const Link& link : chain_) y_.resize(y_.size() + link.size() + 1);  // forces, then the displacement
    const double interval = stop / (rows - 1), longest = interval / 64, shortest = 1e-11 * stop;
    double h = longest;
    keep();
    for (int row = 1; row < rows; ++row) {
      while (t_ < row * interval) {
        const double left = row * interval - t_;
        const bool last = h >= left;
        const double step = last ? left : h;
        const std::vector<double> y = runge_kutta(step);
        if (step > shortest && directions(t_ + step, y) != directions(t_, y_)) {
          h = step / 2;
          continue;
        }
        t_ = last ? row * interval : t_ + step;
        y_ = y;
        h = std::min(2 * h, longest);
      }
      keep();
    }
  }

  struct Row {
    std::vector<double> y;
    std::vector<Going> going;
  };
  const std::vector<Row>& table() const { return table_; }

  /// The number of rows, after the first, in which a link stands still.
  long still_rows(std::size_t link) const {
    return std::count_if(table_.begin() + 1, table_.end(), [=](const Row& row) { return row.going[link].w == 0; });
  }

 private:
  /// Rate of the force of a link, of whose elements `f` points to the first force.
  static double rate(const Link& link, const double* f, double w, int s) {
    double sum = 0;
    for (const Element& element : link) sum += element.rate(*f++, w, s);
    return sum;
  }
  /// Its velocity when its force changes at the rate `total`: one line on each side of standing still.
  static Going going(const Link& link, const double* f, double total) {
    const double forth = rate(link, f, 0, 1), back = rate(link, f, 0, -1);
    if (total > forth) return {(total - forth) / (rate(link, f, 1, 1) - forth), 1};
    if (total < back) return {(total - back) / (back - rate(link, f, -1, -1)), 0};
    return {0, forth > back ? (total - back) / (forth - back) : 0.5};
  }

  /// All links carry the same force. Its rate is that at which their velocities add up to that of the drive: a sum of
  /// rising functions, straight between the rates at which a link starts or stops.
  std::vector<Going> solve(double t, const std::vector<double>& y) const {
    std::vector<double> rates;
    const double* f = y.data();
    for (const Link& link : chain_) {
      rates.insert(rates.end(), {rate(link, f, 0, 1), rate(link, f, 0, -1)});
      f += link.size() + 1;
    }
    std::sort(rates.begin(), rates.end());
    const double v = velocity_(t);
    const auto speed = [&](double total) {
      double sum = 0;
      for (const Going& one : all(y, total)) sum += one.w;
      return sum;
    };
    std::size_t j = 0;
    while (j < rates.size() && speed(rates[j]) < v) ++j;
    const double low = j == 0 ? rates.front() - 1e3 : rates[j - 1];
    const double high = j == rates.size() ? rates.back() + 1e3 : rates[j];
    const double w0 = speed(low), w1 = speed(high);
    return all(y, w1 > w0 ? low + (high - low) * (v - w0) / (w1 - w0) : low);
  }
  std::vector<Going> all(const std::vector<double>& y, double total) const {
    std::vector<Going> result;
    const double* f = y.data();
    for (const Link& link : chain_) {
      result.push_back(going(link, f, total));
      f += link.size() + 1;
    }
    return result;
  }
  std::vector<int> directions(double t, const std::vector<double>& y) const {
    std::vector<int> result;
    for (const Going& one : solve(t, y)) result.push_back(one.direction());
    return result;
  }

  std::vector<double> derivative(double t, const std::vector<double>& y) const {
    std::vector<double> result;
    const std::vector<Going> links = solve(t, y);
    for (std::size_t l = 0; l < chain_.size(); ++l) {
      const auto& [w, forward] = links[l];
      for (const Element& element : chain_[l]) {
        const double f = y[result.size()];
        result.push_back(forward * element.rate(f, w, 1) + (1 - forward) * element.rate(f, w, -1));
      }
      result.push_back(w);
    }
    return result;
  }
  std::vector<double> runge_kutta(double h) const {
    const auto ahead = [&](double c, const std::vector<double>& k) {
      std::vector<double> y = y_;
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += c * k[i];
      return y;
    };
    const auto k1 = derivative(t_, y_), k2 = derivative(t_ + h / 2, ahead(h / 2, k1)),
               k3 = derivative(t_ + h / 2, ahead(h / 2, k2)), k4 = derivative(t_ + h, ahead(h, k3));
    std::vector<double> y = y_;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return y;
  }
  void keep() { table_.push_back({y_, solve(t_, y_)}); }

  Chain chain_;
  Exact velocity_;
  double t_ = 0;
  std::vector<double> y_;
  std::vector<Row> table_;
};

/// Moves the chain back and forth, with four turns within the run. The links `still` must stand still at each turn.
void check_chain(const Chain& chain, const std::vector<std::size_t>& still) {
  const double speed = 0.263, frequency = 2.3;
  const Reference reference(chain, [=](double t) { return speed * std::sin(2 * std::numbers::pi * frequency * t); });
  for (const std::size_t link : still) CHECK_GE(reference.still_rows(link), 4);

  std::string elements = fmt::format(
      "[elements]\ndrive = {{ type = \"motion\", at = \"end\", velocity = {{ sine = {}, frequency = {} }} }}\n", speed,
      frequency);
  const auto column = [&](const auto& pick) {
    return [&reference, pick](double t) {
      return pick(reference.table()[std::size_t(std::lround(t / stop * (rows - 1)))]);
    };
  };
  Expectations expected;
  std::size_t index = 0;
  for (std::size_t l = 0; l < chain.size(); ++l) {
    const std::string from_node = l == 0 ? "end" : fmt::format("n{}", l);
    const std::string to_node = l + 1 == chain.size() ? "ground" : fmt::format("n{}", l + 1);
    std::string name;
    for (const Element& element : chain[l]) {
      name = fmt::format("e{}", index);
      elements += fmt::format("{} = {{ between = [\"{}\", \"{}\"], {} }}\n", name, from_node, to_node, element.toml);
      expected.push_back({name + ".force", column([index](const auto& row) { return row.y[index]; })});
      ++index;
    }
    expected.push_back({name + ".displacement", column([index](const auto& row) { return row.y[index]; })});
    expected.push_back({name + ".velocity", column([l](const auto& row) { return row.going[l].w; })});
    ++index;
  }
  check_at_all_accuracies(netlist({}, elements, stop, rows), expected);
}

}  // namespace

TEST_CASE("cfm behind a spring stands still") {
  for (const double exponent : {0.5, 1.0, 1.5, 2.0, 3.0}) {
    CAPTURE(exponent);
    check_chain({{spring(137.3)}, {cfm(512.3, 2.71, exponent, 17.9)}}, {1});
    check_chain({{cfm(512.3, 2.71, exponent, 17.9)}, {spring(73.1)}}, {0});
  }
}

TEST_CASE("cfm behind a spring and solid friction stands still") {
  check_chain({{spring(137.3)}, {sfm(391.7, 2.93, 1)}, {cfm(512.3, 2.71, 1.5, 17.9)}}, {2});
  check_chain({{sfm(391.7, 2.93, 2)}, {cfm(512.3, 2.71, 1, 17.9)}, {spring(137.3)}}, {1});
}

TEST_CASE("Two cfm in series, each stands still in its time") {
  check_chain({{cfm(611.9, 3.17, 2, 21.3)}, {spring(97.3)}, {cfm(512.3, 2.71, 1, 17.9)}}, {0, 2});
}

TEST_CASE("cfm beside others stands still") {
  check_chain({{spring(137.3)}, {cfm(512.3, 2.71, 1, 17.9), spring(31.7)}}, {1});
  check_chain({{spring(137.3)}, {cfm(512.3, 1.71, 1, 17.9), sfm(217.9, 1.13, 1.5)}}, {1});
  check_chain({{spring(137.3)}, {cfm(312.3, 1.71, 1.5, 17.9), cfm(217.9, 1.37, 1, 7.7)}}, {1});
  check_chain(
      {{spring(137.3)}, {cfm(312.3, 1.71, 1.5, 17.9), cfm(217.9, 1.37, 3, 7.7), sfm(83.7, 0.71, 1), spring(19.3)}},
      {1});
}

}  // namespace rheonet::test::standstill_test
