#pragma once

#include <atomic>

namespace rheonet::tool {

/// From now on the first SIGINT or SIGTERM only sets the flag that this returns, which ends a simulation with a
/// message; a second one ends the process.
const std::atomic<bool>& end_on_signals();

/// A reader that goes away and a limit on the size of files are from now on errors of write, with a message, instead of
/// a silent death.
void fail_writes_with_errors();

}  // namespace rheonet::tool
