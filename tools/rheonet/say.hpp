#pragma once

#include <fmt/format.h>

#include <cstdio>

namespace rheonet::tool {

/// Prints a message on standard error. A failure to write it is ignored, so that no result is lost.
template <class... Args>
void say(fmt::format_string<Args...> text, Args&&... args) {
  std::fputs(fmt::format(text, std::forward<Args>(args)...).c_str(), stderr);
}

}  // namespace rheonet::tool
