#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/element_templates.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads the inputs of a block: `in = "drum.velocity"`, or `in = ["command", "-drum.velocity"]` for several. The inputs of a function may
/// have names: `in = { w = "drum.velocity" }`.
std::vector<SignalConnection> read_inputs(const Declaration& declaration, const std::string& called, Spot spot, TableReader& reader,
                              DiagnosticList& diagnostics);

/// Reads the source of a wire, with its sign; absent if it has a mistake. `what` names it in messages.
std::optional<SignalConnection> read_wire(const TomlValue& source, const std::string& what, DiagnosticList& diagnostics);
/// Whether a value is the path of a quantity of the network, with or without a sign: "motor.force". No expression looks like one.
bool is_path_of_quantity(const TomlValue& value);
/// Reads `{ block = "controller" }`; absent if it has a mistake.
std::optional<SignalConnection> read_block(const TomlValue& signal, Context& context);

/// The `block` entry of `{ block = "controller" }` given in place of a signal; nullptr if the signal is none.
const TomlEntry* find_feed(const TomlValue& signal);
/// Reads the feed of the signal `parameter` of `declaration`; absent if it has a mistake.
std::optional<SignalConnection> read_feed(const TomlEntry& feed, const TomlValue& signal, const Declaration& declaration,
                              std::size_t parameter, Context& context);

/// A wire met while elements are made. It is connected afterwards, because it may name an element that comes later.
struct LooseEnd {
  const SignalConnection* connection;
  std::string path;     ///< path in the scene
  std::string within;   ///< instance or member around it, for messages; "" if none
  int block = -1;       ///< block that has it as input; -1: it feeds the element
  int element = -1;
};
/// The unit of a parameter of a block.
struct OwnUnit {
  int block;
  int parameter;
  BlockUnit unit;
  const TomlValue* source;
};
/// The expression of a block's output, compiled when the units of the inputs are known; or the table.
struct BlockFunction {
  int block;
  const TomlValue* source;
  std::shared_ptr<const Environment> parameters;  ///< of an expression
  Lookup lookup;
  std::string within;  ///< as of LooseEnd
  std::vector<std::string> names;  ///< of the inputs
  const Model* law = nullptr;      ///< that it is a part of
};
struct LooseEnds {
  std::vector<LooseEnd> ends;
  std::vector<OwnUnit> units;
  std::vector<BlockFunction> functions;
};

/// Finds the sources of the wires, and checks that their units fit. `doubtful` are names that already have a mistake.
void connect(const LooseEnds& loose, const std::set<std::string>& doubtful, Context& context, Scene& scene);

}  // namespace rheonet
