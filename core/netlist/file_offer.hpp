#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/read.hpp"

namespace rheonet {

/// A source of files other than the disk, for programs that read scenes from untrusted users.
class FileOffer {
 public:
  virtual ~FileOffer() = default;
  /// The text of a file; `path` is relative to the root of the offer: "models/oil.toml". Absent if the file is not offered;
  /// `why` then gives the reason, and is "" if no such file exists.
  virtual std::optional<std::string> text_of(const std::filesystem::path& path, std::string& why) const = 0;
};

/// As read_scene_text, but included files and tables are read from the offers alone, and messages name files by their paths
/// in the offer. The scene stands in `folder` of the first offer; `include` falls back on the other offers. Expects at
/// least one offer.
ReadResult read_offered_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                             Declarations declarations, const ReadOptions& options, std::vector<const FileOffer*> offers);

}  // namespace rheonet
