#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "tools/rheonet/spool.hpp"
#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// The part of an interrupted sweep's file that can be kept.
struct Left {
  long runs = 0;          ///< Runs before this number are complete.
  std::size_t bytes = 0;  ///< Size of the complete runs and of the lines before them.
  long lines = 0;
  long failed = 0;  ///< Number of complete runs that failed.
  std::size_t head = 0;  ///< Size of the lines before the first row.
  std::size_t last = 0;  ///< Size of the text after the complete runs: the last run, whose end may be missing [bytes].
};

/// The table that the file should be the beginning of.
struct Expected {
  std::string remark;  ///< Line before the header; "": none.
  std::string header;
  std::string end;  ///< Line after the last row; "": none.
  long first = 0, behind = 0;  ///< Runs first .. behind - 1, counted from 0.
  std::function<std::string(long run)> key;  ///< The cells that each row of a run begins with.
};

/// Whether a row of a sweep's table is that of a failed run: its last cell has the reason.
bool is_of_failed_run(std::string_view row);

/// Whether a line, without its end, is a row of a table with so many columns. `key` are the cells that it has to begin with. The cells after them are
/// empty or finite numbers. Only the last may be a text, the reason why the run failed.
bool is_row(std::string_view line, std::string_view key, std::size_t columns);

/// The line, counted from 0, in which a text differs from a piece of a file that should be its beginning, `size` bytes from `begin` on. Absent
/// if they do not differ. Empties the text. Throws WriteError.
std::optional<long> first_difference(const std::string& file, std::size_t begin, std::size_t size, Spool& text);

/// Reads the file run by run. Returns a NoVariation if it is not the beginning of the expected table.
std::variant<Left, NoVariation> what_is_left(const std::string& file, const Expected& expected);

}  // namespace rheonet::tool
