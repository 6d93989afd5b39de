#include "core/netlist/homogeneity.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "core/netlist/characters.hpp"

namespace rheonet {

namespace {

using Function = std::function<double(const std::vector<double>&)>;

enum Base { metre, kilogram, second, radian, hertz, base_count };
using Powers = std::array<double, base_count>;

Powers powers_of(const Number& number) {
  return {number.dimension.metre, number.dimension.kilogram, number.dimension.second, number.radian, number.hertz};
}

/// One point at which a function is tried, in changing units.
class Trial {
 public:
  Trial(const Function& function, const std::vector<Number>& parameters, std::vector<double> point)
      : function_(function), parameters_(parameters), point_(std::move(point)), value_(function_(point_)) {}

  bool says_something() const { return std::isfinite(value_) && value_ != 0; }

  std::optional<Exponents> exponents() const {
    Powers found{};
    for (int base = 0; base < base_count; ++base) {
      const auto exponent = exponent_of(static_cast<Base>(base));
      if (!exponent && base < radian) return std::nullopt;
      found[static_cast<std::size_t>(base)] = exponent.value_or(0);
    }
    const auto [m, kg, s, rad, hz] = found;
    // All at once: what is homogeneous in one unit at a time at this point may not be so at another.
    const Powers log_scales{4, -6, 10, 0, 0};
    const auto ratio = log_ratio(log_scales);
    if (!ratio || std::abs(*ratio - (4 * m - 6 * kg + 10 * s)) > tolerance * 20) return std::nullopt;
    return Exponents{{m, kg, s}, rad, hz, false};
  }

 private:
  // Units change by powers of 4: sums, products and square roots then scale without rounding, however much cancels.
  static constexpr double log_scale = 2;
  // Large enough to turn most comparisons of unlike things round.
  static constexpr double large_log_scale = 30;
  // Far above the rounding of a fractional power, far below the exponent of anything that was typed.
  static constexpr double tolerance = 1e-9;

  /// log2 of the factor by which the value grows; absent if it vanishes or changes sign. Overflow proves nothing: NaN.
  std::optional<double> log_ratio(const Powers& log_scales) const {
    std::vector<double> scaled = point_;
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      const Powers powers = powers_of(parameters_[i]);
      double exponent = 0;
      for (std::size_t b = 0; b < base_count; ++b) exponent += powers[b] * log_scales[b];
      scaled[i] *= std::exp2(exponent);
    }
    const double ratio = function_(scaled) / value_;
    if (ratio <= 0) return std::nullopt;
    return std::isfinite(ratio) ? std::log2(ratio) : std::nan("");
  }

  std::optional<double> exponent_of(Base base) const {
    bool occurs = false;
    for (const Number& parameter : parameters_) occurs = occurs || powers_of(parameter)[base] != 0;
    if (!occurs) return 0;
    const auto by = [&](double log_scale) {
      Powers log_scales{};
      log_scales[base] = log_scale;
      return log_ratio(log_scales);
    };
    const auto ratio = by(log_scale);
    if (!ratio || !std::isfinite(*ratio)) return std::nullopt;
    const double exponent = *ratio / log_scale;
    for (const double large : {-large_log_scale, large_log_scale, 3.0}) {
      const auto check = by(large);
      if (!check || std::abs(*check / large - exponent) > tolerance) return std::nullopt;
    }
    return exponent;
  }

  const Function& function_;
  const std::vector<Number>& parameters_;
  std::vector<double> point_;
  double value_;
};

}  // namespace

std::optional<Exponents> homogeneous_exponents(const Function& function, const std::vector<Number>& parameters) {
  // At the values themselves; then a little off, on either side, where a difference vanishes at them. A zero shows
  // nothing of its dimension: any positive value stands in for it.
  bool tried = false;
  for (const double shift : {0.0, 0.1, -0.1}) {
    std::vector<double> point;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double generic = 0.7 + 0.1 * static_cast<double>(i % 7);
      const double value = parameters[i].value;
      point.push_back(value == 0 ? generic * (1 + shift) : value * (1 + generic * shift));
    }
    const Trial trial(function, parameters, std::move(point));
    if (!trial.says_something()) continue;
    if (const auto exponents = trial.exponents()) return exponents;
    tried = true;
  }
  if (tried) return std::nullopt;
  return Exponents{{}, 0, 0, true};
}

namespace {

/// Looks for the innermost sum, comparison or argument in which unlike things meet.
class HomogeneityCheck {
 public:
  HomogeneityCheck(std::string_view text, const Environment& environment) : text_(text), environment_(environment) {}

  std::optional<TextError> within(std::size_t begin, std::size_t end) {
    // Inner parentheses first.
    for (std::size_t i = begin; i < end; ++i) {
      if (text_[i] != '(') continue;
      const std::size_t close = closing(i, end);
      if (auto error = within(i + 1, close)) return error;
      if (auto error = argument(begin, i, close)) return error;
      i = close;
    }
    // Then what stands at this level: alternatives and comparisons of sums.
    Part last{begin, begin, ""};
    for (std::size_t i = begin; i <= end; ++i) {
      if (i < end && text_[i] == '(') i = closing(i, end);
      const std::size_t width = i < end ? separator(i) : 1;
      if (width == 0) continue;
      const Part part{last.end + last.separator.size(), i, i < end ? std::string(text_.substr(i, width)) : ""};
      if (auto error = sum(part.begin, part.end)) return error;
      if (last.separator == "?" || last.separator == "&&" || last.separator == "||") last.end = last.begin;
      if (last.end > last.begin)
        if (auto error = alike(last, part, last.separator == ":" ? "cannot be alternatives" : "cannot be compared"))
          return error;
      last = part;
      i += width - 1;
    }
    return std::nullopt;
  }

 private:
  struct Part {
    std::size_t begin, end;
    std::string separator;  ///< after it
  };

  std::size_t closing(std::size_t open, std::size_t end) const {
    int depth = 0;
    for (std::size_t i = open; i < end; ++i) {
      depth += text_[i] == '(' ? 1 : text_[i] == ')' ? -1 : 0;
      if (depth == 0) return i;
    }
    return end;
  }

  /// Length of the separator of sums at `i`, 0 if there is none.
  std::size_t separator(std::size_t i) const {
    for (const std::string_view two : {"&&", "||", "<=", ">=", "==", "!="})
      if (text_.substr(i, 2) == two) return 2;
    return std::string_view("?:,<>").find(text_[i]) != std::string_view::npos ? 1 : 0;
  }

  std::string_view trimmed(std::size_t begin, std::size_t end) const {
    std::string_view part = text_.substr(begin, end - begin);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    return part;
  }

  std::optional<Number> number(std::string_view part) const {
    auto result = evaluate_expression(part, environment_);
    if (const auto* known = std::get_if<Number>(&result)) return *known;
    return std::nullopt;
  }

  TextError error(std::string_view part, std::string message, bool plain) const {
    const auto at = static_cast<std::size_t>(part.data() - text_.data());
    return {count_characters(text_.substr(0, at)), std::move(message),
            plain ? "what has no unit counts as a pure number here: make it a parameter with its unit" : ""};
  }

  std::optional<TextError> alike(const Part& a, const Part& b, std::string_view what) const {
    const auto first = trimmed(a.begin, a.end), second = trimmed(b.begin, b.end);
    const auto x = number(first), y = number(second);
    if (!x || !y || x->dimension.same(y->dimension)) return std::nullopt;
    return error(second,
                 fmt::format("`{}` is {}, `{}` is {}: they {}", first, describe(x->dimension, x->radian), second,
                             describe(y->dimension, y->radian), what),
                 x->plain || y->plain);
  }

  /// The terms of a sum.
  std::optional<TextError> sum(std::size_t begin, std::size_t end) const {
    Part first{begin, begin, ""};
    std::size_t term = begin;
    char before = '\0';  // a sign after an operator or after the e of a number is no sum
    for (std::size_t i = begin; i <= end; ++i) {
      if (i < end && text_[i] == '(') i = closing(i, end);
      const bool sign = i < end && (text_[i] == '+' || text_[i] == '-');
      const bool binary = sign && before != '\0' && std::string_view("+-*/^").find(before) == std::string_view::npos &&
                          !exponent_of_number(i);
      if (i == end || binary) {
        const Part part{term, i, ""};
        if (first.end > first.begin) {
          if (auto found = alike(first, part, "cannot be added")) return found;
        } else {
          first = part;
        }
        term = i + 1;
      }
      if (i < end && text_[i] != ' ') before = text_[i];
    }
    return std::nullopt;
  }

  bool exponent_of_number(std::size_t sign) const {
    if (sign < 2 || (text_[sign - 1] != 'e' && text_[sign - 1] != 'E')) return false;
    std::size_t i = sign - 1;
    while (i > 0 && ((text_[i - 1] >= '0' && text_[i - 1] <= '9') || text_[i - 1] == '.')) --i;
    const char c = i > 0 ? text_[i - 1] : ' ';
    return i < sign - 1 && !(c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'));
  }

  /// What stands in the parentheses of a function or an exponent, or is one.
  std::optional<TextError> argument(std::size_t begin, std::size_t open, std::size_t close) const {
    std::size_t name = open;
    while (name > begin &&
           ((text_[name - 1] >= 'a' && text_[name - 1] <= 'z') || (text_[name - 1] >= '0' && text_[name - 1] <= '9')))
      --name;
    const std::string_view function = text_.substr(name, open - name);
    for (const std::string_view any : {"", "sqrt", "abs", "sign", "min", "max", "atan2"})
      if (function == any) return std::nullopt;
    const auto part = trimmed(open + 1, close);
    const auto found = number(part);
    if (!found || found->dimension.is_number()) return std::nullopt;
    return error(part,
                 fmt::format("`{}` takes a pure number, but `{}` is {}", function, part,
                             describe(found->dimension, found->radian)),
                 false);
  }

  std::string_view text_;
  const Environment& environment_;
};

}  // namespace

TextError explain_inhomogeneous(std::string_view text, const Environment& environment) {
  if (auto error = HomogeneityCheck(text, environment).within(0, text.size())) return *error;
  return {0, fmt::format("the units in `{}` do not fit together", text),
          "only like quantities can be added or compared, and an exponent is a pure number"};
}

}  // namespace rheonet
