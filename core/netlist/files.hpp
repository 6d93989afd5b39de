#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/file_cache.hpp"

namespace rheonet {

class FileOffer;

/// The files of a scene. A file is searched for in the folder of the file that names it and below, then in the library, and
/// nowhere else.
class Files {
 public:
  Files(Sources& sources, std::vector<std::filesystem::path> library, FileCache* cache, std::vector<const FileOffer*> offers)
      : sources_(sources), library_(std::move(library)), cache_(cache), offers_(std::move(offers)) {}

  /// The text of a file; absent if it cannot be read; `why` then gives the reason.
  std::optional<std::string> text_of(const std::filesystem::path& file, std::string& why) const;

  /// Adds a file's text to Sources and returns its number there; `folder` is the folder of the file.
  int add(std::filesystem::path shown, std::string text, std::filesystem::path folder,
          Sources::Role role = Sources::Role::scene);

  struct Found {
    std::filesystem::path shown;      ///< name in messages
    std::filesystem::path canonical;  ///< equal for two paths of the same file
    std::optional<std::string> text = {};  ///< of an offered file
    std::size_t offer = 0;                 ///< index of the offer that has it
  };
  /// Finds the file that the string `name` names in file `from`. A file that is absent or outside the allowed folders is a
  /// mistake.
  std::optional<Found> find(const TomlValue& name, int from, DiagnosticList& diagnostics) const;

  /// The file of the library that has a model or law of this name, as `include` names it; "" if there is none.
  std::string file_with_model(std::string_view name) const;

  /// Reads a whole file and adds it; a failure is a mistake at `spot`.
  std::optional<int> read(const Found& found, Sources::Role role, Spot spot, DiagnosticList& diagnostics);

  /// Parses a file of Sources; see parse_toml.
  std::optional<Document> document(int file, DiagnosticList& diagnostics) const;

  /// As std::filesystem::canonical.
  std::filesystem::path canonical(const std::filesystem::path& path, std::error_code& failed) const {
    return cache_ ? cache_->canonical(path, failed) : std::filesystem::canonical(path, failed);
  }

  const Sources& sources() const { return sources_; }
  const std::string& text(int file) const { return sources_.files[static_cast<std::size_t>(file)].text; }
  /// Name of a file in messages.
  std::string shown(int file) const {
    return file == Spot::command_line ? "the command line" : sources_.files[static_cast<std::size_t>(file)].path.string();
  }

 private:
  /// Location of a file of Sources.
  struct Place {
    std::filesystem::path folder;
    std::size_t offer = 0;
  };
  std::optional<Found> find_on_disk(const TomlValue& name, const Place& from, DiagnosticList& diagnostics) const;
  std::optional<Found> find_offered(const TomlValue& name, const Place& from, DiagnosticList& diagnostics) const;

  Sources& sources_;
  std::vector<std::filesystem::path> library_;
  FileCache* cache_;  ///< nullptr: each file is read anew
  std::vector<const FileOffer*> offers_;
  std::vector<Place> places_;  ///< of each file of Sources
};

}  // namespace rheonet
