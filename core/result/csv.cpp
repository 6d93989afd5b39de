#include "core/result/csv.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <new>

#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void CsvWriter::header(const std::vector<std::string>& names) {
  if (!file_) return;
  fmt::format_to(std::back_inserter(row_), "time");
  for (const std::string& name : names) fmt::format_to(std::back_inserter(row_), ",{}", name);
  put_row();
  last_flush_ = now();
}

void CsvWriter::row(double time, const std::vector<double>& values) {
  if (!file_) return;
  begin_row(time);
  for (double v : values) fmt::format_to(std::back_inserter(row_), ",{}", v + 0.0);
  end_row();
}

void CsvWriter::text_row(double time, const std::vector<std::string>& cells) {
  if (!file_) return;
  begin_row(time);
  for (const std::string& cell : cells) fmt::format_to(std::back_inserter(row_), ",{}", cell);
  end_row();
}

void CsvWriter::begin_row(double time) {
  // Adding 0 turns -0 into 0. `{}` gives the fewest digits that read back as the same double.
  fmt::format_to(std::back_inserter(row_), "{}", time + 0.0);
}

void CsvWriter::end_row() {
  constexpr std::size_t full = 1 << 16;  // bytes
  put_row();
  if (waiting_ >= full || now() - last_flush_ > numerics::flush_time) flush();
}

void CsvWriter::put_row() {
  row_.push_back('\n');
  waiting_ += row_.size();
  const bool put = std::fwrite(row_.data(), 1, row_.size(), file_) == row_.size();
  row_.clear();
  if (!put) fail();
}

void CsvWriter::flush() {
  last_flush_ = now();
  if (!file_ || waiting_ == 0) return;
  waiting_ = 0;
  if (std::fflush(file_) != 0) fail();
}

void CsvWriter::fail() {
  const int reason = errno;
  file_ = nullptr;  // every later write would fail too
  if (reason == ENOMEM) throw std::bad_alloc();  // a file in memory: see MemoryFile
  throw WriteError(fmt::format("{} cannot be written: {}", what_, std::strerror(reason)));
}

}  // namespace rheonet
