#include "core/netlist/run_time_expression.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

/// Buffers of an evaluation. They grow to the largest expression that the thread evaluates.
struct RunTimeExpression::Workspace {
  std::vector<double> slots, adjoints;   ///< values, and derivatives of the result with respect to them
  std::vector<double> of_left, of_right; ///< of each step: partial derivatives with respect to its operands
  std::vector<std::uint32_t> trace;      ///< steps that were carried out, without jumps
  std::vector<double> sides;
  bool ordered = true;                   ///< no switching function was NaN
  bool past_switch = false;              ///< a switching function, of this expression or of one of its arguments, is past its threshold
};

namespace {

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Adds `adjoint` times a partial derivative. A factor 0 makes the product 0, even of infinity: sqrt(x*x) has the
/// derivative 0 at x = 0, and the base of a constant power needs no logarithm.
void add_product(double adjoint, double partial, double& sum) {
  if (partial != 0) sum += adjoint * partial;
}

}  // namespace

bool RunTimeExpression::linear() const {
  // A slot has degree 0 if it is constant between events, 1 if it is linear in the variables, and 2 if it is the time or anything else.
  std::vector<int> degree(slots_.size(), 0);
  for (std::size_t k = 0; k < variables_.size(); ++k) degree[k] = k + 1 < variables_.size() ? 1 : 2;
  for (const Step& step : steps_) {
    const int left = degree[step.left], right = degree[step.right], larger = std::max(left, right);
    int of_result = 0;
    switch (step.kind) {
      case Step::Kind::plus:
      case Step::Kind::minus:
      case Step::Kind::min:
      case Step::Kind::max:
        of_result = larger;
        break;
      case Step::Kind::times:
        of_result = std::min(2, left + right);
        break;
      case Step::Kind::over:
        of_result = right == 0 ? left : 2;
        break;
      case Step::Kind::negative:
      case Step::Kind::abs:
      case Step::Kind::copy:
        of_result = left;
        break;
      case Step::Kind::power:
        of_result = larger == 0 ? 0 : 2;
        break;
      case Step::Kind::call:
        of_result = left == 0 && (step.arguments < 2 || right == 0) ? 0 : 2;
        break;
      case Step::Kind::unless_jump:
      case Step::Kind::jump:
        continue;
      default:  // what compares, and what rounds
        break;
    }
    degree[step.to] = std::max(degree[step.to], of_result);
  }
  return degree[result_] < 2;
}

RunTimeExpression::Workspace& RunTimeExpression::start(std::span<const double> arguments) const {
  static thread_local Workspace work;
  const auto grow = [](auto& buffer, std::size_t size) {
    if (buffer.size() < size) buffer.resize(size);
  };
  grow(work.slots, slots_.size());
  grow(work.adjoints, slots_.size());
  grow(work.of_left, steps_.size());
  grow(work.of_right, steps_.size());
  grow(work.sides, switch_count_);
  work.trace.reserve(steps_.size());
  work.trace.clear();
  work.ordered = true;
  work.past_switch = false;
  std::copy(slots_.begin(), slots_.end(), work.slots.begin());
  std::copy_n(arguments.begin(), variables_.size(), work.slots.begin());
  return work;
}

namespace {

/// Ends of the interval in which floor, ceil and round keep the value n, less n.
std::pair<double, double> interval_of(FunctionSwitch function) {
  switch (function) {
    case FunctionSwitch::floor:
      return {0, 1};
    case FunctionSwitch::ceil:
      return {-1, 0};
    default:
      return {-0.5, 0.5};
  }
}

}  // namespace

/// The side of a switch for the value g of its switching function.
double RunTimeExpression::side_of(const Step& step, double g) {
  switch (step.kind) {
    case Step::Kind::at_most:
    case Step::Kind::greater:
      return g > 0 ? 1 : -1;
    case Step::Kind::equal:
    case Step::Kind::unequal:
    case Step::Kind::truth:
    case Step::Kind::sign:
      return sign_of(g);
    case Step::Kind::whole:
      return step.function->value(std::span(&g, 1));
    default:
      return g < 0 ? -1 : 1;
  }
}

/// The switching function times the side, and its derivative with respect to g.
std::pair<double, double> RunTimeExpression::margin_of(const Step& step, double side, double g) {
  if (step.kind == Step::Kind::whole) {
    const auto [lower, upper] = interval_of(step.function->switches);
    const double above = g - (side + lower), below = side + upper - g;
    return above < below ? std::pair{above, 1.0} : std::pair{below, -1.0};
  }
  if (side == 0) return {-std::abs(g), -sign_of(g)};
  return {side * g, side};
}

void RunTimeExpression::run(Workspace& work, bool with_slopes, std::span<const double> given, std::span<double> chosen, std::span<double> functions) const {
  using Kind = Step::Kind;
  double* const x = work.slots.data();
  // Up to its event a switch keeps its side: abs(x), max(x, 0) and the x of x > 0 ? f : 0 are a little below 0 then. Powers and roots go on there as odd
  // functions.
  bool& past_switch = work.past_switch;
  for (std::uint32_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    const double a = x[step.left], b = x[step.right];
    double value = 0, of_left = 0, of_right = 0;
    switch (step.kind) {
      case Kind::unless_jump:
        if (a == 0) k = step.target - 1;
        continue;
      case Kind::jump:
        k = step.target - 1;
        continue;
      case Kind::plus:
        value = a + b, of_left = 1, of_right = 1;
        break;
      case Kind::minus:
        value = a - b, of_left = 1, of_right = -1;
        break;
      case Kind::times:
        value = a * b, of_left = b, of_right = a;
        break;
      case Kind::over:
        value = a / b, of_left = 1 / b, of_right = -value / b;
        break;
      case Kind::negative:
        value = -a, of_left = -1;
        break;
      case Kind::copy:
        value = a, of_left = 1;
        break;
      case Kind::both:
        value = a != 0 && b != 0;
        break;
      case Kind::either:
        value = a != 0 || b != 0;
        break;
      case Kind::power: {
        value = std::pow(a, b);
        const bool mirrored = past_switch && a < 0 && std::isnan(value);
        const double base = mirrored ? -a : a;
        if (mirrored) value = std::pow(base, b);
        if (with_slopes) {
          of_left = b == 0 ? 0 : b * std::pow(base, b - 1);
          of_right = step.constant_exponent || value == 0 ? 0 : value * std::log(base);
        }
        if (mirrored) value = -value, of_right = -of_right;
        break;
      }
      case Kind::call: {
        double both[] = {a, b};
        const std::span arguments(both, step.arguments);
        value = step.function->value(arguments);
        if (past_switch && step.arguments == 1 && a < 0 && std::isnan(value)) {
          both[0] = -a;
          value = -step.function->value(arguments);
        }
        if (!with_slopes) break;
        of_left = step.function->slope(arguments, 0);
        if (step.arguments > 1) of_right = step.function->slope(arguments, 1);
        break;
      }
      default: {
        const double g = step.arguments > 1 ? a - b : a;
        double side = no_side;
        if (step.switch_number != no_switch && !given.empty()) side = given[step.switch_number];
        if (std::isnan(side)) side = side_of(step, g);
        past_switch = past_switch || margin_of(step, side, g).first < 0;
        if (step.switch_number != no_switch) {
          work.ordered = work.ordered && !std::isnan(g);
          if (!chosen.empty()) chosen[step.switch_number] = side;
          if (!functions.empty()) functions[step.switch_number] = margin_of(step, side, g).first;
        }
        switch (step.kind) {
          case Kind::less:
          case Kind::at_most:
            value = side < 0;
            break;
          case Kind::greater:
          case Kind::at_least:
            value = side > 0;
            break;
          case Kind::equal:
            value = side == 0;
            break;
          case Kind::unequal:
          case Kind::truth:
            value = side != 0;
            break;
          case Kind::abs:
            value = side * a, of_left = side;
            break;
          case Kind::min:
          case Kind::max:
            of_left = (side < 0) == (step.kind == Kind::min), of_right = 1 - of_left;
            value = of_left != 0 ? a : b;
            break;
          default:  // sign, whole
            value = side;
        }
      }
    }
    x[step.to] = value;
    if (!with_slopes) continue;
    work.of_left[k] = of_left;
    work.of_right[k] = of_right;
    work.trace.push_back(k);
  }
}

/// Reverse accumulation: from the adjoints of the workspace back to the variables.
void RunTimeExpression::sweep(Workspace& work, std::span<double> partials) const {
  for (auto k = work.trace.rbegin(); k != work.trace.rend(); ++k) {
    const Step& step = steps_[*k];
    const double adjoint = work.adjoints[step.to];
    if (adjoint == 0) continue;
    add_product(adjoint, work.of_left[*k], work.adjoints[step.left]);
    add_product(adjoint, work.of_right[*k], work.adjoints[step.right]);
  }
  std::copy_n(work.adjoints.begin(), variables_.size(), partials.begin());
}

namespace {

std::optional<double> if_finite(double value, std::span<const double> partials = {}) {
  const bool sound = std::isfinite(value) && std::all_of(partials.begin(), partials.end(), [](double p) { return std::isfinite(p); });
  return sound ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> RunTimeExpression::value(std::span<const double> arguments, std::span<const double> sides) const {
  Workspace& work = start(arguments);
  run(work, false, sides, {}, {});
  return if_finite(work.slots[result_]);
}

std::optional<double> RunTimeExpression::value(std::span<const double> arguments, std::span<const double> sides,
                                               std::span<double> partials) const {
  bool past_switch = false;
  return value_past_switches(arguments, sides, partials, past_switch);
}

std::optional<double> RunTimeExpression::value_past_switches(std::span<const double> arguments, std::span<const double> sides,
                                                             std::span<double> partials, bool& past_switch) const {
  Workspace& work = start(arguments);
  work.past_switch = past_switch;
  run(work, true, sides, {}, {});
  past_switch = work.past_switch;
  std::fill_n(work.adjoints.begin(), slots_.size(), 0.0);
  work.adjoints[result_] = 1;
  sweep(work, partials);
  return if_finite(work.slots[result_], partials.first(variables_.size()));
}

bool RunTimeExpression::find_sides(std::span<const double> arguments, std::span<double> sides) const {
  std::fill_n(sides.begin(), switch_count_, no_side);
  return complete_sides(arguments, sides);
}

bool RunTimeExpression::complete_sides(std::span<const double> arguments, std::span<double> sides) const {
  Workspace& work = start(arguments);
  std::copy_n(sides.begin(), switch_count_, work.sides.begin());
  std::fill_n(sides.begin(), switch_count_, no_side);
  run(work, false, std::span(work.sides).first(switch_count_), sides, {});
  return work.ordered;
}

bool RunTimeExpression::cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const {
  const Step& step = steps_[step_of_switch_[k]];
  Workspace& work = start(arguments);
  run(work, false, sides, {}, {});
  const double a = work.slots[step.left], g = step.arguments > 1 ? a - work.slots[step.right] : a;
  double& side = sides[k];
  if (step.kind == Step::Kind::whole) {
    side -= margin_of(step, side, g).second;
  } else {
    side = side == 0 ? sign_of(g) : -side;
  }
  return complete_sides(arguments, sides);
}

bool RunTimeExpression::switch_follows(std::size_t k, std::span<const double> arguments, std::span<const double> sides, std::span<const char> changes) const {
  std::vector<double> partials(variables_.size());
  if (!switching_function(k, arguments, sides, partials)) return true;
  for (std::size_t i = 0; i < partials.size(); ++i) {
    if (changes[i] && partials[i] != 0) return true;
  }
  return false;
}

bool RunTimeExpression::switching_functions(std::span<const double> arguments, std::span<const double> sides,
                                            std::span<double> values) const {
  Workspace& work = start(arguments);
  std::fill_n(values.begin(), switch_count_, std::numeric_limits<double>::infinity());
  run(work, false, sides, {}, values);
  return work.ordered;
}

std::optional<double> RunTimeExpression::switching_function(std::size_t k, std::span<const double> arguments,
                                                            std::span<const double> sides, std::span<double> partials) const {
  const Step& step = steps_[step_of_switch_[k]];
  Workspace& work = start(arguments);
  run(work, true, sides, {}, {});
  if (!std::binary_search(work.trace.begin(), work.trace.end(), step_of_switch_[k])) return {};
  const double a = work.slots[step.left], g = step.arguments > 1 ? a - work.slots[step.right] : a;
  const double side = sides.empty() || std::isnan(sides[k]) ? side_of(step, g) : sides[k];
  const auto [margin, slope] = margin_of(step, side, g);
  std::fill_n(work.adjoints.begin(), slots_.size(), 0.0);
  work.adjoints[step.left] += slope;
  if (step.arguments > 1) work.adjoints[step.right] -= slope;
  sweep(work, partials);
  return if_finite(margin, partials.first(variables_.size()));
}

}  // namespace rheonet
