#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tools/serve/below.hpp"
#include "tools/serve/lesson.hpp"

namespace rheonet::serve {

/// The folder whose netlists are shown. Nothing outside it is read or written, by whatever name and whatever is exchanged for a
/// symbolic link meanwhile: it stays open, and names are looked up in it. Threads may share it.
class Folder {
 public:
  /// Throws std::filesystem::filesystem_error if it is none.
  Folder(const std::filesystem::path& path, bool may_be_written);

  struct Entry {
    std::string file;   ///< relative to the folder: "teaching/creep.toml"
    std::string title;  ///< "" if it has none
    std::string about;  ///< its first words
    std::optional<std::size_t> place = {};  ///< where README.md beside it first names it, from its beginning; if it does
    std::optional<LessonGlance> lesson = {};  ///< if it has one
  };
  struct Listing {
    std::vector<Entry> scenes;  ///< by name
    std::size_t left_out = 0;   ///< .toml files that nobody has looked at, because there are so many
    bool all_visited = true;    ///< false: there may be more than these
  };
  /// The netlists in it and below, those that can be simulated by themselves; no more than a thousand.
  Listing scenes() const;

  struct Netlist {
    std::string text;
    std::string version;  ///< tells this text from another one that the file may have had
  };
  /// A netlist; absent if there is none of that name.
  std::optional<Netlist> read(const std::string& file) const;

  struct Written {
    enum class Outcome { done, no_name, not_here, other_there, failed };
    Outcome outcome = Outcome::done;
    std::string why;      ///< in words, unless it is done
    std::string version;  ///< of the text that is there now, written or not; "" if there is none
  };
  /// Writes a netlist, over one of that name only if its version is `version`: what nobody has seen is not lost.
  Written write(const std::string& file, const std::string& text, const std::string& version);
  bool may_be_written() const { return may_be_written_; }

  const std::filesystem::path& path() const { return path_; }
  /// It, open.
  int descriptor() const { return root_.get(); }

 private:
  std::filesystem::path path_;
  Descriptor root_;
  bool may_be_written_;
  std::mutex writing_;
};

}  // namespace rheonet::serve
