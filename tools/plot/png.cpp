#include "tools/plot/png.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

// The tool rather than the library: loading librsvg and what it needs (pango, glib, cairo) would cost every run of
// every scene tens of milliseconds, for a picture that few want.

extern char** environ;

namespace rheonet::plot {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::string text_of(std::FILE* file) {
  std::rewind(file);
  char buffer[512];
  const std::size_t size = std::fread(buffer, 1, sizeof buffer, file);
  std::string text(buffer, size);
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> write_png(const std::string& svg, const std::string& path) {
  // Files without a name in place of pipes: nothing can block, or be left behind.
  const File input(std::tmpfile()), errors(std::tmpfile());
  if (!input || !errors || std::fwrite(svg.data(), 1, svg.size(), input.get()) != svg.size() ||
      std::fflush(input.get()) != 0)
    return std::string("a temporary file cannot be written: ") + std::strerror(errno);
  std::rewind(input.get());

  const std::string output = "--output=" + path;
  const char* const words[] = {"rsvg-convert", "--format=png", "--zoom=1.5", output.c_str(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(errors.get()), STDERR_FILENO);
  pid_t process = 0;
  const int failed = ::posix_spawnp(&process, words[0], &actions, nullptr, const_cast<char* const*>(words), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT)
    return "a .png is made by rsvg-convert, which is not installed (Debian: apt-get install librsvg2-bin); an .svg "
           "needs "
           "nothing";
  if (failed != 0) return std::string("rsvg-convert cannot be started: ") + std::strerror(failed);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string said = text_of(errors.get());
  return "rsvg-convert could not make the .png" + (said.empty() ? "" : ": " + said);
}

}  // namespace rheonet::plot
