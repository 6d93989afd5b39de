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

/// The contents of a page are sent as messages. Each is a line of JSON with a `kind`. A report contains the messages of its scenes; the
/// playground receives them one by one.
///
///     mistakes     errors and warnings of a netlist: severity, line and column, message, hint
///     scene        the scene that was read: title, records, elements, schematic, equations, sliders
///     catalogue    the element types that a netlist can name, and the JSON Schema of netlists
///     explanation  the equations that are solved, and why, in passages of text; or why the scene cannot be simulated
///     rows         a part of the rows: `count`, and `columns`, the times and then the values of each record, in base64 of doubles with
///                  the lowest byte first
///     energy       the energy account over time
///     events       the events with their times
///     done         the cost of the run, notes, claims
///     prices       error and work at each tolerance
///     effects      the contribution of each physical effect of the scene
///     failed       why the task did not finish
using Tell = std::function<void(const std::string& message)>;

/// The mistakes of a netlist; only those of its own file have a line and a column.
std::string mistakes_message(const ReadResult& read);

/// The message `scene`; the first `own_records` of its records are requested by the netlist itself.
std::string scene_message(const ReadResult& read, const std::string& file, std::size_t own_records);

/// The message `catalogue`: ports, parameters with an initial value, law and symbol of each element type, and the JSON Schema.
std::string catalogue_message();

/// The message `explanation`, as in `rheonet explain`. Starts the run of the scene to determine it.
std::string explanation_message(const Scene& scene);

struct RunWanted {
  std::size_t most_values = 200'000;  ///< Approximate limit of rows times records. More rows are decimated so that peaks are kept.
  std::size_t most_events = 2'000;
  bool as_they_come = false;          ///< True: send rows during the run; false: all at its end.
  std::optional<double> tolerance = {};
  const std::atomic<bool>* interrupt = nullptr;
};

/// Simulates, and sends rows, energy, events and the end. Returns whether the run was completed.
bool tell_run(const ReadResult& read, const RunWanted& wanted, const Tell& tell);

/// Adds the records that a page needs to draw loops and to animate the network, unless the scene is too large. Returns the number of
/// records before.
std::size_t record_what_pages_show(Scene& scene);

/// The message `prices`; `text` is the price list as text, "" if it is not shown.
std::string prices_message(const Scene& scene, const PriceList& list, const std::string& text);

/// The message `effects`: the models without some effects of a scene. `within` is the largest acceptable relative difference of a model.
std::string effects_message(const Scene& scene, const ModelHierarchy& models, double within);

/// Adds line and column to a message if the spot is in the scene's own file.
void add_place(const Spot& spot, nlohmann::json& message);

/// JSON as one line of text; invalid UTF-8 is replaced.
std::string to_line(const nlohmann::json& message);

}  // namespace rheonet::report
