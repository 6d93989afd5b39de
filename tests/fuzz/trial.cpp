#include "tests/fuzz/trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/program.hpp"

namespace rheonet::test {

namespace {

using Clock = std::chrono::steady_clock;

/// A file without a name, in memory.
struct Memory {
  int descriptor = ::memfd_create("fuzz", MFD_CLOEXEC);
  Memory() {
    if (descriptor < 0) throw std::runtime_error("no file in memory");
  }
  ~Memory() { ::close(descriptor); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  std::string text() const {
    std::string result(static_cast<std::size_t>(::lseek(descriptor, 0, SEEK_END)), '\0');
    ::lseek(descriptor, 0, SEEK_SET);
    const ssize_t size = ::read(descriptor, result.data(), result.size());
    result.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    return result;
  }
};

/// Whether a word stands in a text, in any case, with no letter beside it, nor the dots at which a message cuts a long line.
bool has_word(std::string_view text, std::string_view word) {
  const auto letter = [&](std::size_t k) { return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])); };
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  for (auto at = text.begin();; ++at) {
    at = std::search(at, text.end(), word.begin(), word.end(), same);
    if (at == text.end()) return false;
    const auto k = static_cast<std::size_t>(at - text.begin());
    const bool cut = text.substr(0, k).ends_with("...") || text.substr(k + word.size()).starts_with("...");
    if (!cut && !(k > 0 && letter(k - 1)) && !letter(k + word.size())) return true;
  }
}

rheonet::tool::ExitStatus carry_out(const rheonet::tool::Arguments& arguments) {
  using namespace rheonet::tool;
  using Command = Arguments::Command;
  switch (arguments.command) {
    case Command::check:
      return check_scene(arguments);
    case Command::explain:
      return explain_scene(arguments);
    case Command::draw:
      return draw_network(arguments);
    case Command::effects:
      return weigh_effects(arguments);
    default:
      return run_scene(arguments);
  }
}

[[noreturn]] void be_program(std::vector<std::string> words, int out, int err, const TrialLimits& limits) {
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
#ifndef __SANITIZE_ADDRESS__
  const rlim_t bytes = static_cast<rlim_t>(limits.megabytes) << 20;
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
#else
  static_cast<void>(limits);
#endif
  words.insert(words.begin(), "rheonet");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  const int status = rheonet::tool::run_program(static_cast<int>(pointers.size()), pointers.data(), carry_out);
  std::fflush(nullptr);
  ::_exit(status);
}

/// Waits until a process ends, or has used this much more CPU time, or is stalled. On a busy machine the clock says nothing of a
/// process that computes; one that waits for something uses no CPU time.
bool ends_within(pid_t process, int handle, double cpu_seconds) {
  constexpr int tick = 5;          // ms
  constexpr double stalled = 120;  // s
  clockid_t clock{};
  if (::clock_getcpuclockid(process, &clock) != 0) return true;
  const auto cpu = [&] {
    std::timespec used{};
    return ::clock_gettime(clock, &used) == 0 ? static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec) : 0;
  };
  const double before = cpu();
  const auto begin = Clock::now();
  for (;;) {
    pollfd item{handle, POLLIN, 0};
    if (::poll(&item, 1, tick) > 0) return true;
    if (cpu() - before > cpu_seconds || std::chrono::duration<double>(Clock::now() - begin).count() > stalled) return false;
  }
}

std::string fault_of_rows(const std::string& out) {
  const std::size_t header = out.find('\n');
  if (!out.starts_with("time,") || header == std::string::npos) return "";
  const std::string_view rows = std::string_view(out).substr(header);
  for (const char* const word : {"nan", "inf"})
    if (has_word(rows, word)) return fmt::format("a row has `{}` in it", word);
  return "";
}

std::string fault_of_message(const std::string& said, const std::string& netlist) {
  // The TOML library tells of the `nan` that it takes any word with an n for.
  const bool own = said.find("not valid TOML") == std::string::npos;
  if (own && has_word(said, "nan") && !has_word(netlist, "nan")) return "a message has `nan` in it";
  if (said.find("a mistake in rheonet itself") != std::string::npos) return "a mistake in rheonet itself";
  return "";
}

}  // namespace

Trial try_program(const std::vector<std::string>& words, const std::string& netlist, const TrialLimits& limits) {
  const int file = ::open(words.back().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0 || ::write(file, netlist.data(), netlist.size()) != static_cast<ssize_t>(netlist.size()))
    throw std::runtime_error("the netlist cannot be written");
  ::close(file);
  const Memory out, err;
  std::fflush(nullptr);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error(std::string("no process: ") + std::strerror(errno));
  if (process == 0) be_program(words, out.descriptor, err.descriptor, limits);
  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
  Trial trial;
  if (!ends_within(process, handle, limits.cpu_seconds)) {
    trial.interrupted = true;
    ::kill(process, SIGTERM);
    if (!ends_within(process, handle, limits.answer_seconds)) {
      trial.fault = "a signal is not answered";
      ::kill(process, SIGKILL);
    }
  }
  ::close(handle);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  trial.said = err.text();
  if (!trial.fault.empty()) return trial;
  if (WIFSIGNALED(status)) {
    // Before the program is ready for signals one ends it as the system does.
    if (!(trial.interrupted && WTERMSIG(status) == SIGTERM)) trial.fault = fmt::format("ended by signal {}", WTERMSIG(status));
    return trial;
  }
  trial.status = WEXITSTATUS(status);
  if (trial.status > 2) trial.fault = fmt::format("exit status {}", trial.status);
  if (trial.fault.empty() && trial.status != 0 && trial.said.empty()) trial.fault = fmt::format("exit status {} without a message", trial.status);
  if (trial.fault.empty()) trial.fault = fault_of_rows(out.text());
  if (trial.fault.empty()) trial.fault = fault_of_message(trial.said, netlist);
  return trial;
}

std::string try_read(const std::string& netlist, const std::filesystem::path& folder, const std::filesystem::path& library) {
  try {
    const ReadResult read = read_scene_text(netlist, "scene.toml", folder, declarations(), {.overrides = {}, .model_folders = {library}});
    std::string said;
    bool wrong = false;
    for (const Diagnostic& diagnostic : read.diagnostics) {
      said += format(diagnostic, read.sources);
      wrong = wrong || diagnostic.severity == Severity::error;
    }
    if (!read.scene && !wrong) return "refused without a message";
    if (read.scene && wrong) return "a scene in spite of a mistake";
    return fault_of_message(said, netlist);
  } catch (const std::bad_alloc&) {
    return "";  // as the program: it says so
  } catch (const std::exception& error) {
    return std::string("threw: ") + error.what();
  }
}

}  // namespace rheonet::test
