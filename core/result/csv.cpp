#include "core/result/csv.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>

namespace rheonet {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void CsvWriter::header(const std::vector<std::string>& names) {
  if (!file_) return;
  fmt::format_to(std::back_inserter(buffer_), "time");
  for (const std::string& name : names) fmt::format_to(std::back_inserter(buffer_), ",{}", name);
  buffer_.push_back('\n');
  last_flush_ = now();
}

void CsvWriter::row(double time, const std::vector<double>& values) {
  if (!file_) return;
  begin_row(time);
  for (double v : values) fmt::format_to(std::back_inserter(buffer_), ",{}", v + 0.0);
  end_row();
}

void CsvWriter::text_row(double time, const std::vector<std::string>& cells) {
  if (!file_) return;
  begin_row(time);
  for (const std::string& cell : cells) fmt::format_to(std::back_inserter(buffer_), ",{}", cell);
  end_row();
}

void CsvWriter::begin_row(double time) {
  // Adding 0 turns -0 into 0. `{}` gives the fewest digits that read back as the same double.
  fmt::format_to(std::back_inserter(buffer_), "{}", time + 0.0);
}

void CsvWriter::end_row() {
  buffer_.push_back('\n');
  constexpr std::size_t full = 1 << 16;  // bytes
  constexpr double patience = 0.25;      // s
  if (buffer_.size() >= full || now() - last_flush_ > patience) flush();
}

void CsvWriter::flush() {
  last_flush_ = now();
  if (!file_ || buffer_.size() == 0) return;
  const bool written = std::fwrite(buffer_.data(), 1, buffer_.size(), file_) == buffer_.size() && std::fflush(file_) == 0;
  buffer_.clear();
  if (!written) {
    const int reason = errno;
    file_ = nullptr;  // what follows would only fail again
    throw WriteError(fmt::format("{} cannot be written: {}", what_, std::strerror(reason)));
  }
}

}  // namespace rheonet
