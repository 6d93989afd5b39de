#include "core/netlist/characteristic_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/numerics.hpp"
#include "core/netlist/run_time_expression.hpp"
#include "core/netlist/scene.hpp"
#include "core/netlist/table_file.hpp"

namespace rheonet {

namespace {

const char* example_of(const Parameter& parameter) { return parameter.may_be_curve ? "[[0, 0.5], [0.1, 0.4], [5, 0.35]]" : "[[0, 0], [0.01, 5], [0.02, 20]]"; }

}  // namespace

CharacteristicTemplate::CharacteristicTemplate(const TomlValue& source, const TomlEntry* smooth, const TomlEntry* columns, const Parameter& parameter,
                                               Quantity quantity, Context& context)
    : source_(&source), parameter_(&parameter), quantity_(quantity) {
  const std::size_t before = context.diagnostics.errors();
  if (source.is_table()) {
    read_table(source, context);
  } else if (source.is_string()) {
    expression_ = !source.text.ends_with(".csv");
    if (expression_) {
      if (smooth) context.diagnostics.error(smooth->spot, "an expression has no points for `smooth`", "leave it out");
    } else {
      file_name_ = source;
    }
  } else {
    read_points(source, context);
  }
  if (columns) read_columns(*columns, context);
  const auto take = [&](const TomlEntry& entry) {
    smooth_ = expect_boolean(entry.value, "`smooth`", context.diagnostics, "smooth = true") && entry.value.boolean;
  };
  if (smooth) take(*smooth);
  if (const TomlEntry* inside = source.is_table() ? source.find("smooth") : nullptr) {
    if (smooth) refuse_both(*smooth, *inside, "`" + name() + "`", context.diagnostics);
    take(*inside);
  }
  sound_ = context.diagnostics.errors() == before;
}

void CharacteristicTemplate::read_table(const TomlValue& source, Context& context) {
  TableReader reader(source, "`" + name() + "`");
  const TomlEntry* table = reader.require("table", source.spot, fmt::format("{} = {{ table = {} }}", name(), example_of(*parameter_)));
  const TomlEntry* columns = reader.find("columns");
  reader.find("smooth");
  reader.finish(context.diagnostics);
  if (!table) return;
  if (table->value.is_string()) {
    file_name_ = table->value;
  } else {
    read_points(table->value, context);
  }
  if (columns) read_columns(*columns, context);
}

void CharacteristicTemplate::read_columns(const TomlEntry& columns, Context& context) {
  columns_ = read_column_names(columns, file_name_.has_value(), argument(), parameter_->may_be_curve ? "\"w\", \"mu\"" : "\"d\", \"force\"", context.diagnostics);
}

bool CharacteristicTemplate::may_be(const TomlValue& value, const Parameter& parameter) {
  if (!value.is_string()) return value.is_array() || (value.is_table() && !parameter.may_vary);
  const std::vector<std::string> names = identifiers_of(value.text);
  return value.text.ends_with(".csv") || std::find(names.begin(), names.end(), "w") != names.end();
}

bool CharacteristicTemplate::are_several(const TomlValue& value) {
  return value.is_array() && !std::all_of(value.items.begin(), value.items.end(), [](const TomlValue& item) {
    return item.is_array() && std::none_of(item.items.begin(), item.items.end(), [](const TomlValue& inside) { return inside.is_array(); });
  });
}

void CharacteristicTemplate::read_points(const TomlValue& source, Context& context) {
  if (!source.is_array()) {
    context.diagnostics.error(source.spot, fmt::format("`{}` must be an array of points or the name of a CSV file, but is {}", name(), describe(source)),
                              fmt::format("{} = {}", name(), example_of(*parameter_)));
    return;
  }
  points_ = read_table_points(source, argument(), name_of(quantity_, context.domain), context.diagnostics);
}

std::shared_ptr<const Characteristic> CharacteristicTemplate::evaluate(const Environment& environment, Context& context) const {
  if (!sound_) return nullptr;
  if (expression_) return of_expression(environment, context);
  if (points_.constant && made_) return made_;
  std::optional<Numbers> found = file_name_ ? numbers_of_file(context) : numbers(environment, context);
  made_ = nullptr;
  if (found && check(*found, context)) made_ = std::make_shared<const Characteristic>(std::move(found->x), std::move(found->force), smooth_);
  return made_;
}

std::optional<CharacteristicTemplate::Numbers> CharacteristicTemplate::numbers(const Environment& environment, Context& context) const {
  Numbers result;
  for (const TablePoints::Point& point : points_.points) {
    const auto x = point.x.evaluate_finite(environment, parameter_->over, context.domain, context.diagnostics);
    const auto force = point.y.evaluate_finite(environment, quantity_, context.domain, context.diagnostics);
    if (!x || !force) return {};
    result.x.push_back(*x);
    result.force.push_back(*force);
  }
  return result;
}

std::optional<CharacteristicTemplate::Numbers> CharacteristicTemplate::numbers_of_file(Context& context) const {
  const auto file = read_table_file(*file_name_, columns_, {parameter_->over, argument(), quantity_ == Quantity::number ? "a coefficient" : "a force"}, context);
  if (!file) return {};
  const auto factor = as_quantity(file->unit, quantity_, context.domain);
  if (const auto* wrong = std::get_if<TextError>(&factor)) {
    context.diagnostics.error(file_name_->spot, fmt::format("`{}`: {}", name(), wrong->message), "the unit is that of the header of the file");
    return {};
  }
  Numbers result;
  for (const auto& [x, force] : file->points) {
    result.x.push_back(x);
    result.force.push_back(multiplied(force, std::get<double>(factor)));
  }
  return result;
}

std::shared_ptr<const Characteristic> CharacteristicTemplate::of_expression(const Environment& environment, Context& context) const {
  const auto refuse = [&](std::size_t at, const std::string& what, const std::string& hint) {
    context.diagnostics.error(context.diagnostics.inside(*source_, at), fmt::format("`{}`: {}", name(), what), hint);
    return nullptr;
  };
  const std::string variable = parameter_->over == Quantity::velocity ? "w" : "d", over = argument();
  const RunTimeExpression::Variable argument{variable, number_in(1, std::get<Unit>(parse_unit(unit_of(parameter_->over, context.domain))))};
  auto compiled = RunTimeExpression::compile(source_->text, {&argument, 1}, environment);
  if (const auto* wrong = std::get_if<TextError>(&compiled)) return refuse(wrong->offset, wrong->message, wrong->hint);
  auto expression = std::get<RunTimeExpression>(std::move(compiled));
  const auto factor = as_quantity(expression.unit(), quantity_, context.domain);
  if (const auto* wrong = std::get_if<TextError>(&factor)) return refuse(0, wrong->message, wrong->hint);
  if (!expression.uses(0))
    return refuse(0, fmt::format("does not depend on `{}`, the {}", variable, over), "write an expression over `" + variable + "`, or points");
  auto result = std::make_shared<const Characteristic>(std::make_shared<const RunTimeExpression>(std::move(expression)));
  const auto function = [&](double x, double& slope) { return result->force(x, slope); };
  const std::string unit = unit_of(parameter_->over, context.domain), force_unit = unit_of(quantity_, context.domain);
  const auto is = [&](double force, double x) { return fmt::format("is {:.4g}{} at a {} of {:.4g} {}", force, force_unit == "1" ? "" : " " + force_unit, over, x, unit); };
  double slope;
  if (!std::isfinite(function(0, slope)) || !std::isfinite(slope)) return refuse(0, fmt::format("has no finite value or slope at {} = 0", variable), "");
  for (const double x : Characteristic::samples()) {
    const double force = function(x, slope);
    if (const std::string wrong = parameter_->may_be_curve && x >= 0 ? outside(force) : ""; !wrong.empty()) return refuse(0, is(force, x) + wrong, "");
    if (!parameter_->resists || std::isnan(force)) continue;  // not defined everywhere
    if (x == 0 && force != 0) return refuse(0, is(force, 0) + ", where it must be 0", "");
    if (force * x < 0) return refuse(0, is(force, x) + ": it must resist the motion", "");
  }
  for (const double side : {-1.0, 1.0}) {
    const double slow = function(side * numerics::slow, slope), slower = function(side / numerics::far_out, slope);
    if (parameter_->resists && slow != 0 && slower / slow > numerics::rest_jump)
      return refuse(0, "jumps where the motion reverses: that is dry friction", "a `slider` sticks there; put one beside the dashpot");
  }
  if (parameter_->may_be_curve) {
    double there = 0, back = 0, at = 0;
    for (const double x : Characteristic::samples()) {
      const double one = function(x, slope), other = function(-x, slope), apart = std::abs(one - other);
      if (!(x > 0) || !std::isfinite(one) || apart <= numerics::equal_values * std::abs(one)) continue;
      std::tie(there, back, at) = std::tuple(one, other, x);
      if (!(apart <= (1 - numerics::rest_jump) * std::abs(one))) break;  // plain to see
    }
    if (at > 0) return refuse(0, fmt::format("{}, but {:.4g} in the other direction", is(there, at), back), "friction is the same in both directions: write `abs(w)` for `w`");
    const double at_rest = function(0, slope), slow = function(1 / numerics::far_out, slope);
    if (std::abs(slow - at_rest) > (1 - numerics::rest_jump) * std::max(std::abs(slow), std::abs(at_rest)))
      return refuse(0, "jumps where the motion begins", parameter_->may_vary ? "give the value at rest as `breakaway`" : "");
  }
  return result;
}

/// ": it must be at least 0", or nothing.
std::string CharacteristicTemplate::outside(double value) const {
  const Parameter& p = *parameter_;
  if (p.lower_open ? value <= p.lower : value < p.lower) return fmt::format(": it must be {} {:g}", p.lower_open ? "greater than" : "at least", p.lower);
  return value > p.upper ? fmt::format(": it must be at most {:g}", p.upper) : "";
}

Spot CharacteristicTemplate::spot_of(std::size_t point) const {
  return points_.points.empty() ? (file_name_ ? file_name_->spot : source_->spot) : points_.points[point].x.source().spot;
}

bool CharacteristicTemplate::check(const Numbers& numbers, Context& context) const {
  const std::string over = argument();
  const auto refuse = [&](std::size_t point, const std::string& what, const std::string& hint = {}) {
    context.diagnostics.error(spot_of(point), fmt::format("`{}` {}", name(), what), hint);
    return false;
  };
  if (numbers.x.size() < 2) return refuse(0, "needs at least two points", fmt::format("{} = {}", name(), example_of(*parameter_)));
  const auto resists = [&](std::size_t i) {
    return !parameter_->resists || numbers.x[i] * numbers.force[i] >= 0 ||
           refuse(i, fmt::format("is {} at a {} of {}: it must resist the motion", number_text(numbers.force[i]), over, number_text(numbers.x[i])));
  };
  if (!resists(0)) return false;
  if (parameter_->may_be_curve) {
    if (numbers.x.front() != 0) return refuse(0, fmt::format("begins at a speed of {}, and its value at rest is not known", number_text(numbers.x.front())), "let the first point be at 0");
    for (std::size_t i = 0; i < numbers.force.size(); ++i)
      if (const std::string wrong = outside(numbers.force[i]); !wrong.empty())
        return refuse(i, fmt::format("is {} at a speed of {}{}", number_text(numbers.force[i]), number_text(numbers.x[i]), wrong));
  }
  for (std::size_t i = 1; i < numbers.x.size(); ++i) {
    const double slope = (numbers.force[i] - numbers.force[i - 1]) / (numbers.x[i] - numbers.x[i - 1]);
    if (!(numbers.x[i] > numbers.x[i - 1]))
      return refuse(i, fmt::format("must have points of increasing {}, but {} follows {}", over, number_text(numbers.x[i]), number_text(numbers.x[i - 1])));
    if (!std::isfinite(slope)) return refuse(i, "has a slope beyond the range of numbers");
    if (!resists(i)) return false;
  }
  if (!parameter_->resists) return true;
  double slope;
  const double at_rest = Characteristic(numbers.x, numbers.force, smooth_).force(0, slope), largest = std::max(std::abs(numbers.force.front()), std::abs(numbers.force.back()));
  if (std::abs(at_rest) <= numerics::equal_values * largest) return true;
  return refuse(0, fmt::format("is {} at a {} of 0, where it must be 0", number_text(at_rest), over), "add the point [0, 0]");
}

}  // namespace rheonet
