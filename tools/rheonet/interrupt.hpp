#pragma once

#include <atomic>

#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// From now on SIGINT and SIGTERM end the process with a message and exit status 1. A separate thread waits for the signal, so that it
/// works at any time. A second signal kills the process at once.
///
/// Polling a flag in every long loop is not enough: a loop without the check, a linear solver or a write to a stalled pipe would ignore
/// the signal.
void answer_signals();

/// From now on a signal sets the returned flag, and the command has one second to end by itself with a better message (the
/// simulated time, the number of runs done). After that second the thread ends the process as above, with the exit status
/// `status_when_late`; with `done`, for `serve`, which ends in no other way, without a message. In all cases the files keep all
/// complete rows written so far.
const std::atomic<bool>& end_on_signals(ExitStatus status_when_late = not_simulated);

/// Call when the command has reported the interrupt: the thread then ends the process without another message.
void interrupt_is_told();

/// From now on a closed pipe and an exceeded limit on the size of files are errors of `write`, with a message, instead of signals that kill
/// the process silently.
void fail_writes_with_errors();

}  // namespace rheonet::tool
