#pragma once

#include <atomic>

namespace rheonet::tool {

/// From now on SIGINT and SIGTERM end the process with a message and exit status 1, whatever the process is busy with: a
/// separate thread waits for the signal. A second signal kills the process at once.
///
/// Polling a flag in every long loop would be the other way; any loop without the check, a linear solver or a write to a
/// stalled pipe would still ignore the signal.
void answer_signals();

/// From now on a signal sets the returned flag, and the command has one second to end by itself with a better message (the
/// simulated time, the number of runs done). After that second the thread ends the process as above. Either way files keep
/// all whole rows up to there.
const std::atomic<bool>& end_on_signals();

/// The command has reported the interrupt, so the thread ends the process without another message.
void interrupt_is_told();

/// A reader that goes away and a limit on the size of files are from now on errors of write, with a message, instead of
/// a silent death.
void fail_writes_with_errors();

}  // namespace rheonet::tool
