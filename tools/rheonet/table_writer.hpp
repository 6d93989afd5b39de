#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tools/tables/table_file.hpp"

namespace rheonet::tool {

/// A format of tables other than CSV. A shared library, loaded on demand, writes it.
struct TableFormat {
  const char* ending;   ///< Ending of the file's name: ".nc".
  const char* part;     ///< Shared library: "librheonet_netcdf.so".
  const char* package;  ///< Debian package that is needed to build the library.
};

/// The format for a file's name; nullptr if there is none.
const TableFormat* table_format(const std::string& path);

/// Turns rows of CSV into a table of another format.
class TableWriter {
 public:
  /// Loads the shared library for the format. Throws std::runtime_error if it is missing.
  TableWriter(const TableFormat& format, tables::Layout layout);
  ~TableWriter();

  /// Creates or replaces the file. Throws std::system_error, like the other methods.
  void begin(const char* path);
  /// Takes a piece of a CSV text, whose first line names the columns.
  void take(std::string_view text);
  /// Call after the last line.
  void close();

 private:
  void take_line(std::string_view line);
  void put();

  tables::Layout layout_;
  tables::OpenTableFile* open_ = nullptr;
  std::unique_ptr<tables::TableFile> file_;
  tables::Rows rows_;
  std::string begun_;  ///< The incomplete last line.
  bool has_header_ = false;
};

}  // namespace rheonet::tool
