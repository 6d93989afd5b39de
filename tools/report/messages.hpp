#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/read.hpp"
#include "core/result/model_hierarchy.hpp"
#include "core/result/work_precision.hpp"

namespace rheonet::report {

/// What a page shows is told in messages: a line of JSON each, whose `kind` says what it holds. A report is made of
/// those of its scenes; the playground gets them as they come.
///
///     mistakes     what is wrong with a netlist, or doubtful: severity, line and column, message, hint
///     scene        what was read: title, records, elements, schematic, equations, sliders
///     catalogue    the element types that a netlist can name, and the JSON Schema of netlists
///     explanation  what is simulated, and why: passages in words; or why it cannot be
///     rows         a part of the rows, by column
///     energy       the energy account over time
///     events       what switched, and when
///     done         what the run took, notes, claims
///     prices       what accuracy costs: error and work at each tolerance
///     effects      what each physical effect of the scene changes
///     failed       why it did not come to its end
using Tell = std::function<void(const std::string& message)>;

/// The mistakes of a netlist; only those of its own file have a line and a column.
std::string mistakes_message(const ReadResult& read);

/// What the scene is; the first `own_records` of its records are those that it asks for itself.
std::string scene_message(const ReadResult& read, const std::string& file, std::size_t own_records);

/// The element types: ports, parameters with a value to begin with, law and symbol; and the JSON Schema. It needs no netlist.
std::string catalogue_message();

/// What `rheonet explain` says of a scene; the run is begun for that.
std::string explanation_message(const Scene& scene);

struct RunWanted {
  std::size_t most_values = 200'000;  ///< rows times records, about; of more rows peaks are kept
  std::size_t most_events = 2'000;
  bool as_they_come = false;          ///< rows are told while the run goes on; else all at once
  std::optional<double> tolerance = {};
  const std::atomic<bool>* interrupt = nullptr;
};

/// Simulates, and tells rows, energy, events and the end. Whether it came to its end.
bool tell_run(const ReadResult& read, const RunWanted& wanted, const Tell& tell);

/// Adds to what a scene records all that a page needs to draw loops and to move the network, if it is not too large.
/// How many records were there before.
std::size_t record_what_pages_show(Scene& scene);

/// The price list of a scene; `text` says the same in words, "" if nobody reads them.
std::string prices_message(const Scene& scene, const PriceList& list, const std::string& text);

/// The models without some of the effects of a scene; `within` is the largest relative difference of one that is good enough.
std::string effects_message(const Scene& scene, const ModelHierarchy& models, double within);

/// Adds the line and column of what stands in the scene's own file.
void add_place(const Spot& spot, nlohmann::json& message);

/// Text as JSON: what is no UTF-8 is replaced.
std::string to_line(const nlohmann::json& message);

}  // namespace rheonet::report
