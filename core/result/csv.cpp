#include "core/result/csv.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>

#include "core/network/error.hpp"

namespace rheonet {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void CsvWriter::header(const std::vector<std::string>& names) {
  fmt::format_to(std::back_inserter(buffer_), "time");
  for (const std::string& name : names) fmt::format_to(std::back_inserter(buffer_), ",{}", name);
  buffer_.push_back('\n');
  last_flush_ = now();
}

void CsvWriter::row(double time, const std::vector<double>& values) {
  // Adding 0 turns -0 into 0. `{}` gives the fewest digits that read back as the same double.
  fmt::format_to(std::back_inserter(buffer_), "{}", time + 0.0);
  for (double v : values) fmt::format_to(std::back_inserter(buffer_), ",{}", v + 0.0);
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
    throw SimulationError(fmt::format("the results cannot be written: {}", std::strerror(reason)));
  }
}

}  // namespace rheonet
