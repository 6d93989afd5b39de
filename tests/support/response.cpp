#include "tests/support/response.hpp"

#include <cmath>

namespace rheonet::test {

namespace {
// Below this, an input whose exponent is the negative rate of a lag counts as being in resonance with it. The two are
// equal but for rounding, or differ by a factor: the tests take no values in between.
constexpr double resonance = 1e-9;
}  // namespace

Response Response::constant(double value) {
  Response result;
  result.add(value, 0, 0);
  return result;
}

Response Response::ramp(double slope) {
  Response result;
  result.add(slope, 1, 0);
  return result;
}

// Both halves of sin z = (exp(iz) - exp(-iz)) / 2i are kept, not one and "the real part of": a lag of complex tau, as
// the modes of an oscillator are, does not commute with taking the real part.
Response Response::sine(double amplitude, double omega, double phase) {
  const Complex i(0, 1);
  Response result;
  result.add(amplitude / (2.0 * i) * std::exp(i * phase), 0, i * omega);
  result.add(-amplitude / (2.0 * i) * std::exp(-i * phase), 0, -i * omega);
  return result;
}

void Response::add(Complex coefficient, int power, Complex exponent) {
  if (coefficient != Complex(0)) terms_.push_back({coefficient, power, exponent});
}

Response::Complex Response::sum(double t) const {
  Complex result = 0;
  for (const Term& term : terms_) {
    result += term.coefficient * std::pow(t, term.power) * std::exp(term.exponent * t);
  }
  return result;
}

double Response::operator()(double t) const { return t < 0 ? 0 : sum(t).real(); }

Response Response::derivative() const {
  Response result;
  for (const auto& [c, m, s] : terms_) {
    result.add(c * s, m, s);
    if (m > 0) result.add(c * double(m), m - 1, s);
  }
  return result;
}

Response Response::integral(double initial) const {
  Response result;
  for (const auto& [c, m, s] : terms_) {
    if (s == Complex(0)) {
      result.add(c / double(m + 1), m + 1, 0);
      continue;
    }
    // By parts: int t^m e = t^m e/s - (m/s) int t^(m-1) e.
    Complex factor = c / s;
    for (int power = m; power >= 0; --power) {
      result.add(factor, power, s);
      factor *= -double(power) / s;
    }
  }
  result.add(initial - result.sum(0), 0, 0);
  return result;
}

Response Response::lag(Complex tau, Complex initial) const {
  Response result;
  for (const auto& [c, m, s] : terms_) {
    const Complex q = 1.0 + tau * s;
    if (std::abs(q) < resonance) {
      result.add(c / (double(m + 1) * tau), m + 1, s);
      continue;
    }
    // With y = p(t) e: tau p' + q p = t^m, solved from the highest power down.
    Complex factor = c / q;
    for (int power = m; power >= 0; --power) {
      result.add(factor, power, s);
      factor *= -double(power) * tau / q;
    }
  }
  result.add(initial - result.sum(0), 0, -1.0 / tau);
  return result;
}

// Two lags, one after the other: z = y'/r1 + y, then z'/r2 + z = this.
Response Response::second_order(Complex r1, Complex r2, double y0, double dy0) const {
  return lag(1.0 / r2, dy0 / r1 + y0).lag(1.0 / r1, y0);
}

Response operator+(const Response& a, const Response& b) {
  Response result = a;
  result.terms_.insert(result.terms_.end(), b.terms_.begin(), b.terms_.end());
  return result;
}

Response operator-(const Response& a, const Response& b) { return a + (-1.0) * b; }

Response operator*(Response::Complex factor, const Response& a) {
  Response result = a;
  for (Response::Term& term : result.terms_) term.coefficient *= factor;
  return result;
}

}  // namespace rheonet::test
