#include "tools/rheonet/interrupt.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include "tools/rheonet/output.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {
namespace {

// Time for a command to end by itself: enough for many steps of a simulation, and half of the documented 2 s.
constexpr std::chrono::milliseconds orderly_end{1000};

std::atomic<bool> interrupted = false, ends_by_itself = false, reported = false;
std::atomic<ExitStatus> late_status = not_simulated;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else, but post a semaphore");
sem_t signalled;

/// Ends the process while its other threads are still running.
[[noreturn]] void end_process() {
  // Files must end with a complete row: a write in progress is completed, or its incomplete last row is removed.
  const std::string kept = Output::finish_all();
  if (!reported && late_status != done) say("{}error: interrupted\n{}", ::isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "", kept);
  ::_exit(late_status);
}

void wait_for_signal() {
  while (::sem_wait(&signalled) != 0 && errno == EINTR) {
  }
  if (ends_by_itself) std::this_thread::sleep_for(orderly_end);
  end_process();
}

}  // namespace

void answer_signals() {
  ::sem_init(&signalled, 0, 0);
  std::thread(wait_for_signal).detach();
  struct sigaction action {};
  action.sa_handler = [](int) {
    interrupted = true;
    ::sem_post(&signalled);
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& end_on_signals(ExitStatus status_when_late) {
  late_status = status_when_late;
  ends_by_itself = true;
  return interrupted;
}

void interrupt_is_told() {
  if (interrupted) reported = true;
}

void fail_writes_with_errors() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace rheonet::tool
