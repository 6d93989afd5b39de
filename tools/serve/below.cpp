#include "tools/serve/below.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace rheonet::serve {

namespace fs = std::filesystem;

namespace {

/// Why opening an entry of a folder failed with `error` (errno); "" if there is no entry with that name.
std::string why_not(int folder, const fs::path& part, int error) {
  struct stat status {};
  if (::fstatat(folder, part.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 && errno == ENOENT) return "";
  if (S_ISLNK(status.st_mode)) return fmt::format("`{}` is a symbolic link, and links are not followed here", part.string());
  return std::strerror(error);
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

Descriptor open_parent(int root, const fs::path& file, std::string& why) {
  constexpr int as_folder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  Descriptor folder(::openat(root, ".", as_folder));
  if (!folder.is_open()) why = std::strerror(errno);
  for (const fs::path& part : file.parent_path()) {
    if (!folder.is_open()) break;
    Descriptor inner(::openat(folder.get(), part.c_str(), as_folder));
    if (!inner.is_open()) why = why_not(folder.get(), part, errno);
    folder = std::move(inner);
  }
  return folder;
}

std::optional<std::string> text_below(int root, const fs::path& file, std::size_t most, std::string& why) {
  const Descriptor folder = open_parent(root, file, why);
  if (!folder.is_open()) return {};
  const fs::path name = file.filename();
  // A pipe without a writer must not block.
  const Descriptor opened(::openat(folder.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  if (!opened.is_open()) return why = why_not(folder.get(), name, errno), std::nullopt;
  struct stat status {};
  if (::fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode)) return why = "it is no regular file", std::nullopt;
  std::string text;
  std::array<char, 1U << 16U> piece;
  for (;;) {
    const ssize_t count = ::read(opened.get(), piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return why = std::strerror(errno), std::nullopt;
    if (count == 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(count));
    if (text.size() > most) return why = fmt::format("it has more than {} MB", most >> 20U), std::nullopt;
  }
}

bool is_hidden(const fs::path& path) {
  return std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part.string().starts_with('.'); });
}

OfferedFolder::OfferedFolder(const fs::path& folder) : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (!folder_.is_open()) throw std::system_error(errno, std::generic_category(), "the folder cannot be opened");
}

std::optional<std::string> OfferedFolder::text_of(const fs::path& path, std::string& why) const {
  constexpr std::size_t most = 64U << 20U;  // Largest file [bytes]: more than a run of the playground can handle.
  if (is_hidden(path)) return why = "a name that begins with a dot is hidden, and not served", std::nullopt;
  const fs::path ending = path.extension();
  if (ending != ".toml" && ending != ".csv" && ending != ".lesson") return why = "only .toml, .csv and .lesson files are served", std::nullopt;
  return text_below(folder_.get(), path, most, why);
}

}  // namespace rheonet::serve
