#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rheonet::tables {

/// A column of a table.
struct Column {
  enum class Kind { number, whole_number, text };
  std::string name;
  std::string unit;  ///< "1" for a number without a unit; "" if not known
  Kind kind = Kind::number;
};

/// A table before it has rows.
struct Layout {
  std::string title, program;
  std::string row;  ///< what a row is: "time", "run"
  std::vector<Column> columns;
};

/// Some rows of a table, column by column.
struct Rows {
  std::size_t count = 0;
  std::vector<std::vector<double>> numbers;     ///< of each column; empty for text; NaN for a cell without a value
  std::vector<std::vector<std::string>> texts;  ///< of each column; empty for numbers
};

/// A file of a table that is being written. Each format is a library of its own, loaded when a table is to be written to it: the
/// libraries behind it take longer to load than most scenes to simulate.
class TableFile {
 public:
  virtual ~TableFile() = default;
  /// Throws std::system_error (disk full, say).
  virtual void append(const Rows& rows) = 0;
  /// After the last rows. Throws std::system_error.
  virtual void close() = 0;
};

/// The function `open_table_file` that each of these libraries exports. Replaces the file. Throws std::system_error.
using OpenTableFile = TableFile*(const char* path, const Layout& layout);

}  // namespace rheonet::tables
