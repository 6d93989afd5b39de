#include "core/netlist/record_expressions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/netlist/dependency_order.hpp"
#include "core/netlist/functions.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/run_time_expression.hpp"
#include "core/netlist/scene_index.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

const char* const expression_example = "{ name = \"gap\", value = \"a.position - b.position\" }";

/// One entry of `simulate.record` that is an expression.
struct RecordEntry {
  const TomlEntry* name = nullptr;   ///< nullptr: the entry has a mistake
  const TomlEntry* value = nullptr;
  std::vector<std::string> names;    ///< that occur in the expression
};

/// An expression over operands, and over other expressions with operands of their own. Its function may be called by several
/// threads at once.
struct RecordFormula {
  struct Variable {
    std::size_t first;        ///< of its operands
    std::size_t count;
    std::function<double(std::span<const double>)> value;  ///< empty: the value of its only operand
  };
  RunTimeExpression expression;
  std::vector<Variable> variables;

  double operator()(std::span<const double> values) const {
    std::vector<double> arguments;
    for (const Variable& variable : variables)
      arguments.push_back(variable.value ? variable.value(values.subspan(variable.first, variable.count)) : values[variable.first]);
    return expression.value(arguments).value_or(not_given);
  }
};

class ExpressionReader {
 public:
  ExpressionReader(const Environment& environment, std::set<std::string>& doubtful, Context& context, Scene& scene)
      : environment_(environment), doubtful_(doubtful), context_(context), diagnostics_(context.diagnostics), scene_(scene) {}

  std::vector<std::optional<Record>> run(const std::vector<const TomlValue*>& tables) {
    for (const TomlValue* table : tables) entries_.push_back(read(*table));
    refuse_taken_names();
    const auto number_of = [&](const std::string& name) {
      std::size_t k = 0;
      while (k < entries_.size() && !(entries_[k].name && entries_[k].name->value.text == name)) ++k;
      return k;
    };
    std::vector<std::vector<std::size_t>> uses(entries_.size());
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      for (const std::string& name : entries_[k].names) {
        if (const std::size_t other = number_of(name); other < entries_.size()) uses[k].push_back(other);
      }
    }
    const DependencyOrder order = dependency_order(uses);
    for (const std::vector<std::size_t>& cycle : order.cycles) refuse_cycle(cycle);
    std::vector<std::optional<Record>> records(entries_.size());
    const auto doubt = [&](std::size_t k) {
      const TomlEntry* name = tables[k]->find("name");
      if (name && name->value.is_string()) doubtful_.insert(name->value.text);
    };
    for (const std::vector<std::size_t>& cycle : order.cycles) std::for_each(cycle.begin(), cycle.end(), doubt);
    for (const std::size_t k : order.order) {
      if (entries_[k].name) records[k] = make(entries_[k]);
      if (!records[k]) doubt(k);
    }
    return records;
  }

 private:
  RecordEntry read(const TomlValue& table) {
    const std::size_t before = diagnostics_.errors();
    TableReader reader(table, "an expression of `record`");
    RecordEntry entry;
    const TomlEntry* name = reader.require("name", table.spot, expression_example);
    const TomlEntry* value = reader.require("value", table.spot, expression_example);
    reader.finish(diagnostics_);
    if (diagnostics_.errors() > before) return {};
    if (!expect_string(name->value, "`name`", diagnostics_, expression_example)) return {};
    if (!expect_string(value->value, "`value`", diagnostics_, expression_example)) return {};
    if (!expect_identifier(name->value.text, name->value.spot, "a record", diagnostics_)) return {};
    entry.name = name;
    entry.value = value;
    entry.names = identifiers_of(value->value.text);
    return entry;
  }

  /// Names without a dot are no paths, but an expression could not tell them from a parameter, and a reader of the rows not
  /// from an element.
  void refuse_taken_names() {
    std::vector<std::string> names;
    for (const RecordEntry& entry : entries_) {
      if (entry.name) names.push_back(entry.name->value.text);
    }
    const SceneIndex index(scene_, names);
    std::set<std::string> seen;
    for (RecordEntry& entry : entries_) {
      if (!entry.name) continue;
      const std::string& name = entry.name->value.text;
      const auto found = index.find(name);
      const char* owner = environment_.find(name)                        ? "a parameter"
                          : found.element >= 0                           ? "an element"
                          : found.node >= 0 || name == "ground"          ? "a node"
                          : found.assembly >= 0                          ? "an assembly"
                          : find_function(name)                          ? "a function"
                          : name == "time"                               ? "the first column"
                          : !seen.insert(name).second                    ? "another record"
                                                                         : nullptr;
      if (!owner) continue;
      diagnostics_.error(entry.name->value.spot, fmt::format("the name `{}` is taken: it is {}", name, owner), "choose another name");
      entry = {};
    }
  }

  void refuse_cycle(const std::vector<std::size_t>& cycle) {
    const RecordEntry& first = entries_[cycle.front()];
    std::string path;
    for (const std::size_t k : cycle) path += fmt::format("`{}` uses ", entries_[k].name->value.text);
    diagnostics_.error(first.value->value.spot, fmt::format("a record cannot be computed from itself: {}`{}`", path, first.name->value.text));
  }

  std::optional<Record> make(const RecordEntry& entry) {
    const TomlValue& source = entry.value->value;
    SceneExpression expression{.name = entry.name->value.text, .operands = {}, .unit = {}};
    std::vector<RunTimeExpression::Variable> variables;
    RecordFormula formula;
    if (!find_variables(entry, expression, variables, formula)) return {};
    auto compiled = RunTimeExpression::compile(source.text, variables, environment_);
    if (const auto* wrong = std::get_if<TextError>(&compiled)) {
      diagnostics_.error(diagnostics_.inside(source, wrong->offset), fmt::format("`{}`: {}", expression.name, wrong->message), wrong->hint);
      return {};
    }
    formula.expression = std::get<RunTimeExpression>(std::move(compiled));
    expression.unit = unit_of(formula.expression.unit());
    if (expression.operands.empty()) {
      diagnostics_.error(source.spot, fmt::format("`{}` is computed from no record", expression.name), expression_example);
      return {};
    }
    expression.value = std::move(formula);
    scene_.expressions.push_back(std::move(expression));
    return find_expression(scene_, entry.name->value.text);
  }

  /// Resolves the records and expressions that an expression names. Parameters and unknown names remain.
  bool find_variables(const RecordEntry& entry, SceneExpression& expression, std::vector<RunTimeExpression::Variable>& variables,
                      RecordFormula& formula) {
    const TomlValue& source = entry.value->value;
    std::vector<TomlValue> paths;
    for (const std::string& name : entry.names) {
      const bool other = std::any_of(entries_.begin(), entries_.end(), [&](const RecordEntry& e) { return e.name && e.name->value.text == name; });
      if (name.find('.') == name.npos && !other) continue;
      TomlValue path;
      path.kind = TomlValue::Kind::string;
      path.text = name;
      path.spot = diagnostics_.inside(source, place_of_name(name, source.text));
      paths.push_back(std::move(path));
    }
    const std::size_t before = diagnostics_.errors();
    const auto found = find_records(paths, doubtful_, context_, scene_);
    if (diagnostics_.errors() > before) return false;
    for (const std::optional<Record>& record : found) {
      if (!record) return false;
      variables.push_back({record->path, one_of(unit_of(scene_, *record))});
      RecordFormula::Variable variable{.first = expression.operands.size(), .count = 1, .value = {}};
      if (record->subject == Record::Subject::expression) {
        const SceneExpression& inner = scene_.expressions[static_cast<std::size_t>(record->index)];
        variable.count = inner.operands.size();
        variable.value = inner.value;
      }
      for_each_operand(scene_, *record, [&](const Record& operand) { expression.operands.push_back(operand); });
      formula.variables.push_back(std::move(variable));
    }
    return true;
  }

  const Environment& environment_;
  std::set<std::string>& doubtful_;
  Context& context_;
  DiagnosticList& diagnostics_;
  Scene& scene_;
  std::vector<RecordEntry> entries_;
};

}  // namespace

std::vector<std::optional<Record>> read_record_expressions(const std::vector<const TomlValue*>& entries, const Environment& environment,
                                                           std::set<std::string>& doubtful, Context& context, Scene& scene) {
  return ExpressionReader(environment, doubtful, context, scene).run(entries);
}

std::optional<Record> find_expression(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.expressions.size(); ++k) {
    if (scene.expressions[k].name == name)
      return Record{name, Record::Subject::expression, static_cast<int>(k), Record::Channel::value};
  }
  return {};
}

std::optional<Record> sum_over_assembly(const std::string& path, const SceneAssembly& assembly, Record::Channel channel, Spot spot,
                                        Context& context, Scene& scene) {
  if (auto known = find_expression(scene, path)) return known;
  SceneExpression sum{.name = path, .operands = {}, .unit = {}};
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    const Declaration& declaration = *context.declarations[static_cast<std::size_t>(element.declaration)];
    if (!element.name.starts_with(assembly.name + '.') || declaration.ports == Declaration::Ports::block) continue;
    if (channel == Record::Channel::power && declaration.is_source()) {
      context.diagnostics.error(spot, fmt::format("the power of `{}` is not defined: `{}` in it supplies power, the others take it up", assembly.name, element.name),
                                fmt::format("record that of its elements: `{}.power`", element.name));
      return {};
    }
    sum.operands.push_back({{}, Record::Subject::element, static_cast<int>(e), channel});
  }
  sum.unit = {dimension_of(quantity_of(channel), scene.domain), 0, false};
  sum.value = [](std::span<const double> values) {
    double total = 0;
    for (const double value : values) total += value;
    return total;
  };
  scene.expressions.push_back(std::move(sum));
  return find_expression(scene, path);
}

}  // namespace rheonet
