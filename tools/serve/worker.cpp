#include "tools/serve/worker.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

extern char** environ;

namespace rheonet::serve {
namespace {

struct Pipe {
  int ends[2];
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  }
};

/// Waits until a process has ended. Returns its status.
int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

Worker::Worker(const Limits& limits, int folder) {
  const Pipe to, from;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to.ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, folder, folder_descriptor);
  posix_spawn_file_actions_addclosefrom_np(&actions, folder_descriptor + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A process group of its own, so that Ctrl-C reaches only the server, which ends its workers.
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string time = fmt::format("--time-limit={}", limits.seconds), memory = fmt::format("--memory-limit={}", limits.megabytes);
  char name[] = "rheonet-serve", command[] = "serve", worker[] = "--worker";
  char* const words[] = {name, command, worker, time.data(), memory.data(), nullptr};
  const int error = ::posix_spawn(&process_, "/proc/self/exe", &actions, &attributes, words, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(to.ends[0]);
  ::close(from.ends[1]);
  in_ = to.ends[1];
  out_ = from.ends[0];
  if (error == 0) return;
  ::close(in_);
  ::close(out_);
  throw std::system_error(error, std::generic_category(), "cannot start a process");
}

Worker::~Worker() {
  ::close(in_);
  ::close(out_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  wait_for(process_);
}

Worker::Ending Worker::ending() {
  const int status = wait_for(process_);
  process_ = -1;
  if (WIFSIGNALED(status))
    return {false, fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))};
  const int code = WEXITSTATUS(status);
  return {code == out_of_memory, fmt::format("exit status {}", code)};
}

double Worker::cpu_seconds() const {
  clockid_t clock{};
  std::timespec time{};
  if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;  // The process has ended.
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void Worker::step_aside() {
  // Set the priority of the worker's process group; PRIO_PROCESS would change only the first thread.
  ::setpriority(PRIO_PGRP, static_cast<id_t>(process_), 19);
  aside_ = true;
}

bool Worker::give(const std::string& task) {
  const std::string line = task + '\n';
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = ::write(in_, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

Worker::Answer Worker::take(std::string& message, std::chrono::milliseconds patience) {
  constexpr std::size_t piece = 1u << 16;
  for (;;) {
    const std::size_t end = buffer_.find('\n', std::max(begin_, searched_));
    if (end != std::string::npos) {
      message.assign(buffer_, begin_, end - begin_);
      begin_ = searched_ = end + 1;
      return message.empty() ? Answer::end : Answer::message;
    }
    searched_ = buffer_.size();
    pollfd item{out_, POLLIN, 0};
    const int ready = ::poll(&item, 1, static_cast<int>(patience.count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) return Answer::nothing;
    if (begin_ > 0) {
      buffer_.erase(0, begin_);
      searched_ -= begin_;
      begin_ = 0;
    }
    const std::size_t before = buffer_.size();
    buffer_.resize(before + piece);
    const ssize_t count = ::read(out_, buffer_.data() + before, piece);
    buffer_.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count <= 0) return Answer::gone;
    // Return, so that the caller can check the size before more is read.
    if (buffer_.find('\n', searched_) == std::string::npos) return Answer::nothing;
  }
}

}  // namespace rheonet::serve
