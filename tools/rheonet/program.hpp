#pragma once

#include <functional>

#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// A program's `main`: reads its command line, has it carried out, and says what went wrong.
int run_program(int count, char** words, const std::function<ExitStatus(const Arguments&)>& command);

}  // namespace rheonet::tool
