#pragma once

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/result/cpu_time.hpp"

namespace rheonet::bench {

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Result of a task in a separate process.
struct Outcome {
  std::vector<double> values;  ///< Values that the task returned; empty if it did not end in time.
  double megabytes = 0;        ///< Peak memory of the process [MB].
};

/// Runs a task in a separate process, so that its memory can be measured, and kills it after `seconds`.
inline Outcome alone(unsigned seconds, const std::function<std::vector<double>()>& task) {
  int ends[2];
  if (::pipe(ends) != 0) return {};
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    ::alarm(seconds);
    std::vector<double> values;
    try {
      values = task();
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
    }
    const std::size_t size = values.size() * sizeof(double);
    const bool written = ::write(ends[1], values.data(), size) == static_cast<ssize_t>(size);
    ::_exit(written ? 0 : 1);
  }
  ::close(ends[1]);
  Outcome outcome;
  double value = 0;
  while (::read(ends[0], &value, sizeof value) == static_cast<ssize_t>(sizeof value)) outcome.values.push_back(value);
  ::close(ends[0]);
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  outcome.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  return outcome;
}

/// A file for tables. Throws std::runtime_error if it cannot be written.
inline std::FILE* open_table(const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) throw std::runtime_error(fmt::format("`{}` cannot be written", path));
  return file;
}

/// A table, in Markdown on standard output and as CSV in a file if there is one.
class Table {
 public:
  Table(std::FILE* csv, const std::string& name, const std::vector<std::string>& columns) : csv_(csv) {
    fmt::print("\n## {}\n\n", name);
    if (csv_) fmt::print(csv_, "# {}\n", name);
    row(columns);
    std::string rule = "|";
    for (std::size_t k = 0; k < columns.size(); ++k) rule += "---|";
    fmt::print("{}\n", rule);
  }
  void row(const std::vector<std::string>& cells) {
    fmt::print("| {} |\n", fmt::join(cells, " | "));
    if (csv_) fmt::print(csv_, "{}\n", fmt::join(cells, ","));
    std::fflush(stdout);
    if (csv_) std::fflush(csv_);
  }

 private:
  std::FILE* csv_;
};

/// The exponent p of y = c x^p that fits best.
inline double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(y[k] > 0)) continue;
    const double a = std::log(x[k]), b = std::log(y[k]);
    ++n;
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

inline std::string milliseconds(double seconds) { return fmt::format("{:#.3g}", 1e3 * seconds); }

}  // namespace rheonet::bench
