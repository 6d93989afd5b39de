#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"
#include "tools/plot/csv.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// Source of curves: a scene, which is simulated, or a CSV file.
class PlotSource {
 public:
  virtual ~PlotSource() = default;

  const std::string& file() const { return file_; }
  const std::string& title() const { return title_; }
  const std::vector<plot::Column>& columns() const { return columns_; }
  /// The scene's `[plot]`, if the command line names no curves.
  const PlotTable& own() const { return own_; }

  /// Whether a column has a number in any row. A column of words has none.
  virtual bool has_numbers(std::size_t) const { return true; }

  /// A curve of a pair of columns.
  struct Drawn {
    std::size_t pair;  ///< Position of the pair.
    std::string run;   ///< Label of a run of a sweep: "c1.damping = 2 N·s/m"; "": there is only one run.
    plot::Trace trace;
  };
  /// Reads the rows: for each pair of columns a trace in SI for each run of a sweep. Throws plot::Mistake; PlotEnded if a scene cannot be
  /// simulated.
  virtual std::vector<Drawn> read(const std::vector<plot::ColumnPair>& pairs) = 0;

 protected:
  std::string file_, title_;
  std::vector<plot::Column> columns_;
  PlotTable own_;
};

/// Thrown to end the command after its messages have been printed.
struct PlotEnded {
  ExitStatus status;
};

/// Opens a file: a scene if its name ends in `.toml`. The scene records the paths `wanted` in addition to its own records. With `lenient`,
/// paths of elements and nodes that the scene does not have are ignored. Throws plot::Mistake and PlotEnded.
std::unique_ptr<PlotSource> open_plot_source(const std::string& file, const Arguments& arguments,
                                             const std::vector<std::string>& wanted, bool lenient);

/// The columns of a scene's rows: `time` and its records.
std::vector<plot::Column> columns_of(const Scene& scene);

}  // namespace rheonet::tool
