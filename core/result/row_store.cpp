#include "core/result/row_store.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "core/result/csv.hpp"

namespace rheonet {
namespace {

constexpr std::size_t memory = 64 << 20;  // bytes for the rows of all runs
constexpr std::size_t smallest_block = 4 << 10, largest_block = 256 << 10;  // bytes: a write of less costs more than its rows

[[noreturn]] void fail(const char* what) {
  const int error = errno;
  std::error_code ignored;
  throw WriteError(fmt::format("the rows of independent parts cannot be {} a temporary file in `{}`: {}; TMPDIR names another folder", what,
                               std::filesystem::temp_directory_path(ignored).string(), std::strerror(error)));
}

/// A file without a name, which the system removes when it is closed.
int temporary_file() {
  std::error_code failed;
  std::string name = (std::filesystem::temp_directory_path(failed) / "rheonet-rows-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) fail("written to");
  ::unlink(name.c_str());
  return file;
}

/// Calls ::pwrite or ::pread until all of a block is done. Returns false after an error.
template <class Transfer, class Bytes>
bool transfer_all(Transfer transfer, int file, Bytes* bytes, std::size_t size, std::int64_t offset) {
  while (size > 0) {
    const ssize_t done = transfer(file, bytes, size, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    size -= static_cast<std::size_t>(done);
    offset += done;
  }
  return true;
}

}  // namespace

RowStore::RowStore(const std::vector<std::size_t>& widths)
    : bytes_(std::clamp(memory / std::max<std::size_t>(widths.size(), 1), smallest_block, largest_block)) {
  for (const std::size_t width : widths) runs_.push_back({.width = width + 1});
}

RowStore::~RowStore() {
  if (file_ >= 0) ::close(file_);
}

std::size_t RowStore::rows_of_block(const Run& run) const { return std::max<std::size_t>(bytes_ / sizeof(double) / run.width, 1); }

void RowStore::add(std::size_t number, double time, const std::vector<double>& values) {
  Run& run = runs_[number];
  if (run.block.size() == size_of_block(run)) write(run);
  run.block.push_back(time);
  run.block.insert(run.block.end(), values.begin(), values.end());
  ++run.rows;
}

void RowStore::write(Run& run) {
  const std::size_t size = run.block.size() * sizeof(double);
  std::int64_t offset = 0;
  {
    const std::lock_guard lock(mutex_);
    if (file_ < 0) file_ = temporary_file();
    offset = std::exchange(end_, end_ + static_cast<std::int64_t>(size));
  }
  if (!transfer_all(::pwrite, file_, reinterpret_cast<const char*>(run.block.data()), size, offset)) fail("written to");
  run.blocks.push_back(offset);
  run.block.clear();
}

const double* RowStore::next(std::size_t number) {
  Run& run = runs_[number];
  if (run.begun == 0 || run.place == run.block.size()) read(run);
  return run.block.data() + std::exchange(run.place, run.place + run.width);
}

void RowStore::read(Run& run) {
  if (run.begun == 0) run.last = std::move(run.block);
  run.place = 0;
  if (run.begun < run.blocks.size()) {
    run.block.resize(size_of_block(run));
    if (!transfer_all(::pread, file_, reinterpret_cast<char*>(run.block.data()), run.block.size() * sizeof(double), run.blocks[run.begun])) fail("read from");
  } else {
    run.block = std::move(run.last);
  }
  ++run.begun;
}

}  // namespace rheonet
