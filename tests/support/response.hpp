#pragma once

#include <complex>
#include <vector>

namespace rheonet::test {

/// A closed form in time: the real part of a sum of terms c t^m exp(s t), for t >= 0, and 0 before. These are all the
/// functions that a linear network makes of steps, ramps and sines, and they are closed under the operations below, so
/// the exact answer of a linear network can be written down as its equations are: `(B * w).lag(B / k, f0)`.
class Response {
 public:
  using Complex = std::complex<double>;
  struct Term {
    Complex coefficient;
    int power = 0;
    Complex exponent;  ///< 1/s
  };

  Response() = default;  ///< 0
  static Response constant(double value);
  static Response ramp(double slope);
  /// amplitude sin(omega t + phase)
  static Response sine(double amplitude, double omega, double phase = 0);

  double operator()(double t) const;

  Response derivative() const;
  /// From 0 on, beginning with `initial`.
  Response integral(double initial = 0) const;
  /// The y of tau y' + y = this, y(0) = initial.
  Response lag(Complex tau, Complex initial) const;
  /// The y of y''/(r1 r2) + y' (1/r1 + 1/r2) + y = this, y(0) = y0, y'(0) = dy0: modes exp(-r1 t), exp(-r2 t), where r1
  /// and r2 are real, equal, or conjugate.
  Response second_order(Complex r1, Complex r2, double y0, double dy0) const;

  friend Response operator+(const Response& a, const Response& b);
  friend Response operator-(const Response& a, const Response& b);
  friend Response operator*(Complex factor, const Response& a);
  friend Response operator*(double factor, const Response& a) { return Complex(factor) * a; }
  friend Response operator/(const Response& a, double divisor) { return Complex(1 / divisor) * a; }

 private:
  Complex sum(double t) const;
  void add(Complex coefficient, int power, Complex exponent);

  std::vector<Term> terms_;
};

}  // namespace rheonet::test
