#pragma once

#include <functional>

#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// The body of a program's `main`: reads the command line, calls `command`, and prints errors.
int run_program(int count, char** words, const std::function<ExitStatus(const Arguments&)>& command);

}  // namespace rheonet::tool
