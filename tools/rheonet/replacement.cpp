#include "tools/rheonet/replacement.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <system_error>
#include <utility>

namespace rheonet::tool {
namespace {

/// Gives the new file the owner and the mode of the old one. Only root can change the owner; for other users the new file is theirs, as
/// with an editor.
int take_over(int descriptor, const struct stat& old) {
  if (::fchown(descriptor, old.st_uid, old.st_gid) != 0 && errno != EPERM) return errno;
  constexpr mode_t permissions = S_IRWXU | S_IRWXG | S_IRWXO;
  return ::fchmod(descriptor, old.st_mode & permissions) == 0 ? 0 : errno;
}

}  // namespace

Replacement::Replacement(int folder, std::string name) : folder_(folder), name_(std::move(name)) {
  constexpr mode_t as_the_umask_leaves = 0666;
  do {
    std::uint64_t number = 0;
    if (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number))
      throw std::system_error(errno, std::generic_category());
    temporary_ = fmt::format(".rheonet-{:016x}", number);
    descriptor_ = ::openat(folder_, temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, as_the_umask_leaves);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());
}

Replacement::~Replacement() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlinkat(folder_, temporary_.c_str(), 0);
}

int Replacement::commit() {
  struct stat old {};
  const bool is_new = ::fstatat(folder_, name_.c_str(), &old, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(old.st_mode);
  if (const int error = is_new ? 0 : take_over(descriptor_, old); error != 0) return error;
  // A full disk may be reported only here.
  if (::fsync(descriptor_) != 0) return errno;
  if (const int closed = ::close(std::exchange(descriptor_, -1)); closed != 0) return errno;
  if (::renameat(folder_, temporary_.c_str(), folder_, name_.c_str()) != 0) return errno;
  committed_ = true;
  // The name is an entry of the folder, which must reach the disk too. Some file systems cannot sync a folder.
  return ::fsync(folder_) == 0 || errno == EINVAL ? 0 : errno;
}

int write_text(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace rheonet::tool
