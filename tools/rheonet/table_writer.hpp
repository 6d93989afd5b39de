#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tools/tables/table_file.hpp"

namespace rheonet::tool {

/// A format of tables other than CSV, which a part of rheonet writes that is loaded when it is needed.
struct TableFormat {
  const char* ending;   ///< of the file: ".nc"
  const char* part;     ///< its file: "librheonet_netcdf.so"
  const char* package;  ///< Debian's, with which rheonet has to be built
};

/// Of the name of a file; nullptr if it is not the name of such a table.
const TableFormat* table_format(const std::string& path);

/// Turns rows of CSV into a table of another format.
class TableWriter {
 public:
  /// Loads the part of rheonet for the format. Throws std::runtime_error if it is missing.
  TableWriter(const TableFormat& format, tables::Layout layout);
  ~TableWriter();

  /// Creates or replaces the file. Throws std::system_error, as the others do.
  void begin(const char* path);
  /// Takes a part of a CSV text: its first line names the columns, each further line has a cell for each.
  void take(std::string_view text);
  /// After the last line.
  void close();

 private:
  void take_line(std::string_view line);
  void put();

  tables::Layout layout_;
  tables::OpenTableFile* open_ = nullptr;
  std::unique_ptr<tables::TableFile> file_;
  tables::Rows rows_;
  std::string begun_;  ///< a line that has no end yet
  bool has_header_ = false;
};

}  // namespace rheonet::tool
