#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rheonet {

/// "`a`, `b` and 3 more", for messages: at most `most` names.
inline std::string format_list(const std::vector<std::string>& names, std::size_t most = 5) {
  std::string text;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) text += fmt::format("{}`{}`", k ? ", " : "", names[k]);
  return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
}

}  // namespace rheonet
