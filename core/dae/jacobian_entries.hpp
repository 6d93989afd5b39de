#pragma once

#include <utility>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/matrix.hpp"

namespace rheonet {

/// The entries of the Jacobian dF/dy + cj dF/dy' that are constant, or plus or minus the slope of a law; and its pattern. First entries are
/// reserved in any order, others with a ticket; then `build` gives each a place.
class JacobianEntries {
 public:
  struct Constant { int entry; double value; };
  enum class Source : char { force, rate };  ///< The slope of a deflection law, or of a rate law.
  using Sign = signed char;

  /// A constant entry of dF/dy; none in a column below 0.
  void put(int row, int column, double value) {
    if (column >= 0) constants_.push_back({builder_.ticket(row, column), value});
  }
  /// A constant entry of dF/dy'; none in a row or column below 0.
  void put_mass(int row, int column, double mass) {
    if (mass != 0 && row >= 0 && column >= 0) masses_.push_back({builder_.ticket(row, column), mass});
  }
  void depend(int row, int column, Source source, int index, Sign sign) {
    if (row >= 0 && column >= 0) scatter_.push_back({builder_.ticket(row, column), index, source, sign});
  }
  PatternBuilder& builder() { return builder_; }
  /// Before `build`: the constant entries of dF/dy' so far, which the caller replaces by the ones that it puts.
  std::vector<Constant> withdraw_masses() { return std::exchange(masses_, {}); }
  void put_back(const Constant& mass) { masses_.push_back(mass); }

  /// Builds the pattern. Returns the entry of each ticket.
  std::vector<int> build(int size);
  const Pattern& pattern() const { return pattern_; }
  const std::vector<Constant>& masses() const { return masses_; }
  void add_constants(double* values) const {
    for (const Constant& c : constants_) values[c.entry] += c.value;
  }
  void add_slopes(const std::vector<double>& of_forces, const std::vector<double>& of_rates, double* values) const {
    for (const Scatter& s : scatter_) values[s.entry] += s.sign * (s.source == Source::force ? of_forces : of_rates)[at(s.index)];
  }

 private:
  struct Scatter { int entry, index; Source source; Sign sign; };

  PatternBuilder builder_;  ///< Empty after `build`.
  Pattern pattern_;
  std::vector<Constant> constants_, masses_;
  std::vector<Scatter> scatter_;
};

}  // namespace rheonet
