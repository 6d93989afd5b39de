#pragma once

#include <stdexcept>
#include <string>

namespace rheonet::plot {

/// Why a figure cannot be drawn from what was given: what was found, and what would mend it.
struct Mistake : std::runtime_error {
  explicit Mistake(const std::string& what, std::string mend = "") : std::runtime_error(what), hint(std::move(mend)) {}
  std::string hint;  ///< may be empty
};

}  // namespace rheonet::plot
