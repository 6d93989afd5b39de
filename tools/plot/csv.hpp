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

/// What a record of the name `k1.force` measures, by its last word; nothing of a name that is no record's. Without a
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

  /// Reads the rows: a trace in SI for each pair of columns. Throws Mistake: no rows, a row of another length, a field
  /// that is no number. Fields that are empty, and values that are not finite,
  /// interrupt a curve.
  std::vector<Trace> read(const std::vector<ColumnPair>& pairs) const;

 private:
  std::string path_;
  std::vector<Column> columns_;
  long header_line_ = 0;
};

}  // namespace rheonet::plot
