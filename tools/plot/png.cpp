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
  std::string text;
  char piece[1U << 16U];
  for (std::size_t size = 0; (size = std::fread(piece, 1, sizeof piece, file)) > 0;) text.append(piece, size);
  return text;
}

}  // namespace

std::variant<Png, NoPng> png(const std::string& svg) {
  // Files without a name in place of pipes: nothing can block, or be left behind.
  const File input(std::tmpfile()), output(std::tmpfile()), errors(std::tmpfile());
  if (!input || !output || !errors || std::fwrite(svg.data(), 1, svg.size(), input.get()) != svg.size() ||
      std::fflush(input.get()) != 0)
    return NoPng{std::string("a temporary file cannot be written: ") + std::strerror(errno)};
  std::rewind(input.get());

  const char* const words[] = {"rsvg-convert", "--format=png", "--zoom=1.5", nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(output.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(errors.get()), STDERR_FILENO);
  pid_t process = 0;
  const int failed = ::posix_spawnp(&process, words[0], &actions, nullptr, const_cast<char* const*>(words), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT)
    return NoPng{
        "a .png is made by rsvg-convert, which is not installed (Debian: apt-get install librsvg2-bin); an .svg needs nothing"};
  if (failed != 0) return NoPng{std::string("rsvg-convert cannot be started: ") + std::strerror(failed)};
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return Png{text_of(output.get())};
  std::string said = text_of(errors.get());
  while (said.ends_with('\n')) said.pop_back();
  return NoPng{"rsvg-convert could not make the .png" + (said.empty() ? "" : ": " + said)};
}

}  // namespace rheonet::plot
