#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/netlist/file_offer.hpp"

namespace rheonet::serve {

/// An open file or folder; closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

// Files by their names below a folder that is open, "teaching/creep.toml". Each part of a name is opened in the folder before
// it, and none is followed that is a symbolic link: whatever others exchange meanwhile, nothing outside is reached.

/// The folder that `file` is in. Not open if there is none: `why` then says why, and is "" if there is no such folder.
Descriptor open_parent(int root, const std::filesystem::path& file, std::string& why);

/// The text of a regular file of at most `most` bytes. Absent if it is none: `why` then says why, and is "" if there is no such
/// file.
std::optional<std::string> text_below(int root, const std::filesystem::path& file, std::size_t most, std::string& why);

/// Whether a part of a path begins with a dot.
bool is_hidden(const std::filesystem::path& path);

/// The files that netlists may include, or read as tables, and their lessons: the .toml, .csv and .lesson files of a folder that are not
/// hidden.
class OfferedFolder final : public FileOffer {
 public:
  /// Throws std::system_error if it cannot be opened.
  explicit OfferedFolder(const std::filesystem::path& folder);
  explicit OfferedFolder(Descriptor folder) : folder_(std::move(folder)) {}

  std::optional<std::string> text_of(const std::filesystem::path& path, std::string& why) const override;

 private:
  Descriptor folder_;
};

}  // namespace rheonet::serve
