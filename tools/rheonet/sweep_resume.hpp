#pragma once

#include <functional>
#include <string>
#include <variant>

#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// What an interrupted sweep left in its file.
struct Left {
  long runs = 0;          ///< the first of them are whole
  std::size_t bytes = 0;  ///< which these are, with the header
  long lines = 0;
  std::string last;  ///< what stands behind them: of the last run, which may lack its end
};

/// Reads it, run by run. What is wrong with it instead: it is no part of a table that begins with `header` and whose rows of
/// run number k, from 0 on, begin with `key(k)`.
std::variant<Left, NoVariation> what_is_left(const std::string& file, const std::string& header, long runs,
                                             const std::function<std::string(long run)>& key);

}  // namespace rheonet::tool
