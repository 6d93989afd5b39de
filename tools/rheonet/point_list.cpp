#include "tools/rheonet/point_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/netlist/characters.hpp"
#include "core/netlist/csv_fields.hpp"
#include "core/netlist/file_cache.hpp"

namespace rheonet::tool {
namespace {

constexpr std::size_t block_size = 1 << 13;  // Bytes: a row is found in a few microseconds, and a million rows have some thousand blocks.

/// A number without a unit gets the unit of the heading.
std::string with_unit(std::string_view cell, std::string_view unit) {
  return unit.empty() || !csv_number(cell) ? std::string(cell) : fmt::format("{} {}", cell, unit);
}

}  // namespace

std::unique_ptr<std::istream> PointList::open(const std::string& file, std::string& why) {
  std::error_code ignored;
  if (file.ends_with(".mat") || std::filesystem::is_directory(file, ignored)) {
    auto text = rheonet::read_text(file, why);
    return text ? std::make_unique<std::istringstream>(std::move(*text)) : nullptr;
  }
  errno = 0;
  auto stream = std::make_unique<std::ifstream>(file, std::ios::binary);
  if (*stream) return stream;
  why = errno != 0 ? std::strerror(errno) : "it cannot be opened";
  return nullptr;
}

std::variant<std::shared_ptr<const PointList>, NoVariation> PointList::read(const std::string& file) {
  const auto list = std::make_shared<PointList>();
  std::string why, line;
  const std::unique_ptr<std::istream> in = open(file, why);
  if (!in) return NoVariation{fmt::format("`--list {}` cannot be read: {}", file, why), ""};
  for (int number = 1; std::getline(*in, line); ++number) {
    if (number == 1) drop_byte_order_mark(line);
    if (number == 1 && is_netcdf(line))
      return NoVariation{fmt::format("`--list {}` is a NetCDF or HDF5 file, but lists are read from CSV and MAT files", file), netcdf_hint};
    if (is_csv_remark(line)) continue;
    const std::vector<CsvField> fields = csv_fields(line);
    if (list->paths_.empty()) {
      for (const CsvField& field : fields) {
        const CsvHeading heading = csv_heading(field.text);
        list->paths_.emplace_back(heading.name);
        list->units_.emplace_back(heading.unit);
        if (heading.name.empty() || csv_number(field))
          return NoVariation{fmt::format("{}:{}:{}: expected the path of a value, found `{}`", file, number, field.column,
                                         field.text),
                             "the first row names what takes the values below it: k1.stiffness [N/m],c1.damping"};
      }
      continue;
    }
    if (fields.size() != list->paths_.size())
      return NoVariation{fmt::format("{}:{}: {} values, but the first row names {}", file, number, fields.size(), list->paths_.size()), ""};
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (fields[k].text.empty())
        return NoVariation{fmt::format("{}:{}:{}: `{}` has no value", file, number, fields[k].column, list->paths_[k]), ""};
    list->add(line);
  }
  if (in->bad()) return NoVariation{fmt::format("`--list {}` cannot be read: {}", file, std::strerror(errno)), ""};
  if (list->rows_ == 0) return NoVariation{fmt::format("`{}` has no row of values", file), "k1.stiffness [N/m],c1.damping, and below it 100,5"};
  return list;
}

void PointList::add(const std::string& line) {
  if (rest_.size() > block_size) {
    blocks_.push_back({first_of_rest_, file_.append(rest_.data(), rest_.size()), rest_.size()});
    rest_.clear();
    first_of_rest_ = rows_;
  }
  rest_ += line + '\n';
  ++rows_;
}

std::vector<std::string> PointList::values(const std::string& line) const {
  const std::vector<CsvField> fields = csv_fields(line);
  std::vector<std::string> values;
  for (std::size_t k = 0; k < fields.size(); ++k) values.push_back(with_unit(csv_text(fields[k]), units_[k]));
  return values;
}

std::string PointList::lines(std::size_t block) const {
  if (block == blocks_.size()) return rest_;
  std::string text(blocks_[block].size, '\0');
  file_.read(text.data(), text.size(), blocks_[block].place);
  return text;
}

std::vector<std::string> PointList::row(long number) const {
  const auto after = std::partition_point(blocks_.begin(), blocks_.end(), [number](const Block& block) { return block.first <= number; });
  const bool in_rest = number >= first_of_rest_;
  const std::size_t block = in_rest ? blocks_.size() : static_cast<std::size_t>(after - blocks_.begin()) - 1;
  const std::string text = lines(block);
  std::size_t begin = 0;
  for (long row = in_rest ? first_of_rest_ : blocks_[block].first; row < number; ++row) begin = text.find('\n', begin) + 1;
  return values(text.substr(begin, text.find('\n', begin) - begin));
}

bool PointList::all_of(const std::function<bool(const std::vector<std::string>& values)>& holds) const {
  for (std::size_t block = 0; block <= blocks_.size(); ++block) {
    const std::string text = lines(block);
    for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
      if (!holds(values(text.substr(begin, end - begin)))) return false;
  }
  return true;
}

}  // namespace rheonet::tool
