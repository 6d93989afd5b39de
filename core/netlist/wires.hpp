#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/plan.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// The inputs of a block: `in = "drum.velocity"`, or `in = ["command", "-drum.velocity"]` where it takes several.
std::vector<Wire> read_inputs(const Declaration& declaration, const std::string& called, Spot spot, Keys& keys,
                              Mistakes& mistakes);

/// `{ block = "controller" }` in place of a signal; nullptr if it is none.
const TomlEntry* find_feed(const TomlValue& signal);
/// That, for the signal `parameter` of `declaration`; absent if there is something wrong with it.
std::optional<Wire> read_feed(const TomlEntry& feed, const TomlValue& signal, const Declaration& declaration,
                              std::size_t parameter, Context& context);

/// What is known of the wires of a scene while its elements are made: they name what may come later.
struct LooseEnd {
  const Wire* wire;
  std::string path;     ///< in the scene
  std::string within;   ///< the instance or member that it is in, for messages; "" if none
  int block = -1;       ///< that takes it in; -1: it feeds the element
  int element = -1;
};
/// The unit of a parameter of a block.
struct OwnUnit {
  int block;
  int parameter;
  BlockUnit unit;
  const TomlValue* source;
};
struct LooseEnds {
  std::vector<LooseEnd> ends;
  std::vector<OwnUnit> units;
};

/// Finds what the wires come from, and checks that their units fit. `doubtful` is what something is wrong with already.
void connect(const LooseEnds& loose, const std::set<std::string>& doubtful, Context& context, Scene& scene);

}  // namespace rheonet
