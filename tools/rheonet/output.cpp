#include "tools/rheonet/output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {
namespace {

// Longest wait for a write in progress, or for the reader of a pipe, at the end of the process.
constexpr std::chrono::milliseconds wait_at_end{200};

/// The open outputs.
struct Open {
  std::mutex mutex;
  std::vector<Output*> outputs;
};

Open& all_open() {
  static Open open;
  return open;
}

}  // namespace

namespace {

bool is_regular(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

template <class... Args>
std::unique_ptr<Output> opened(const std::string& path, Args... args) {
  try {
    return std::make_unique<Output>(path, args...);
  } catch (const std::system_error& error) {
    say("error: cannot write to `{}`: {}\n", printable(path), error.code().message());
    return nullptr;
  }
}

}  // namespace

Output::Output(const std::string& path, Writing writing)
    : path_(path), name_(path == "-" ? "standard output" : "`" + printable(path) + "`"), writing_(writing) {
  if (path == "-") {
    descriptor_ = STDOUT_FILENO;
  } else {
    created_ = ::access(path.c_str(), F_OK) != 0;
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());
  }
  // A custom stream, because a standard one does not keep the error of a failed write.
  const cookie_io_functions_t functions{
      .read = nullptr,
      .write = [](void* self, const char* text,
                  std::size_t size) { return static_cast<Output*>(self)->write(text, size); },
      .seek = nullptr,
      .close = nullptr,
  };
  file_ = ::fopencookie(this, "w", functions);
  if (file_ == nullptr || std::setvbuf(file_, nullptr, _IOFBF, buffered) != 0) {
    throw std::system_error(errno, std::generic_category());
  }
  const std::scoped_lock lock(all_open().mutex);
  all_open().outputs.push_back(this);
}

Output::Output(const std::string& path, std::size_t bytes, long lines) : Output(path) {
  kept_ = bytes;
  lines_ = lines;
}

Output::Output(const std::string& path, std::unique_ptr<TableWriter> table) : Output(path, Writing::complete) { table_ = std::move(table); }

Output::~Output() {
  abandoned_ = true;  // An output that is complete has been closed before.
  close();
}

bool Output::is_terminal() const { return ::isatty(descriptor_) != 0; }

std::string Output::kept(const char* row) const {
  if (left_alone_) return created_ ? fmt::format("  no file {} was made\n", name_) : fmt::format("  {} is as it was before\n", name_);
  if (rows() == 0) return fmt::format("  no {} was written to {}\n", row, name_);
  if (rows() == 1) return fmt::format("  the one {} up to there is in {}\n", row, name_);
  return fmt::format("  the {} {}s up to there are in {}\n", rows(), row, name_);
}

int Output::begin() {
  if (path_ == "-" || !is_regular(descriptor_)) return table_ ? ESPIPE : 0;
  if (table_) {
    try {
      write_beside();
      table_->begin(fmt::format("/proc/self/fd/{}", descriptor_).c_str());
      return 0;
    } catch (const std::system_error& error) {
      return error.code().value();
    }
  }
  if (writing_ == Writing::complete) {
    try {
      write_beside();
      return 0;
    } catch (const std::system_error&) {
      // The file may be writable even if no file can be created in its folder.
    }
  }
  const auto end = static_cast<off_t>(kept_);
  return ::ftruncate(descriptor_, end) == 0 && ::lseek(descriptor_, end, SEEK_SET) == end ? 0 : errno;
}

void Output::write_beside() {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path file = fs::is_symlink(path_, failed) ? fs::canonical(path_) : fs::path(path_);
  folder_ = ::open(file.has_parent_path() ? file.parent_path().c_str() : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ < 0) throw std::system_error(errno, std::generic_category());
  replacement_.emplace(folder_, file.filename().string());
  ::close(descriptor_);
  descriptor_ = replacement_->descriptor();
}

std::size_t Output::put(const char* text, std::size_t size) {
  std::size_t written = 0;
  if (table_ && error_ == 0) {
    try {
      table_->take({text, size});
      written = size;
    } catch (const std::system_error& error) {
      error_ = error.code().value();
    }
  }
  while (!table_ && error_ == 0 && written < size) {
    if (finishing_ && is_stalled()) {
      error_ = EAGAIN;
      break;
    }
    const ssize_t n = ::write(descriptor_, text + written, finishing_ ? std::min<std::size_t>(size - written, PIPE_BUF) : size - written);
    if (n >= 0) {
      written += static_cast<std::size_t>(n);
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
  return written;
}

long Output::write(const char* text, std::size_t size) {
  if (error_ != 0) return 0;
  if (!touched_) {
    touched_ = true;
    error_ = begin();
  }
  const std::size_t written = put(text, size);
  begun_ += written;
  const std::string_view rows(text, written);
  for (std::size_t end = rows.find('\n'); end < written; end = rows.find('\n', end + 1)) {
    ++lines_;
    begun_ = written - end - 1;
  }
  if (error_ != 0) drop_begun_row();
  return static_cast<long>(written);
}

/// Whether the reader of a pipe is stalled, so that a write of PIPE_BUF bytes would block.
bool Output::is_stalled() const {
  pollfd item{descriptor_, POLLOUT, 0};
  return ::poll(&item, 1, static_cast<int>(wait_at_end.count())) <= 0;
}

bool Output::finish() {
  // A writing thread holds this lock, and may be blocked by the reader of a pipe forever. The lock is never released.
  const auto until = std::chrono::steady_clock::now() + wait_at_end;
  while (::ftrylockfile(file_) != 0) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  finishing_ = true;
  if (writing_ == Writing::complete && path_ != "-") {
    replacement_.reset();  // Removes the temporary file, which is incomplete.
    if (created_) ::unlink(path_.c_str());
    return false;
  }
  std::fflush(file_);
  if (created_ && !touched_) ::unlink(path_.c_str());
  return touched_;
}

std::string Output::finish_all() {
  Open& open = all_open();
  open.mutex.lock();  // Never released: no output is opened or closed any more.
  std::string kept;
  for (Output* output : open.outputs)
    if (output->finish()) kept += output->kept("row");
  return kept;
}

// An incomplete number could be read as a different number.
void Output::drop_begun_row() {
  struct stat status {};
  if (begun_ == 0 || ::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return;
  const off_t whole = ::lseek(descriptor_, 0, SEEK_CUR) - static_cast<off_t>(begun_);
  if (::ftruncate(descriptor_, whole) == 0) ::lseek(descriptor_, whole, SEEK_SET);
  begun_ = 0;
}

int Output::close() {
  if (file_ == nullptr) return error_;
  {
    const std::scoped_lock lock(all_open().mutex);
    std::erase(all_open().outputs, this);
  }
  std::fclose(file_);
  file_ = nullptr;
  if (path_ == "-") return error_;
  if (table_ && rows() == 0) abandoned_ = true;  // A table without rows is not worth an earlier one.
  if (table_ && touched_ && !abandoned_ && error_ == 0) {
    try {
      table_->close();
    } catch (const std::system_error& error) {
      error_ = error.code().value();
    }
  }
  table_.reset();
  if (replacement_) {
    if (error_ == 0 && !abandoned_) error_ = replacement_->commit();
    left_alone_ = error_ != 0 || abandoned_;
    replacement_.reset();
  } else {
    left_alone_ = writing_ == Writing::complete && !touched_;
    // Some file systems report a full disk only here.
    if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  }
  if (folder_ >= 0) ::close(folder_);
  if (created_ && (!touched_ || left_alone_)) ::unlink(path_.c_str());
  return error_;
}

void Output::abandon() {
  abandoned_ = !created_;
  close();
}

bool write_all(Output& output, const std::string& text, const char* row) {
  std::fwrite(text.data(), 1, text.size(), output.file());
  const int error = output.close();
  if (error != 0) say("error: cannot write to {}: {}\n{}", output.name(), std::strerror(error), output.kept(row));
  return error == 0;
}

std::unique_ptr<Output> open_output(const std::string& path, Output::Writing writing) { return opened(path, writing); }

std::unique_ptr<Output> open_table(const std::string& path, Output::Writing writing, tables::Layout layout) {
  const TableFormat* const format = table_format(path);
  if (!format) return open_output(path, writing);
  layout.program = "rheonet " RHEONET_VERSION;
  try {
    return std::make_unique<Output>(path, std::make_unique<TableWriter>(*format, std::move(layout)));
  } catch (const std::system_error& error) {
    say("error: cannot write to `{}`: {}\n", printable(path), error.code().message());
  } catch (const std::runtime_error& error) {
    say("error: cannot write to `{}`: {}\n", printable(path), error.what());
  }
  return nullptr;
}

std::unique_ptr<Output> open_output_after(const std::string& path, std::size_t bytes, long lines) {
  return opened(path, bytes, lines);
}

bool can_be_table(const std::string& path, const char* option, bool any_format) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const std::string ending = fs::path(path).extension().string();
  if (any_format && table_format(path)) return true;
  if (path == "-" || ending.empty() || ending == ".csv" || ending == ".txt" || ending == ".dat") return true;
  if (fs::exists(path, failed) && !fs::is_regular_file(path, failed)) return true;  // A folder gets its own error message.
  say("error: `{} {}`: rows are written as {}, and `{}` is another format\n"
      "  name the file .csv (or .txt, .dat, or without an ending){}\n", option, printable(path), any_format ? "CSV, NetCDF or MAT" : "CSV", printable(ending),
      any_format ? ", .nc or .mat" : "");
  if (any_format && ending == ".json") say("  JSON holds summaries: `run --summary FILE.json`, `sweep --statistics FILE.json`\n");
  return false;
}

bool write_to_one_file(const std::vector<std::pair<const char*, std::string>>& outputs) {
  namespace fs = std::filesystem;
  const auto place_of = [](const std::string& name) { return name == "-" ? std::string("/dev/stdout") : name; };
  const auto same = [&](const std::string& one, const std::string& other) {
    std::error_code failed;
    return (one == "-" && other == "-") || (fs::equivalent(place_of(one), place_of(other), failed) && fs::is_regular_file(place_of(one), failed));
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto& [first, path] = outputs[k];
      const auto& [second, other] = outputs[i];
      if (!same(path, other)) continue;
      say("error: `{}` and `{}` both write to {}; give one of them another file\n", first, second,
          path == "-" || other == "-" ? "standard output" : "`" + printable(path) + "`");
      return true;
    }
  }
  return false;
}

bool can_be_json(const std::string& path, const char* option) {
  if (path.empty() || path == "-" || path.ends_with(".json")) return true;
  say("error: `{} {}` is not a .json\n", option, printable(path));
  return false;
}

}  // namespace rheonet::tool
