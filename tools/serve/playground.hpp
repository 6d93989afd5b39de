#pragma once

#include "tools/rheonet/arguments.hpp"

namespace rheonet::serve {

/// Serves the playground until an interrupt, or runs as one of its workers.
tool::ExitStatus play(const tool::ServeArguments& wanted);

}  // namespace rheonet::serve
