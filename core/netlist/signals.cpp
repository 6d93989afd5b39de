#include "core/netlist/signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/netlist/counting.hpp"
#include "core/netlist/finite_signal.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

namespace {

constexpr double largest_seed = 9007199254740992;  // 2^53: doubles are exact up to there

/// "N/s" for "N", "m/s^2" for "m/s".
std::string per_second(const std::string& unit) { return unit.ends_with("/s") ? unit + "^2" : unit + "/s"; }

}  // namespace

const std::vector<std::string>& SignalTemplate::shape_names() {
  // In the order of Shape.
  static const std::vector<std::string> names{"step",     "ramp",  "sine",  "cosine", "square",
                                              "triangle", "chirp", "pulse", "noise", "table"};
  return names;
}

const std::array<std::string, SignalTemplate::key_count>& SignalTemplate::key_names() {
  static const std::array<std::string, key_count> names{"amplitude", "frequency", "end_frequency", "duration",
                                                        "width",     "phase",     "time",          "offset",
                                                        "interval",  "seed"};
  return names;
}

SignalTemplate::SignalTemplate(const TomlValue& source, const std::string& name, std::optional<Quantity> quantity, Context& context)
    : name_(name), quantity_(quantity) {
  const std::size_t before = context.diagnostics.errors();
  if (source.is_table()) {
    read_table_signal(source, context);
  } else {
    if (source.is_array())
      context.diagnostics.error(source.spot, "`" + name + "` must be a number, a string or a table, but is an array",
                             "points are given so: { table = [[0, 0], [1, 0.5]] }");
    else
      main_ = Formula(source, "`" + name + "`", context.diagnostics);
    constant_ = main_.given() && main_.identifiers().empty();
  }
  sound_ = context.diagnostics.errors() == before;
}

const TomlEntry* SignalTemplate::find_shape(const TomlValue& source, DiagnosticList& diagnostics) const {
  const std::vector<std::string>& names = shape_names();
  const TomlEntry* main = nullptr;
  for (const TomlEntry& entry : source.entries) {
    const auto found = std::find(names.begin(), names.end(), entry.key);
    if (found == names.end()) continue;
    if (main) {
      diagnostics.error(entry.spot, "signal `" + name_ + "` is both a `" + main->key + "` and a `" + entry.key + "`",
                     "a signal has one shape");
      return nullptr;
    }
    main = &entry;
  }
  if (!main) {
    std::string hint = "expected one of " + list_names(names);
    Spot spot = source.spot;
    for (const TomlEntry& entry : source.entries) {
      const auto& known = key_names();
      if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
      spot = entry.spot;
      hint = did_you_mean(entry.key, names, hint);
      break;
    }
    diagnostics.error(spot, "signal `" + name_ + "` has no shape", hint);
  }
  return main;
}

void SignalTemplate::read_table_signal(const TomlValue& source, Context& context) {
  const TomlEntry* main = find_shape(source, context.diagnostics);
  if (!main) return;
  const std::vector<std::string>& names = shape_names();
  shape_ = static_cast<Shape>(std::find(names.begin(), names.end(), main->key) - names.begin());

  std::vector<Key> required, optional{amplitude, time, offset};
  switch (shape_) {
    case Shape::sine:
    case Shape::cosine:
    case Shape::square:
    case Shape::triangle:
      required = {frequency};
      optional.push_back(phase);
      break;
    case Shape::ramp:
      optional.push_back(duration);
      break;
    case Shape::chirp:
      required = {frequency, end_frequency, duration};
      optional.push_back(phase);
      break;
    case Shape::pulse:
      required = {width};
      optional.insert(optional.end(), {frequency, phase});
      break;
    case Shape::noise:
      required = {interval, seed};
      break;
    default:
      break;
  }
  TableReader reader(source, "a `" + main->key + "` signal");
  reader.find(main->key);
  const auto take = [&](Key key, const TomlEntry* entry) {
    if (!entry) return;
    keys_[key] = Formula(entry->value, "`" + entry->key + "`", context.diagnostics);
    constant_ = constant_ && keys_[key].identifiers().empty();
  };
  const auto hint = [](Key key) {
    return key == seed ? "a whole number: signals of one seed have the same values" : key == interval ? "the time for which each value holds" : "";
  };
  for (const Key key : required) take(key, reader.require(key_names()[key], main->spot, hint(key)));
  for (const Key key : optional) take(key, reader.find(key_names()[key]));
  const TomlEntry* columns = shape_ == Shape::table ? reader.find("columns") : nullptr;
  const TomlEntry* smooth = shape_ == Shape::table ? reader.find("smooth") : nullptr;
  reader.finish(context.diagnostics);

  if (shape_ == Shape::table) {
    read_points(main->value, context);
    if (columns) columns_ = read_column_names(*columns, file_name_.has_value(), "time", "\"time\", \"force\"", context.diagnostics);
    smooth_ = smooth && expect_boolean(smooth->value, "`smooth`", context.diagnostics, "smooth = true") && smooth->value.boolean;
  } else {
    main_ = Formula(main->value, "`" + main->key + "`", context.diagnostics);
    constant_ = constant_ && main_.identifiers().empty();
  }
}

void SignalTemplate::read_points(const TomlValue& source, Context& context) {
  if (source.is_string()) {
    file_name_ = source;
    return;
  }
  if (!source.is_array()) {
    context.diagnostics.error(source.spot,
                           "`table` must be an array of points or the name of a CSV file, but is " + describe(source),
                           "points are given so: table = [[0, 0], [1, 0.5]]");
    return;
  }
  if (source.items.empty()) context.diagnostics.error(source.spot, "`table` has no points");
  points_ = read_table_points(source, "time", "value", context.diagnostics);
  constant_ = constant_ && points_.constant;
}

std::optional<Signal> SignalTemplate::evaluate(const Environment& environment, Context& context) const {
  if (!sound_) return {};
  if (constant_ && made_ && made_in_ == context.domain) return made_;
  made_in_ = context.domain;
  unit_ = quantity_ ? BlockUnit{dimension_of(*quantity_, context.domain), 0, false} : BlockUnit{};
  made_ = make(environment, context);
  if (made_ && !is_finite(*made_)) {
    context.diagnostics.error((file_name_ ? *file_name_ : points_.points.empty() ? main_.source() : points_.points.front().y.source()).spot,
                           "signal `" + name_ + "` has values, rates or periods beyond the range of numbers",
                           "a jump in a table is two points at one time");
    made_.reset();
  }
  return made_;
}

std::optional<double> SignalTemplate::in_unit(const Number& number, const Formula& formula, const Environment& environment,
                                          Context& context) const {
  const Spot spot = formula.source().spot;
  if (quantity_) {
    const auto checked = as_quantity(number, *quantity_, context.domain);
    if (const auto* wrong = std::get_if<TextError>(&checked)) {
      context.diagnostics.error(spot, formula.name() + ": " + wrong->message,
                             hint_for(formula, environment, context, wrong->hint));
      return {};
    }
    return std::get<double>(checked);
  }
  if (unit_.open && !number.plain) unit_ = unit_of(number);
  if (fits(number, one_of(unit_))) return number.value;
  context.diagnostics.error(spot, formula.name() + ": expected " + describe(one_of(unit_)) +
                                   ", as the rest of `" + name_ + "`, found " + describe(number));
  return {};
}

std::optional<Number> SignalTemplate::times_amplitude(Number number, const Environment& environment,
                                                  Context& context) const {
  if (!keys_[amplitude].given()) return number;
  const auto factor = keys_[amplitude].evaluate(environment, context.diagnostics);
  if (!factor) return {};
  const bool plain = number.plain && factor->plain;
  number = product(number, *factor);
  number.plain = plain;
  return number;
}

std::string SignalTemplate::hint_for(const Formula& formula, const Environment& environment, Context& context,
                                 std::string hint) const {
  if (!keys_[amplitude].given()) return hint;
  const auto own = formula.evaluate(environment, context.diagnostics);
  const auto factor = keys_[amplitude].evaluate(environment, context.diagnostics);
  if (!own || !factor || own->dimension.is_number() || factor->dimension.is_number()) return hint;
  return "`amplitude` multiplies " + formula.name() + ": one of them has the unit, the other is a number";
}

/// The format has no expressions of time. The message names the alternatives, which "unknown name" would not do.
bool SignalTemplate::is_of_time(const Environment& environment, Context& context) const {
  const auto& names = main_.identifiers();
  for (const char* const time : {"t", "time"}) {
    if (!std::binary_search(names.begin(), names.end(), time) || environment.find(time)) continue;
    context.diagnostics.error(main_.source().spot,
                           main_.name() + ": there is no parameter `" + time +
                               "`, and an expression here cannot depend on the time",
                           "what changes is the output of a `function`, { block = \"f\" }, or a table, { sine = \"1 " + unit_of(quantity_.value_or(Quantity::number), context.domain) +
                               "\", frequency = \"2 Hz\" }; there are " + list_names(shape_names(), "and"));
    return true;
  }
  return false;
}

/// The name of a block means its output. A name that is a unit, or near that of a parameter, is reported elsewhere.
bool SignalTemplate::is_unknown_name(const Environment& environment, Context& context) const {
  if (shape_ != Shape::constant || main_.identifiers().size() != 1) return false;
  const std::string& name = main_.identifiers().front();
  if (main_.source().text != name || environment.find(name) || std::holds_alternative<Unit>(parse_unit(name))) return false;
  std::vector<std::string> known{"pi"};
  for (const Environment* some = &environment; some; some = some->outer)
    for (const auto& [parameter, value] : some->names) known.push_back(parameter);
  if (!nearest(name, known).empty()) return false;
  context.diagnostics.error(main_.source().spot, main_.name() + ": there is no parameter `" + name + "`",
                         "the output of a block is given so: { block = \"" + name + "\" }");
  return true;
}

const TableFile* SignalTemplate::table_file(Context& context) const {
  if (!file_) {
    auto table = read_table_file(*file_name_, columns_, {}, context);
    file_ = table ? std::make_shared<const TableFile>(std::move(*table)) : nullptr;
  }
  return file_->get();
}

std::optional<double> SignalTemplate::scaled(const Formula& formula, const Environment& environment,
                                         Context& context) const {
  auto number = formula.evaluate(environment, context.diagnostics);
  if (number) number = times_amplitude(*number, environment, context);
  if (!number) return {};
  const Domain domain = context.domain;
  const Spot spot = formula.source().spot;
  const Dimension second = dimension_of(Quantity::time, domain);
  const Dimension rise = unit_.dimension / second;
  if (shape_ == Shape::ramp && quantity_ && !number->plain && !number->dimension.same(rise)) {
    context.diagnostics.error(spot, fmt::format("{}: expected the rise of `{}` per second ({}), found {}", formula.name(), name_,
                                                per_second(unit_of(*quantity_, domain)), describe(*number)),
                           hint_for(formula, environment, context, ""));
    return {};
  }
  if (shape_ == Shape::ramp) number->dimension = number->dimension * second;
  const auto value = in_unit(*number, formula, environment, context);
  if (!value || std::isfinite(*value)) return value;
  context.diagnostics.error(spot, formula.name() + " must be finite, but is infinite");
  return {};
}

std::optional<double> SignalTemplate::value_of(Key key, const Environment& environment, Context& context,
                                           double otherwise) const {
  const Formula& formula = keys_[key];
  if (!formula.given()) return otherwise;
  const auto quantity = [&] {
    switch (key) {
      case frequency:
      case end_frequency:
        return Quantity::frequency;
      case duration:
      case width:
      case time:
      case interval:
        return Quantity::time;
      case seed:
        return Quantity::number;
      case phase:
        return Quantity::angle;
      default:
        return quantity_.value_or(Quantity::number);
    }
  }();
  if (key == offset && !quantity_) {
    const auto number = formula.evaluate(environment, context.diagnostics);
    return number ? in_unit(*number, formula, environment, context) : std::nullopt;
  }
  const auto value = formula.evaluate_finite(environment, quantity, context.domain, context.diagnostics);
  if (!value) return {};
  const bool may_be_zero = shape_ == Shape::chirp && key != duration;
  const bool positive = key == frequency || key == end_frequency || key == duration || key == width || key == interval;
  if (key == seed && (*value != std::floor(*value) || *value < 0 || *value > largest_seed)) {
    context.diagnostics.error(formula.source().spot, formula.name() + " must be a whole number from 0 to " + number_text(largest_seed) + ", but is " + number_text(*value));
    return {};
  }
  if (positive && (*value < 0 || (*value == 0 && !may_be_zero))) {
    context.diagnostics.error(formula.source().spot,
                           formula.name() + (may_be_zero ? " must be at least 0" : " must be greater than 0") +
                               ", but is " + number_text(*value) + " " + unit_of(quantity, context.domain));
    return {};
  }
  return value;
}

std::optional<Signal> SignalTemplate::make(const Environment& environment, Context& context) const {
  const auto start = value_of(time, environment, context, 0);
  const auto level = value_of(offset, environment, context, 0);
  const auto angle = value_of(phase, environment, context, 0);
  const auto f = value_of(frequency, environment, context, 0);
  const auto f_end = value_of(end_frequency, environment, context, 0);
  const auto length = value_of(duration, environment, context, std::numeric_limits<double>::infinity());
  const auto high = value_of(width, environment, context, 0);
  const auto held = value_of(interval, environment, context, 0);
  const auto number = value_of(seed, environment, context, 0);
  if (shape_ == Shape::table) {
    if (!start || !level) return {};
    return make_table(environment, context, *start, *level);
  }
  if (is_of_time(environment, context) || is_unknown_name(environment, context)) return {};
  const auto main = scaled(main_, environment, context);
  if (!main || !start || !level || !angle || !f || !f_end || !length || !high || !held || !number) return {};
  switch (shape_) {
    case Shape::step:
      return Signal(Signal::Step{*main, *start, *level});
    case Shape::ramp:
      return Signal(Signal::Ramp{*main, *start, *level, *length});
    case Shape::sine:
      return Signal(Signal::Sine{*main, *f, *angle, *start, *level});
    case Shape::cosine:
      return Signal(Signal::Sine{*main, *f, *angle + std::numbers::pi / 2, *start, *level});
    case Shape::square:
      return Signal(Signal::Square{*main, *f, *angle, *start, *level});
    case Shape::triangle:
      return Signal(Signal::Triangle{*main, *f, *angle, *start, *level});
    case Shape::chirp:
      return Signal(Signal::Chirp{*main, *f, *f_end, *length, *angle, *start, *level});
    case Shape::pulse:
      if (*f > 0 && *high * *f >= 1) {
        context.diagnostics.error(keys_[width].source().spot, "`width` must be less than the period, 1/`frequency`");
        return {};
      }
      if (*f == 0 && *angle != 0) {
        context.diagnostics.error(keys_[phase].source().spot, "a `pulse` without `frequency` has no `phase`",
                               "`time` says when it begins");
        return {};
      }
      return Signal(Signal::Pulse{*main, *high, *f, *angle, *start, *level});
    case Shape::noise:
      return Signal(Signal::Noise{*main, *held, static_cast<std::uint64_t>(*number), *start, *level});
    default:
      return Signal(Signal::Constant{*main});
  }
}

std::optional<Signal> SignalTemplate::make_table(const Environment& environment, Context& context, double start,
                                             double level) const {
  Signal::Table table{{}, {}, start, level, smooth_};
  if (file_name_) {
    const TableFile* const file = table_file(context);
    if (!file) return {};
    const auto unit = times_amplitude(file->unit, environment, context);
    if (!unit) return {};
    if (!quantity_ && !unit->plain) unit_ = unit_of(*unit);
    const auto factor = quantity_ ? as_quantity(*unit, *quantity_, context.domain) : unit->value;
    if (const auto* wrong = std::get_if<TextError>(&factor)) {
      context.diagnostics.error(file_name_->spot, "`table`: " + wrong->message,
                             file->unit.plain ? wrong->hint : "the unit is that of the header of the file");
      return {};
    }
    if (!std::isfinite(std::get<double>(factor))) {
      context.diagnostics.error(keys_[amplitude].source().spot, "`amplitude` must be finite, but is infinite");
      return {};
    }
    for (const auto& [t, value] : file->points) {
      table.times.push_back(t);
      table.values.push_back(multiplied(value, std::get<double>(factor)));
    }
    return Signal(std::move(table));
  }
  for (const TablePoints::Point& point : points_.points) {
    const auto t = point.x.evaluate_finite(environment, Quantity::time, context.domain, context.diagnostics);
    const auto value = scaled(point.y, environment, context);
    if (!t || !value) return {};
    if (!table.times.empty() && *t < table.times.back()) {
      context.diagnostics.error(point.x.source().spot, fmt::format("the times of a table must not decrease, but {:.6g} s follows {:.6g} s", *t, table.times.back()));
      return {};
    }
    table.times.push_back(*t);
    table.values.push_back(*value);
  }
  return Signal(std::move(table));
}

}  // namespace rheonet
