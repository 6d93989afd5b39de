#include "tools/rheonet/sweep_resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "core/netlist/csv_fields.hpp"

namespace rheonet::tool {

bool is_of_failed_run(std::string_view row) { return !row.ends_with(",\n"); }

bool is_row(std::string_view line, std::string_view key, std::size_t columns) {
  if (!line.starts_with(key)) return false;
  const std::vector<CsvField> cells = csv_fields(line);
  if (cells.size() != columns) return false;
  const auto is_value = [](const CsvField& cell) {
    const std::optional<double> value = csv_number(cell);
    return cell.text.empty() || (value && std::isfinite(*value));
  };
  return std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(csv_fields(key).size()) - 1, cells.end() - 1, is_value);
}

std::optional<long> first_difference(const std::string& file, std::size_t begin, std::size_t size, Spool& text) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(begin));
  long line = 0;
  std::string found;
  const bool same = text.take([&](const std::string& lines) {
    found.resize(std::min(size, lines.size()));
    in.read(found.data(), static_cast<std::streamsize>(found.size()));
    size -= found.size();
    const auto differ = std::mismatch(found.begin(), found.end(), lines.begin());
    line += std::count(found.begin(), differ.first, '\n');
    return in.good() && differ.first == found.end();
  });
  if (same && size == 0) return {};
  return line;
}

std::variant<Left, NoVariation> what_is_left(const std::string& file, const Expected& expected) {
  Left left;
  left.runs = expected.first;
  if (!std::filesystem::exists(file)) return left;  // The sweep ended before its first row.
  if (!std::filesystem::is_regular_file(file)) return NoVariation{fmt::format("`--resume` goes on in a file, and `{}` is none", file), ""};
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    return NoVariation{fmt::format("`--resume`: `{}` cannot be read: {}", file, std::strerror(errno)), ""};
  }
  const std::string hint = "without `--resume` it is written anew";
  const auto other = [&](long line, const std::string& what) {
    return NoVariation{fmt::format("`--resume`: `{}` is not of this sweep: {}:{} {}", file, file, line, what), hint};
  };
  const auto next = [&in](std::string& line) {
    if (!std::getline(in, line)) return false;
    if (!in.eof()) line += '\n';
    return true;
  };
  std::string line;
  std::size_t bytes = 0;
  long lines = 0;
  for (const auto& [text, what] : {std::pair{expected.remark, "is of another shard, scene or command"}, {expected.header, "names other columns"}}) {
    if (text.empty()) continue;
    if (!next(line)) return left;
    if (!text.starts_with(line)) return other(lines + 1, what);
    if (line != text) return left;
    bytes += line.size();
    ++lines;
  }
  left.bytes = left.head = bytes;
  left.lines = lines;
  long run = expected.first, count = 0;  // The number of the run whose rows are read, and the number of these rows.
  bool failed = false;                   // Whether the last of these rows says that the run failed.
  std::string begin = run < expected.behind ? expected.key(run) : "";
  const std::size_t columns = csv_fields(expected.header).size();
  while (next(line)) {
    if (!expected.end.empty() && expected.end.starts_with(line)) break;
    // A line that is cut off within its key may belong to this run or to the next.
    if (count > 0 && line.back() != '\n' && begin.starts_with(line)) break;
    const long number = left.lines + count + 1;
    if (!line.starts_with(begin) && !begin.starts_with(line)) {
      if (count == 0 || ++run >= expected.behind) return other(number, fmt::format("does not begin with `{}`", begin));
      left.runs = run;
      left.bytes += left.last;
      if (failed) ++left.failed;
      left.lines += count;
      left.last = 0;
      count = 0;
      begin = expected.key(run);
      if (!line.starts_with(begin) && !begin.starts_with(line))
        return other(number, fmt::format("does not begin with `{}`", begin));
    }
    if (line.back() == '\n' && !is_row(std::string_view(line).substr(0, line.size() - 1), begin, columns))
      return other(number, "is damaged");
    left.last += line.size();
    failed = is_of_failed_run(line);
    ++count;
  }
  return left;
}

}  // namespace rheonet::tool
