#pragma once

#include <functional>
#include <string>
#include <variant>

#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// What an interrupted sweep left in its file.
struct Left {
  long runs = 0;          ///< those before this one are whole
  std::size_t bytes = 0;  ///< which these are, with the lines before them
  long lines = 0;
  std::string last;  ///< what stands behind them: of the last run, which may lack its end
};

/// The table that the file should hold the beginning of.
struct Expected {
  std::string remark;  ///< a line before the header; "": none
  std::string header;
  std::string end;  ///< a line behind the last row; "": none
  long first = 0, behind = 0;  ///< runs, counted from 0
  std::function<std::string(long run)> key;  ///< what each row of a run begins with
};

/// Reads it, run by run. What is wrong with it instead: it is no part of such a table.
std::variant<Left, NoVariation> what_is_left(const std::string& file, const Expected& expected);

}  // namespace rheonet::tool
