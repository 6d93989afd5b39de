#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"
#include "tools/plot/csv.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// What curves come from: a scene, which is simulated, or a CSV file.
class PlotSource {
 public:
  virtual ~PlotSource() = default;

  const std::string& file() const { return file_; }
  const std::string& title() const { return title_; }
  const std::vector<plot::Column>& columns() const { return columns_; }
  /// What a scene wants drawn, if that was left to it.
  const PlotTable& own() const { return own_; }

  /// Whether a column has a number in any row: one of words has not.
  virtual bool has_numbers(std::size_t) const { return true; }

  /// A curve of a pair of columns.
  struct Drawn {
    std::size_t pair;  ///< its position
    std::string run;   ///< what tells a run of a sweep from the others: "c1.damping = 2 N·s/m"; "": there is but one
    plot::Trace trace;
  };
  /// Goes through the rows: traces in SI for each pair of columns, one for each run of a sweep. Throws plot::Mistake; PlotEnded
  /// if a scene cannot be simulated.
  virtual std::vector<Drawn> read(const std::vector<plot::ColumnPair>& pairs) = 0;

 protected:
  std::string file_, title_;
  std::vector<plot::Column> columns_;
  PlotTable own_;
};

/// Ends the command: what there is to say has been said.
struct PlotEnded {
  ExitStatus status;
};

/// Opens a file: a scene if it ends in `.toml`. `wanted` are the paths that a scene is to record besides its own; those
/// that it has no element or node for are passed over if `lenient`. Throws plot::Mistake and PlotEnded.
std::unique_ptr<PlotSource> open_plot_source(const std::string& file, const Arguments& arguments,
                                             const std::vector<std::string>& wanted, bool lenient);

/// The columns of a scene's rows: `time`, and its records.
std::vector<plot::Column> columns_of(const Scene& scene);

}  // namespace rheonet::tool
