#include "core/result/temporary_file.hpp"

#include <fmt/format.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/result/csv.hpp"

namespace rheonet {
namespace {

/// Calls ::pwrite or ::pread until all bytes are done. Returns false after an error.
template <class Transfer, class Bytes>
bool transfer_all(Transfer transfer, int file, Bytes* bytes, std::size_t size, std::int64_t place) {
  while (size > 0) {
    const ssize_t done = transfer(file, bytes, size, place);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    size -= static_cast<std::size_t>(done);
    place += done;
  }
  return true;
}

}  // namespace

TemporaryFile::~TemporaryFile() {
  if (file_ >= 0) ::close(file_);
}

void TemporaryFile::fail(const char* what) const {
  const int error = errno;
  std::error_code ignored;
  throw WriteError(fmt::format("{} cannot be {} a temporary file in `{}`: {}; TMPDIR names another folder", contents_, what,
                               std::filesystem::temp_directory_path(ignored).string(), std::strerror(error)));
}

void TemporaryFile::write(const void* bytes, std::size_t size, std::int64_t place) {
  std::call_once(created_, [this] {
    std::error_code failed;
    std::string name = (std::filesystem::temp_directory_path(failed) / "rheonet-XXXXXX").string();
    file_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (file_ < 0) fail("written to");
    ::unlink(name.c_str());
  });
  if (!transfer_all(::pwrite, file_, static_cast<const char*>(bytes), size, place)) fail("written to");
}

std::int64_t TemporaryFile::append(const void* bytes, std::size_t size) {
  const std::int64_t place = end_.fetch_add(static_cast<std::int64_t>(size));
  write(bytes, size, place);
  return place;
}

void TemporaryFile::read(void* bytes, std::size_t size, std::int64_t place) const {
  if (!transfer_all(::pread, file_, static_cast<char*>(bytes), size, place)) fail("read from");
}

}  // namespace rheonet
