#include "core/netlist/signal_connections.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "core/netlist/counting.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/laws.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/run_time_expression.hpp"
#include "core/netlist/scene_index.hpp"

namespace rheonet {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

const char* const source_example = "a block (`controller`) or a quantity of the network (`drum.velocity`)";

/// Adds the instance that the wire is in, if any, to messages.
class Within {
 public:
  Within(DiagnosticList& diagnostics, const LooseEnd& end) {
    if (!end.within.empty()) within_.emplace(diagnostics, end.within);
  }

 private:
  std::optional<DiagnosticList::Within> within_;
};

class Connection {
 public:
  Connection(const LooseEnds& loose, const std::set<std::string>& doubtful, Context& context, Scene& scene)
      : loose_(loose), doubtful_(doubtful), context_(context), diagnostics_(context.diagnostics), scene_(scene) {}

  void make() {
    if (!find_sources()) return;
    ends_.resize(scene_.blocks.size());
    units_.resize(scene_.blocks.size());
    for (const LooseEnd& end : loose_.ends)
      if (end.block >= 0) ends_[at(end.block)].push_back(&end);
    for (const OwnUnit& own : loose_.units) units_[at(own.block)].push_back(&own);
    for (const BlockFunction& function : loose_.functions) functions_[function.block] = &function;
    find_units();
    for (const BlockFunction& function : loose_.functions) compile(function);
    for (std::size_t k = 0; k < scene_.blocks.size(); ++k) check_block(static_cast<int>(k));
    for (std::size_t k = 0, feed = 0; k < loose_.ends.size(); ++k)
      if (loose_.ends[k].block < 0) check_feed(loose_.ends[k], scene_.feeds[feed++]);
  }

 private:
  const std::string& name(int block) const { return scene_.elements[at(scene_.blocks[at(block)].element)].name; }
  const Declaration& declaration(int element) const {
    return *context_.declarations[at(scene_.elements[at(element)].declaration)];
  }

  /// Finds the sources of all wires; false if one is not found. No message is added for a source that has a mistake.
  bool find_sources() {
    bool all = true;
    std::vector<std::string> names;
    for (const LooseEnd& end : loose_.ends) {
      names.push_back(end.path);
      names.push_back(end.path.substr(0, end.path.rfind('.')));
    }
    const SceneIndex index(scene_, names);
    for (const LooseEnd& end : loose_.ends) {
      const Within within(diagnostics_, end);
      const std::size_t dot = end.path.rfind('.');
      int block = index.find(end.path).block;
      if (block < 0 && dot != end.path.npos && end.path.substr(dot) == ".out")
        block = index.find(end.path.substr(0, dot)).block;
      if (end.block < 0) {
        all = all && block >= 0;
        if (block < 0)
          refuse(end, index.find(end.path));
        else
          scene_.feeds.push_back({end.element, end.connection->parameter, block, end.connection->sign});
        continue;
      }
      const int source = block < 0 ? sensed(end, index) : block;
      all = all && source >= 0;
      if (source >= 0) scene_.blocks[at(end.block)].inputs.push_back({block >= 0, source, end.connection->sign});
    }
    return all;
  }

  /// Index of a quantity of the network in Scene::sensed; -1, with a mistake, if the path names none.
  int sensed(const LooseEnd& end, const SceneIndex& index) {
    const SceneIndex::Found found = index.find(end.path);
    if (end.path.find('.') == end.path.npos || found.any()) {
      refuse(end, found);
      return -1;
    }
    TomlValue path = *end.connection->source;
    path.text = end.path;
    auto record = std::move(find_records({path}, doubtful_, context_, scene_, true, &index).front());
    if (!record) return -1;
    if (!may_be_sensed(*record)) {
      if (scene_.blocks[at(end.block)].of_stop_when) {
        diagnostics_.error(path.spot, "`stop_when` cannot depend on `" + end.path + "`",
                           "it may depend on positions, velocities, displacements, forces, powers of elements, and outputs of blocks");
        return -1;
      }
      diagnostics_.error(path.spot, "a block cannot take in `" + end.path + "`", "it takes in positions, velocities, displacements, forces, and powers of elements");
      return -1;
    }
    scene_.sensed.push_back(std::move(*record));
    return static_cast<int>(scene_.sensed.size()) - 1;
  }

  bool is_doubtful(const std::string& path) const { return doubtful_.contains(path.substr(0, path.find('.'))); }

  void refuse(const LooseEnd& end, const SceneIndex::Found& found) {
    if (!found.any() && is_doubtful(end.path)) return;
    const Spot spot = end.connection->source->spot;
    if (found.any() && end.block >= 0) {
      diagnostics_.error(spot, "`" + end.path + "` does not say which quantity is meant",
                      "for instance `" + end.path + (found.node >= 0 ? ".velocity`" : ".force`"));
      return;
    }
    std::vector<std::string> blocks;
    for (std::size_t k = 0; k < scene_.blocks.size(); ++k) blocks.push_back(name(static_cast<int>(k)));
    diagnostics_.error(spot, "no block is called `" + end.path + "`",
                    did_you_mean(end.path, blocks,
                                 end.block < 0 ? "a signal comes from a block: a `gain` makes one of a quantity of the network"
                                               : "an input is " + std::string(source_example)));
  }

  BlockUnit unit_of_input(const SceneBlock::Input& input) const {
    return input.from_block ? scene_.blocks[at(input.index)].unit : unit_of(scene_, scene_.sensed[at(input.index)]);
  }

  const Parameter& parameter(const OwnUnit& own) const {
    return declaration(scene_.blocks[at(own.block)].element).parameters[at(own.parameter)];
  }

  /// Unit of the inputs: that of the first input or associated parameter that has one.
  BlockUnit taken_in(int block) const {
    for (const SceneBlock::Input& input : scene_.blocks[at(block)].inputs)
      if (const BlockUnit unit = unit_of_input(input); !unit.open) return unit;
    return given(block, Parameter::Unit::input);
  }

  BlockUnit given(int block, Parameter::Unit kind) const {
    for (const OwnUnit* own : units_[at(block)])
      if (parameter(*own).unit == kind && !own->unit.open) return own->unit;
    return {};
  }

  static std::string input_name(const BlockFunction& function, std::size_t k) {
    return k < function.names.size() && !function.names[k].empty() ? function.names[k] : "u" + std::to_string(k + 1);
  }

  /// The expression of a block with the present units of its inputs; the last variable is the time.
  std::variant<RunTimeExpression, TextError> expression_of(const BlockFunction& function) const {
    std::vector<RunTimeExpression::Variable> variables;
    bool plain = std::all_of(function.parameters->names.begin(), function.parameters->names.end(), [](const auto& named) { return named.second.plain; });
    for (const SceneBlock::Input& input : scene_.blocks[at(function.block)].inputs) {
      variables.push_back({input_name(function, variables.size()), one_of(unit_of_input(input))});
      plain = plain && variables.back().unit.plain;
    }
    Number time{.value = 1, .dimension = dimension_of(Quantity::time, context_.domain), .plain = false, .typed_time = 1};
    variables.push_back({"t", plain ? Number{} : time});
    const Environment environment{.names = {}, .outer = function.parameters.get(), .known = known_in(function)};
    return RunTimeExpression::compile(function.source->text, variables, environment);
  }

  /// The names that the expression of a block may use, as a hint: "known here are u1 (m1.velocity), t and the parameters".
  std::string known_in(const BlockFunction& function) const {
    const SceneBlock& block = scene_.blocks[at(function.block)];
    if (function.law || block.of_stop_when) return function.parameters->known;
    std::string known = "known here are ";
    for (std::size_t k = 0; k < block.inputs.size(); ++k) {
      const SceneBlock::Input& input = block.inputs[k];
      known += fmt::format("`{}` ({}{}), ", input_name(function, k), input.sign < 0 ? "-" : "", input.from_block ? name(input.index) : scene_.sensed[at(input.index)].path);
    }
    return known + "the time `t` and the parameters";
  }

  BlockUnit made_by(const BlockFunction& function, bool any) const {
    if (function.lookup.table) return unit_of(function.lookup.output);
    const auto& inputs = scene_.blocks[at(function.block)].inputs;
    const bool open = std::any_of(inputs.begin(), inputs.end(), [&](const SceneBlock::Input& input) { return unit_of_input(input).open; });
    if (open && !any) return {};
    const auto expression = expression_of(function);
    const auto* sound = std::get_if<RunTimeExpression>(&expression);
    return sound ? unit_of(sound->unit()) : BlockUnit{};
  }

  void look_up(const BlockFunction& function) {
    SceneBlock& block = scene_.blocks[at(function.block)];
    const BlockUnit input = unit_of_input(block.inputs.front());
    if (!fits(function.lookup.input, one_of(input)))
      diagnostics_.error(function.source->spot, "the inputs of the table are " + describe(function.lookup.input) + ", but what `" + name(function.block) + "` takes in is " + words(input));
    block.function = function.lookup.table;
  }

  std::string called(const BlockFunction& function) const {
    const std::string& block = name(function.block);
    if (scene_.blocks[at(function.block)].of_stop_when) return "`" + block.substr(block.find('.') + 1) + "`";
    return function.law ? law_part(block.substr(block.rfind('.') + 1)) + " of law `" + function.law->name + "`" : "the output of `" + block + "`";
  }

  void compile(const BlockFunction& function) {
    std::optional<DiagnosticList::Within> within;
    if (!function.within.empty()) within.emplace(diagnostics_, function.within);
    if (function.lookup.table) return look_up(function);
    auto expression = expression_of(function);
    if (const auto* wrong = std::get_if<TextError>(&expression)) {
      const auto words = [&](const std::string& text) { return function.law ? in_words_of_law(text, function.names) : text; };
      diagnostics_.error(diagnostics_.inside(*function.source, wrong->offset), called(function) + ": " + words(wrong->message), words(wrong->hint));
      return;
    }
    auto& sound = std::get<RunTimeExpression>(expression);
    if (function.law) sound.show_as(in_words_of_law(sound.text(), function.names));
    SceneBlock& block = scene_.blocks[at(function.block)];
    for (std::size_t k = 0; k < block.inputs.size(); ++k) {
      if (sound.uses(k)) continue;
      diagnostics_.warning(function.source->spot, "`" + name(function.block) + "` does not use its input " + input_name(function, k));
    }
    block.function = std::make_shared<const RunTimeExpression>(std::move(sound));
  }

  /// Unit of the output, from the inputs and `own` parameters. `any`: an expression may have inputs of unknown unit.
  BlockUnit made(int block, bool any) const {
    if (const auto function = functions_.find(block); function != functions_.end()) return made_by(*function->second, any);
    const Declaration& declared = declaration(scene_.blocks[at(block)].element);
    if (declared.is_function()) return {};  // its table has a mistake
    const Declaration::Inputs& inputs = declared.inputs;
    BlockUnit unit = inputs.most == 0 ? BlockUnit{{}, 0, false} : taken_in(block);
    for (const OwnUnit* own : units_[at(block)]) {
      const Parameter::Unit kind = parameter(*own).unit;
      const bool divides = kind == Parameter::Unit::divides;
      if (kind != Parameter::Unit::own && !divides) continue;
      const bool open = unit.open || (own->unit.open && !divides);
      unit = unit_of(product(one_of(unit), divides ? raised(one_of(own->unit), -1) : one_of(own->unit)));
      unit.open = open;
    }
    if (inputs.integrates) unit.dimension = unit.dimension * dimension_of(Quantity::time, context_.domain);
    return unit;
  }

  /// Passes units from block to block until nothing changes.
  void find_units() {
    // An expression of which one input comes back from its own output is first looked at when all other units are known.
    bool any = false;
    for (bool again = true; again || !std::exchange(any, true);) {
      again = false;
      for (std::size_t k = 0; k < scene_.blocks.size(); ++k) {
        BlockUnit& unit = scene_.blocks[k].unit;
        if (!unit.open) continue;
        unit = made(static_cast<int>(k), any);
        if (unit.open) unit = given(static_cast<int>(k), Parameter::Unit::output);
        again = again || !unit.open;
      }
    }
  }

  void check_block(int block) {
    if (declaration(scene_.blocks[at(block)].element).is_function()) return;
    const BlockUnit in = taken_in(block), out = made(block, true);
    const auto differs = [](const BlockUnit& a, const BlockUnit& b) {
      return !fits(one_of(a), one_of(b));
    };
    for (std::size_t k = 0; k < ends_[at(block)].size(); ++k) {
      const LooseEnd& end = *ends_[at(block)][k];
      const BlockUnit unit = unit_of_input(scene_.blocks[at(block)].inputs[k]);
      if (!differs(unit, in)) continue;
      const Within within(diagnostics_, end);
      diagnostics_.error(end.connection->source->spot, "`" + end.path + "` is " + words(unit) + ", but the other inputs of `" +
                                                  name(block) + "` are " + words(in),
                      "all inputs of a block have one unit: put a `gain` before it");
    }
    for (const OwnUnit* given : units_[at(block)]) {
      const OwnUnit& own = *given;
      const Parameter::Unit kind = parameter(own).unit;
      const BlockUnit& expected = kind == Parameter::Unit::input ? in : kind == Parameter::Unit::output ? out : own.unit;
      if (differs(own.unit, expected))
        diagnostics_.error(own.source->spot, "`" + parameter(own).name + "`: expected " + words(expected) + ", as what the block " +
                                              (kind == Parameter::Unit::input ? "takes in" : "puts out") + ", found " +
                                              words(own.unit));
    }
  }

  void check_feed(const LooseEnd& end, const SceneFeed& feed) {
    const BlockUnit& unit = scene_.blocks[at(feed.block)].unit;
    if (unit.open) return;
    const Parameter& wanted = declaration(end.element).parameters[at(end.connection->parameter)];
    const Quantity quantity = quantity_of(declaration(end.element), scene_.elements[at(end.element)], at(end.connection->parameter));
    const Domain domain = domain_of(scene_, scene_.elements[at(end.element)]);
    const auto checked = as_quantity(one_of(unit), quantity, domain);
    const auto* wrong = std::get_if<TextError>(&checked);
    if (!wrong) return;
    const Within within(diagnostics_, end);
    if (const auto function = functions_.find(feed.block); function != functions_.end() && function->second->law && function->second->within == end.within)
      return diagnostics_.error(function->second->source->spot, called(*function->second) + ": " + wrong->message);
    diagnostics_.error(end.connection->source->spot,
                    "`" + wanted.name_in(domain) + "`" + (quantity != wanted.quantity ? " (which multiplies `" + wanted.coefficient_with + "`)" : "") +
                        " from block `" + end.path + "`: " + wrong->message);
  }

  static std::string words(const BlockUnit& unit) { return describe(one_of(unit)); }

  const LooseEnds& loose_;
  const std::set<std::string>& doubtful_;
  Context& context_;
  DiagnosticList& diagnostics_;
  Scene& scene_;
  std::map<int, const BlockFunction*> functions_;  ///< of blocks
  std::vector<std::vector<const LooseEnd*>> ends_;  ///< of each block: its inputs, in their order
  std::vector<std::vector<const OwnUnit*>> units_;  ///< of each block: of its parameters
};

}  // namespace

std::vector<SignalConnection> read_inputs(const Declaration& declaration, const std::string& called, Spot spot, TableReader& reader,
                              DiagnosticList& diagnostics) {
  const Declaration::Inputs& inputs = declaration.inputs;
  std::vector<SignalConnection> connections;
  if (inputs.most == 0) return connections;
  // A function may be one of the time alone.
  const TomlEntry* in = inputs.alike ? reader.require("in", spot, std::string("an input is ") + source_example) : reader.find("in");
  if (!in) return connections;
  std::vector<const TomlValue*> sources{&in->value};
  std::vector<std::string> names;
  if (in->value.is_array()) {
    sources.clear();
    for (const TomlValue& item : in->value.items) sources.push_back(&item);
  } else if (in->value.is_table() && !inputs.alike) {
    sources.clear();
    for (const TomlEntry& entry : in->value.entries) {
      if (!expect_identifier(entry.key, entry.spot, "an input", diagnostics)) return connections;
      if (entry.key == "t") {
        diagnostics.error(entry.spot, "an input cannot be called `t`: that is the time");
        return connections;
      }
      sources.push_back(&entry.value);
      names.push_back(entry.key);
    }
  }
  const bool of_time = sources.empty() && !inputs.alike && in->value.is_table();  // a function of parameters and time
  if ((sources.size() < inputs.least && !of_time) || sources.size() > inputs.most) {
    diagnostics.error(in->value.spot, "`" + called + "` takes in " +
                                       (inputs.most > inputs.least ? "at least " : "") + std::to_string(inputs.least) +
                                       (inputs.least > 1 ? " signals" : " signal") + ", but `in` names " +
                                       std::to_string(sources.size()),
                   inputs.most == 1 ? "a `sum` adds several" : "in = [\"a\", \"-b\"]");
    return connections;
  }
  for (std::size_t k = 0; k < sources.size(); ++k) {
    auto connection = read_wire(*sources[k], "`in`", diagnostics);
    if (!connection) continue;
    if (!names.empty()) connection->name = names[k];
    connections.push_back(std::move(*connection));
  }
  return connections;
}

std::optional<SignalConnection> read_wire(const TomlValue& source, const std::string& what, DiagnosticList& diagnostics) {
  if (!expect_string(source, what, diagnostics, source_example)) return {};
  SignalConnection connection{.source = &source, .path = source.text};
  if (connection.path.starts_with('-')) {
    connection.sign = -1;
    connection.path.erase(0, 1);
  }
  if (!connection.path.empty()) return connection;
  diagnostics.error(source.spot, what + " is empty", source_example);
  return {};
}

bool is_path_of_quantity(const TomlValue& value) {
  if (!value.is_string()) return false;
  const std::string_view text = std::string_view(value.text).substr(value.text.starts_with('-') ? 1 : 0);
  const std::size_t dot = text.rfind('.');
  const auto letter = [&](std::size_t i) { return i < text.size() && (std::isalpha(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_'); };
  const bool names = std::all_of(text.begin(), text.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.'; });
  return names && dot != text.npos && letter(0) && letter(dot + 1);
}

std::optional<SignalConnection> read_block(const TomlValue& signal, Context& context) {
  TableReader reader(signal, "a signal from a block");
  const TomlEntry* block = reader.find("block");
  reader.finish(context.diagnostics);
  return read_wire(block->value, "`block`", context.diagnostics);
}

const TomlEntry* find_feed(const TomlValue& signal) { return signal.is_table() ? signal.find("block") : nullptr; }

std::optional<SignalConnection> read_feed(const TomlEntry& feed, const TomlValue& signal, const Declaration& declaration,
                              std::size_t parameter, Context& context) {
  const Parameter& fed = declaration.parameters[parameter];
  if (!fed.from_block) {
    context.diagnostics.error(feed.spot, "the " + fed.name_in(context.domain) + " of a `" + declaration.type +
                                          "` is a function of time alone: no block can give it",
                           "take in that block in its place");
    return {};
  }
  auto connection = read_block(signal, context);
  if (connection) connection->parameter = static_cast<int>(parameter);
  return connection;
}

void connect(const LooseEnds& loose, const std::set<std::string>& doubtful, Context& context, Scene& scene) {
  if (!loose.ends.empty() || !loose.units.empty() || !loose.functions.empty()) Connection(loose, doubtful, context, scene).make();
}

}  // namespace rheonet
