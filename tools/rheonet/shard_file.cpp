#include "tools/rheonet/shard_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

#include "core/netlist/csv_fields.hpp"
#include "tools/rheonet/point_list.hpp"
#include "tools/rheonet/sweep_resume.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

/// CRC-64 of ECMA-182, as in xz, of null-terminated texts.
class CheckSum {
 public:
  void add(std::istream& text) {
    std::string piece(1 << 16, '\0');
    while (text.read(piece.data(), static_cast<std::streamsize>(piece.size())), text.gcount() > 0) sum_.process_bytes(piece.data(), static_cast<std::size_t>(text.gcount()));
    sum_.process_byte(0);
  }
  void add(const std::string& text) { sum_.process_bytes(text.c_str(), text.size() + 1); }
  std::string text() const { return fmt::format("{:016x}", sum_.checksum()); }

 private:
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693U, 0xFFFFFFFFFFFFFFFFU, 0xFFFFFFFFFFFFFFFFU, true, true> sum_;
};

struct Part {
  Shard shard;
  std::string file;
};

NoVariation no_shard(const std::string& file, const std::string& what, const std::string& hint = "") {
  return {fmt::format("`--merge`: `{}` {}", file, what), hint};
}

/// The shard that a first line names; the rest of the line is not checked.
std::optional<Shard> shard_of(const std::string& line) {
  const std::size_t begin = line.find(" shard ");
  if (!line.starts_with("# rheonet ") || begin == line.npos) return {};
  const std::string word = split(line.substr(begin + 7), ' ').front();
  try {
    return read_shard(word);
  } catch (const WrongCommandLine&) {
    return {};
  }
}

std::variant<Part, NoVariation> identify(const std::string& file, long runs, const SweepIdentity& identity) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!in || !std::getline(in, line)) return no_shard(file, in.eof() ? "is empty" : fmt::format("cannot be read: {}", std::strerror(errno)));
  const auto shard = shard_of(line);
  if (!shard) return no_shard(file, "is not the file of a shard", "sweep ... --shard 1/4 -o part-1.csv writes one");
  const std::string expected = first_line(*shard, runs, identity);
  if (line + '\n' == expected) return Part{*shard, file};
  const auto word_after = [](const std::string& text, const char* name) {
    const std::size_t begin = text.find(name);
    return begin == text.npos ? "" : text.substr(begin, text.find_first_of(",\n", begin) - begin);
  };
  if (word_after(line, "scene ") != word_after(expected, "scene "))
    return no_shard(file, "is a shard of another scene, or the scene has changed since", "simulate all shards with one version of the scene");
  return no_shard(file, "is a shard of another sweep of this scene, or of another version of rheonet",
                  "give `--merge` the same scene and options as `--shard`");
}

/// All shards, in order.
std::variant<std::vector<Part>, NoVariation> all_parts(const std::vector<std::string>& files, long runs, const SweepIdentity& identity) {
  std::map<long, std::string> by_number;
  std::optional<Part> first;
  for (const std::string& file : files) {
    auto identified = identify(file, runs, identity);
    if (auto* wrong = std::get_if<NoVariation>(&identified)) return std::move(*wrong);
    const Part& part = std::get<Part>(identified);
    if (!first) first = part;
    if (part.shard.of != first->shard.of)
      return no_shard(file, fmt::format("is one of {} shards, but `{}` is one of {}", part.shard.of, first->file, first->shard.of));
    const auto [same, added] = by_number.emplace(part.shard.number, file);
    if (!added) return no_shard(file, fmt::format("is shard {}, as `{}` is", part.shard.number, same->second), "name each shard once");
  }
  std::vector<std::string> missing;
  std::vector<Part> parts;
  for (long number = 1; number <= first->shard.of; ++number) {
    const auto found = by_number.find(number);
    if (found == by_number.end())
      missing.push_back(std::to_string(number));
    else
      parts.push_back({{number, first->shard.of}, found->second});
  }
  if (missing.empty()) return parts;
  constexpr std::size_t most_named = 10;
  const std::vector<std::string> named(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(std::min(missing.size(), most_named)));
  return NoVariation{fmt::format("`--merge`: of {} shards {} missing: {}{}", first->shard.of,
                                 missing.size() == 1 ? "one is" : fmt::format("{} are", missing.size()), fmt::join(named, ", "),
                                 missing.size() > most_named ? ", ..." : ""),
                     fmt::format("simulate them with `--shard {}/{}`, then merge all", missing.front(), first->shard.of)};
}

/// Reads the rows of a shard and passes them to `take` in pieces. Returns false if `take` does.
std::variant<bool, NoVariation> read_rows(const Part& part, long runs, const std::string& header, const std::function<std::string(long)>& key,
                                          const std::function<bool(const std::string&)>& take) {
  constexpr std::size_t piece = 1 << 16;
  std::ifstream in(part.file, std::ios::binary);
  std::string line, lines;
  std::getline(in, line);
  std::getline(in, line);
  if (line + '\n' != header) return no_shard(part.file, "has other columns than this sweep");
  const std::string end = last_line(part.shard);
  long run = part.shard.first(runs);  // The next run.
  const std::size_t columns = csv_fields(line).size();
  std::string begin;                  // The cells that the rows of the run before it begin with.
  const long behind = part.shard.end(runs);
  for (long number = 3; std::getline(in, line); ++number) {
    line += '\n';
    if (line == end) {
      if (run < behind) break;
      return lines.empty() || take(lines);
    }
    long found = 0;
    const auto read = std::from_chars(line.data(), line.data() + line.size(), found);
    const bool is_of_run = read.ec == std::errc() && *read.ptr == ',';
    // Rows are in the order of the runs: each belongs to the same run as the row before it, or to the next run.
    const bool in_order = is_of_run && (found == run || found == run + 1) && found <= behind && (found > run || run > part.shard.first(runs));
    if (in_order && found > run) begin = key(run);
    if (!in_order || !is_row(std::string_view(line).substr(0, line.size() - 1), begin, columns))
      return no_shard(part.file, fmt::format("is damaged: line {} is not a row of run {}", number, run + 1));
    run = found;
    lines += line;
    if (lines.size() < piece) continue;
    if (!take(lines)) return false;
    lines.clear();
  }
  return no_shard(part.file, fmt::format("is not complete: it ends in run {} of the runs {} to {}", std::max(run, part.shard.first(runs) + 1), part.shard.first(runs) + 1, behind),
                  "with `--resume` its sweep goes on there");
}

}  // namespace

SweepIdentity::SweepIdentity(const Arguments& arguments, const Sources& sources) {
  CheckSum of_scene, of_command;
  for (const Sources::File& file : sources.files) of_scene.add(file.text);
  scene = of_scene.text();
  const SweepArguments& sweep = arguments.sweep;
  for (const auto& texts : {arguments.overrides, arguments.without, arguments.only.value_or(std::vector<std::string>{"all"}), arguments.keep, sweep.vary,
                            sweep.correlate, sweep.measures}) {
    for (const std::string& text : texts) of_command.add(text);
    of_command.add("");
  }
  std::string why;
  const std::unique_ptr<std::istream> list = sweep.list.empty() ? nullptr : PointList::open(sweep.list, why);
  if (list)
    of_command.add(*list);
  else
    of_command.add("");
  of_command.add(fmt::format("{} {} {} {} {} {}", sweep.random, sweep.latin, sweep.sobol, sweep.seed.value_or(1), sweep.indices,
                             arguments.accuracy.value_or(0)));
  command = of_command.text();
}

std::string first_line(const Shard& shard, long runs, const SweepIdentity& identity) {
  return fmt::format("# rheonet " RHEONET_VERSION " shard {}/{} of {} runs, scene {}, command {}\n", shard.number, shard.of, runs, identity.scene, identity.command);
}

std::string last_line(const Shard& shard) { return fmt::format("# end of shard {}/{}\n", shard.number, shard.of); }

std::variant<bool, NoVariation> merge_shards(const std::vector<std::string>& files, long runs, const SweepIdentity& identity,
                                             const std::string& header, const std::function<std::string(long run)>& key,
                                             const std::function<bool(const std::string& lines)>& take) {
  auto found = all_parts(files, runs, identity);
  if (auto* wrong = std::get_if<NoVariation>(&found)) return std::move(*wrong);
  const auto& parts = std::get<std::vector<Part>>(found);
  const auto read_all = [&](const std::function<bool(const std::string&)>& to) -> std::variant<bool, NoVariation> {
    for (const Part& part : parts) {
      auto read = read_rows(part, runs, header, key, to);
      const bool* went_on = std::get_if<bool>(&read);
      if (!went_on || !*went_on) return read;
    }
    return true;
  };
  // All files are checked before anything is written.
  auto looked = read_all([](const std::string&) { return true; });
  if (std::holds_alternative<NoVariation>(looked)) return looked;
  if (!take(header)) return false;
  return read_all(take);
}

}  // namespace rheonet::tool
