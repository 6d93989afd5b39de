#include "tools/rheonet/sweep_resume.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace rheonet::tool {

std::variant<Left, NoVariation> what_is_left(const std::string& file, const std::string& header, long runs,
                                             const std::function<std::string(long run)>& key) {
  Left left;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    if (!std::filesystem::exists(file)) return left;  // it was ended before it had any
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
  if (!next(line)) return left;
  if (!header.starts_with(line)) return other(1, "names other columns");
  if (line != header) return left;
  left.bytes = line.size();
  left.lines = 1;
  long run = 0, count = 0;  // of the run whose rows are read: its number, and how many
  std::string begin = runs > 0 ? key(0) : "";
  while (next(line)) {
    // What is cut short before its values could be a row of this run or of the next.
    if (count > 0 && line.back() != '\n' && begin.starts_with(line)) break;
    const long number = left.lines + count + 1;
    if (!line.starts_with(begin) && !begin.starts_with(line)) {
      if (count == 0 || ++run >= runs) return other(number, fmt::format("does not begin with `{}`", begin));
      left.runs = run;
      left.bytes += left.last.size();
      left.lines += count;
      left.last.clear();
      count = 0;
      begin = key(run);
      if (!line.starts_with(begin) && !begin.starts_with(line))
        return other(number, fmt::format("does not begin with `{}`", begin));
    }
    left.last += line;
    ++count;
  }
  return left;
}

}  // namespace rheonet::tool
