#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/result/temporary_file.hpp"
#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// The points of a sweep that the file of `--list` names. Its lines are kept in a temporary file, as they are when it is read: memory does not grow
/// with their number.
class PointList {
 public:
  /// Opens a file as text, a MAT file as CSV. Returns nullptr, and says why, if it cannot be read.
  static std::unique_ptr<std::istream> open(const std::string& file, std::string& why);

  /// Returns a NoVariation if the file cannot be read, or a line is wrong. Throws WriteError, as the methods do.
  static std::variant<std::shared_ptr<const PointList>, NoVariation> read(const std::string& file);

  const std::vector<std::string>& paths() const { return paths_; }
  long rows() const { return rows_; }
  /// The values of a row, counted from 0, as `--set` takes them. May be called on any thread.
  std::vector<std::string> row(long number) const;
  /// Whether `holds` is true for the values of all rows. It stops at the first value for which it is not.
  bool all_of(const std::function<bool(const std::vector<std::string>& values)>& holds) const;

 private:
  /// Consecutive lines in the file.
  struct Block {
    long first = 0;  ///< Number of the first row.
    std::int64_t place = 0;
    std::size_t size = 0;
  };
  void add(const std::string& line);
  std::vector<std::string> values(const std::string& line) const;
  std::string lines(std::size_t block) const;

  std::vector<std::string> paths_, units_;
  long rows_ = 0;
  TemporaryFile file_{"the points of `--list`"};
  std::vector<Block> blocks_;
  long first_of_rest_ = 0;  ///< Number of the first row in `rest_`.
  std::string rest_;  ///< The lines after the blocks.
};

}  // namespace rheonet::tool
