#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/netlist/file_offer.hpp"

namespace rheonet::serve {

/// Owner of an open file descriptor.
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

// Access to files below an open folder by relative names such as "teaching/creep.toml". Each part of a name is opened relative to the folder
// before it, and symbolic links are not followed. So nothing outside the folder can be reached, even if entries are replaced meanwhile.

/// The folder of `file`. If it cannot be opened, the result is not open and `why` has the reason, "" if the folder does not exist.
Descriptor open_parent(int root, const std::filesystem::path& file, std::string& why);

/// The text of a regular file of at most `most` bytes. If it cannot be read, the result is absent and `why` has the reason, "" if the file
/// does not exist.
std::optional<std::string> text_below(int root, const std::filesystem::path& file, std::size_t most, std::string& why);

/// Whether a part of a path begins with a dot.
bool is_hidden(const std::filesystem::path& path);

/// The files that netlists may include or read as tables, and lessons: the .toml, .csv and .lesson files of a folder that are not hidden.
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
