#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rheonet::serve {

/// The folder whose netlists are shown. Nothing outside it is read or written, by whatever name.
class Folder {
 public:
  /// Throws std::filesystem::filesystem_error if it is none.
  Folder(const std::filesystem::path& path, bool may_be_written);

  struct Entry {
    std::string file;   ///< relative to the folder: "teaching/creep.toml"
    std::string title;  ///< "" if it has none
    std::string about;  ///< its first words: the comment that it begins with
  };
  /// The netlists in it and below, those that can be simulated by themselves, by name; no more than a thousand.
  std::vector<Entry> scenes() const;

  /// The text of a netlist; absent if there is none of that name.
  std::optional<std::string> read(const std::string& file) const;
  /// Writes a netlist. What is wrong with that; "" if nothing.
  std::string write(const std::string& file, const std::string& text) const;
  bool may_be_written() const { return may_be_written_; }

  /// Where the includes of a netlist of this name are looked for.
  std::filesystem::path beside(const std::string& file) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  /// Where a netlist of this name is or would be; absent if that is not in the folder.
  std::optional<std::filesystem::path> locate(const std::string& file) const;

  std::filesystem::path path_;
  bool may_be_written_;
};

}  // namespace rheonet::serve
