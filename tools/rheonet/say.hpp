#pragma once

#include <fmt/format.h>

#include <cstdio>

namespace rheonet::tool {

/// Prints a message on standard error. That it cannot be read there is no reason to lose a result.
template <class... Args>
void say(fmt::format_string<Args...> text, Args&&... args) {
  std::fputs(fmt::format(text, std::forward<Args>(args)...).c_str(), stderr);
}

}  // namespace rheonet::tool
