#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/netlist/characteristic_template.hpp"
#include "core/netlist/coefficients_template.hpp"
#include "core/netlist/context.hpp"
#include "core/netlist/lookup_template.hpp"
#include "core/netlist/parameters.hpp"
#include "core/netlist/signals.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

struct Model;

/// An input of a block, or the block that feeds a signal, as written: `controller`, `-drum.velocity`.
struct SignalConnection {
  const TomlValue* source = nullptr;  ///< A string.
  std::string path;                   ///< Without the sign.
  double sign = 1;
  int parameter = -1;  ///< Index into Declaration::parameters of the signal that is fed.
  std::string name = {};  ///< For an input in the expression of its block; "": u1, u2, ... in order.
};

/// `repeat = { count, as, arrange }` of an entry.
struct Repeat {
  Formula count;
  std::string as = "i";
  bool series = true;
};

/// One entry of an `elements` table, or one member of `series` or `parallel`. Its structure is checked and its types are
/// resolved; its values are not evaluated yet. One plan serves all elements made from it.
struct ElementTemplate {
  enum class Kind { element, series, parallel, instance };

  Kind kind = Kind::element;
  bool sound = false;  ///< false: it has a mistake; no elements are made.
  std::optional<Domain> domain;  ///< Given by `domain` or by the type; for a group or an instance, that of all its members.
  bool in_model = false;  ///< Stands in a model, which has no domain of its own.
  std::string name;    ///< Within its assembly; "" for an unnamed group, which adds no level.
  Spot spot;           ///< Place of its name, or of its table.
  const TomlValue* source = nullptr;
  std::vector<int> nodes;  ///< `at`, `between`, then `support`: indices into Scope::nodes, or Scope::ground. Empty within a group.
  std::optional<Repeat> repeat;

  int declaration = 0;          ///< For an element.
  bool at = false;              ///< For an element.
  std::vector<Formula> values;  ///< For an element: one a declared parameter; for an instance: one a parameter of its model.
  std::vector<SignalTemplate> signals;  ///< For an element, one for each of signal_parameters.
  std::vector<int> signal_parameters;
  std::vector<std::size_t> default_signals;  ///< Signals that are not given and have a default.
  std::map<std::size_t, CharacteristicTemplate> characteristics;  ///< For an element, by the number of their parameter.
  std::vector<SignalConnection> inputs;  ///< For a block; for an instance of a law those that are connected, with their names.
  const TomlValue* function = nullptr;   ///< For a block: the expression of its output.
  std::optional<LookupTemplate> lookup;  ///< For a block: the table of its output.
  std::vector<CoefficientsTemplate> coefficients;  ///< For a block.
  std::vector<SignalConnection> feeds;   ///< Signals fed by the output of a block.

  std::vector<ElementTemplate> members;  ///< For a group; for an instance of a law generators for the inputs that are signals.

  /// Whether a signal or a block gives this parameter of an element.
  bool varies(std::size_t parameter) const;
  /// Quantity of a parameter of an element: a number where it is a coefficient of another one that is given.
  Quantity quantity_of(const Parameter& parameter) const {
    const bool coefficient = !parameter.coefficient_with.empty() && source->find(parameter.coefficient_with) != nullptr;
    return coefficient ? Quantity::number : parameter.quantity;
  }
  Model* model = nullptr;     ///< For an instance.
};

/// The entries of one `elements` table, and the nodes that they name.
struct Scope {
  struct Node {
    std::string name;
    Spot spot;
  };
  static constexpr int ground = -1;  ///< Stands for the ground among indices into `nodes`.
  std::vector<Node> nodes;  ///< A model's ports come first.
  std::unordered_map<std::string, int> node_index;
  std::deque<ElementTemplate> entries;

  std::unordered_map<std::string, std::size_t> entry_index;

  /// Index of the node `name`, or `ground`; adds the node if it is new.
  int node(const std::string& name, Spot spot);
  /// The entry `name`, nullptr if absent.
  const ElementTemplate* find(const std::string& name) const;
};

/// A model of `[models]`, or one that stands for a law of `[laws]`.
struct Model {
  std::string name;
  Spot spot;
  const TomlValue* source = nullptr;
  const TomlValue* check = nullptr;  ///< Conditions on the parameters of each instance.
  std::vector<std::string> ports;
  std::vector<NamedFormula> parameters;
  bool law = false;
  std::vector<std::string> inputs;  ///< For a law.
  std::vector<std::size_t> order;  ///< Order in which the parameters can be evaluated.
  Scope scope;
  std::vector<Number> defaults;              ///< Defaults of the parameters; NaN if absent or invalid.
  const Environment* environment = nullptr;  ///< The [parameters] of its file.
  double least_elements = 0;                 ///< Lower bound of the elements of an instance: each `repeat` counts once.
  bool both_domains = false;                 ///< Its defaults, of translation, count in rotation as their counterparts.
  bool sound = false;
};

using Models = std::map<std::string, std::unique_ptr<Model>>;

/// Makes plans of the entries of a file.
class TemplateReader {
 public:
  TemplateReader(Context& context, const Models& models) : context_(context), models_(models) {}

  /// Reads all entries of an `elements` table. `scope` already contains the ports.
  void read_elements(const TomlValue& table, Scope& scope, bool in_model = false);
  /// Reads one entry. `scope` names its nodes; nullptr for a member of a group, which names no nodes.
  ElementTemplate read_entry(std::string name, Spot spot, const TomlValue& source, Scope* scope, bool in_model);

 private:
  void read_element(ElementTemplate& plan, const TomlEntry& type, const Declaration& declaration, Scope* scope, TableReader& reader);
  void read_instance(ElementTemplate& plan, Model& model, Scope* scope, TableReader& reader);
  void read_law_input(ElementTemplate& plan, const TomlEntry& entry);
  void read_group(ElementTemplate& plan, const TomlEntry& group, TableReader& reader);
  void read_value(ElementTemplate& plan, std::size_t i, const TomlValue& value, const std::string& name, TableReader& reader);
  void read_place(ElementTemplate& plan, Scope* scope, std::size_t ports, bool may_be_at, bool may_be_between, TableReader& reader);
  void read_support(ElementTemplate& plan, Scope* scope, TableReader& reader);
  void read_domain(ElementTemplate& plan, TableReader& reader);
  void read_repeat(ElementTemplate& plan, TableReader& reader);
  const Declaration* find_type(const std::string& type) const;
  void refuse_type(const TomlEntry& type, const TomlValue& entry);
  const std::string& name_given(const Parameter& parameter, const ElementTemplate& plan, Domain domain, TableReader& reader) const;

  Context& context_;
  const Models& models_;
};

}  // namespace rheonet
