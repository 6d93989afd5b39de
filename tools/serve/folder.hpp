#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tools/serve/below.hpp"
#include "tools/serve/lesson.hpp"

namespace rheonet::serve {

/// The folder whose netlists are shown. Nothing outside it is read or written: it stays open, and names are looked up in it without
/// following symbolic links. Threads may share it.
class Folder {
 public:
  /// Throws std::filesystem::filesystem_error if `path` is not a folder.
  Folder(const std::filesystem::path& path, bool may_be_written);

  struct Entry {
    std::string file;   ///< Path relative to the folder: "teaching/creep.toml".
    std::string title;  ///< "" if it has no title.
    std::string about;  ///< Summary, see Glance.
    std::optional<std::size_t> place = {};  ///< Position of its first mention in the README.md of its folder.
    std::optional<LessonGlance> lesson = {};  ///< Present if the netlist has a lesson.
  };
  struct Listing {
    std::vector<Entry> scenes;  ///< Sorted by name.
    std::size_t left_out = 0;   ///< Number of .toml files beyond the limit, which have not been read.
    bool all_visited = true;    ///< False: there may be further files.
  };
  /// The netlists in the folder and below that are scenes; at most a thousand.
  Listing scenes() const;

  struct Netlist {
    std::string text;
    std::string version;  ///< Identifies this text among all texts of the file.
  };
  /// A netlist or a lesson; absent if there is none with that name.
  std::optional<Netlist> read(const std::string& file) const;

  struct Written {
    enum class Outcome { done, no_name, not_here, other_there, failed };
    Outcome outcome = Outcome::done;
    std::string why;      ///< Reason as text, unless `done`.
    std::string version;  ///< Version of the text that the file has now, written or not; "" if there is no file.
  };
  /// Writes a netlist or a lesson. Replaces an existing file only if its version is `version`, so that changes by others are not lost.
  Written write(const std::string& file, const std::string& text, const std::string& version);
  bool may_be_written() const { return may_be_written_; }

  const std::filesystem::path& path() const { return path_; }
  /// Descriptor of the open folder.
  int descriptor() const { return root_.get(); }

 private:
  std::filesystem::path path_;
  Descriptor root_;
  bool may_be_written_;
  std::mutex writing_;
};

}  // namespace rheonet::serve
