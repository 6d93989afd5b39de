#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/dimension.hpp"
#include "tools/plot/trace.hpp"
#include "tools/plot/units.hpp"

namespace rheonet::plot {

/// A column of results: a record of a scene, or a column of a CSV file.
struct Column {
  std::string name;  ///< `k1.force`; of a heading with a unit, without it
  Measure measure;
};

/// The quantity of a record with a name like `k1.force`, by its last word; absent for any other name. Without a
/// domain its unit is not known, and called "SI".
std::optional<Measure> measure_of_record(const std::string& name, std::optional<Domain> domain);

/// Positions of the x and the y of a curve among the columns.
using ColumnPair = std::pair<std::size_t, std::size_t>;

/// A CSV file with a header: rows of `rheonet run`, or any other, whose headings may end with a unit ("torque
/// [in*ozf]"). Names without a unit that end like a record's, or are a measure of one ("max(k1.force)"), are taken to be in
/// SI, `time` in s; of others the unit is not known.
class CsvFile {
 public:
  /// Reads the header. Throws Mistake.
  CsvFile(const std::string& path, std::optional<Domain> domain);

  const std::vector<Column>& columns() const { return columns_; }

  /// Whether a column has a number in any row.
  bool has_numbers(std::size_t column) const;

  /// A run of a sweep whose rows are in the file.
  struct Run {
    std::string number;
    std::string values;  ///< the values that were varied: "c1.damping = 2 N·s/m"
  };
  /// The runs that did not fail, in order. Empty if the file is not a table of a sweep, or a table of measures.
  const std::vector<Run>& runs() const { return runs_; }
  /// The columns of a record against time, for each record of those runs.
  const std::vector<ColumnPair>& recorded() const { return recorded_; }

  /// Reads the rows: a trace in SI for each pair of columns. If `of_runs` has positions in `runs`, each of these runs has its own
  /// traces: first those of all pairs for the first run, then for the next. Throws Mistake: no rows, a row of another length, a
  /// field that is no number. Empty fields and values that are not finite interrupt a curve.
  std::vector<Trace> read(const std::vector<ColumnPair>& pairs, const std::vector<std::size_t>& of_runs = {}) const;

 private:
  void find_runs();

  std::string path_;
  std::vector<Column> columns_;
  std::vector<Run> runs_;
  std::vector<ColumnPair> recorded_;
  long header_line_ = 0;
};

}  // namespace rheonet::plot
