#include "tests/wiring/apart.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace rheonet::test {

namespace {

struct Child {
  int number;
  pid_t process;
  int output;  ///< The end of the pipe to which the child writes.
  std::string text;
};

[[noreturn]] void be_child(const Apart& apart, int number, int output) {
  const auto limit = static_cast<rlim_t>(apart.seconds);
  const rlimit limits{limit, limit + 1};
  setrlimit(RLIMIT_CPU, &limits);
  // The parent reports a crash, not an inherited signal handler.
  for (const int fatal : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS}) std::signal(fatal, SIG_DFL);
  int status = 1;
  std::string text;
  try {
    text = apart.work(number);
    status = 0;
  } catch (const std::exception& error) {
    text = error.what();
  }
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(output, text.data() + sent, text.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(2);
    sent += static_cast<std::size_t>(n);
  }
  _exit(status);
}

Child started(const Apart& apart, int number) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error(std::string("no process: ") + std::strerror(errno));
  if (process == 0) {
    close(ends[0]);
    be_child(apart, number, ends[1]);
  }
  close(ends[1]);
  return {number, process, ends[0], ""};
}

/// Reads the available output. Returns false at its end.
bool read_some(Child& child) {
  char buffer[4096];
  const ssize_t n = read(child.output, buffer, sizeof buffer);
  if (n < 0) return errno == EINTR;
  child.text.append(buffer, static_cast<std::size_t>(n));
  return n > 0;
}

void finish(const Apart& apart, const Child& child) {
  close(child.output);
  int status = 0;
  while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return apart.done(child.number, child.text);
  const bool slow = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  apart.lost(child.number, slow                  ? fmt::format("did not end within {} s of a core", apart.seconds)
                           : WIFSIGNALED(status) ? fmt::format("crashed: {}", strsignal(WTERMSIG(status)))
                                                 : child.text);
}

}  // namespace

void Apart::run(const std::vector<int>& numbers) const {
  std::vector<Child> children;
  std::size_t next = 0;
  while (next < numbers.size() || !children.empty()) {
    while (next < numbers.size() && children.size() < static_cast<std::size_t>(jobs)) {
      children.push_back(started(*this, numbers[next++]));
    }
    std::vector<pollfd> waiting;
    for (const Child& child : children) waiting.push_back({child.output, POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), -1) < 0) continue;
    for (std::size_t k = children.size(); k-- > 0;) {
      if (waiting[k].revents == 0 || read_some(children[k])) continue;
      const Child child = children[k];
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(k));
      finish(*this, child);
    }
  }
}

}  // namespace rheonet::test
