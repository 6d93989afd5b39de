#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/file_cache.hpp"
#include "core/netlist/mistakes.hpp"

namespace rheonet {

class FileOffer;

/// The files of a scene: where each was found, and where those that it names are looked for (beside it and below, then
/// in the library; never anywhere else).
class Files {
 public:
  Files(Sources& sources, std::vector<std::filesystem::path> library, FileCache* cache, std::vector<const FileOffer*> offers)
      : sources_(sources), library_(std::move(library)), cache_(cache), offers_(std::move(offers)) {}

  /// The text of a file; absent if it cannot be read, `why` then says why.
  std::optional<std::string> text_of(const std::filesystem::path& file, std::string& why) const;

  /// Takes a file's text in; `folder` is where it stands. Its number in Sources.
  int add(std::filesystem::path shown, std::string text, std::filesystem::path folder,
          Sources::Role role = Sources::Role::scene);

  struct Found {
    std::filesystem::path shown;      ///< what messages call it
    std::filesystem::path canonical;  ///< tells whether two are the same file
    std::optional<std::string> text = {};  ///< of one that is offered
    std::size_t offer = 0;                 ///< which offers it
  };
  /// Looks for the file that the string `name` names, in what file `from` may use. None, or one outside, is a mistake.
  std::optional<Found> find(const TomlValue& name, int from, Mistakes& mistakes) const;

  /// Reads a file whole and takes it in; a mistake at `spot` if that fails.
  std::optional<int> read(const Found& found, Sources::Role role, Spot spot, Mistakes& mistakes);

  const Sources& sources() const { return sources_; }
  const std::string& text(int file) const { return sources_.files[static_cast<std::size_t>(file)].text; }
  /// What messages call a file.
  std::string shown(int file) const {
    return file == Spot::command_line ? "the command line" : sources_.files[static_cast<std::size_t>(file)].path.string();
  }

 private:
  /// Where a file of Sources stands.
  struct Place {
    std::filesystem::path folder;
    std::size_t offer = 0;
  };
  std::optional<Found> find_on_disk(const TomlValue& name, const Place& from, Mistakes& mistakes) const;
  std::optional<Found> find_offered(const TomlValue& name, const Place& from, Mistakes& mistakes) const;

  Sources& sources_;
  std::vector<std::filesystem::path> library_;
  FileCache* cache_;  ///< nullptr: each file is read anew
  std::vector<const FileOffer*> offers_;
  std::vector<Place> places_;  ///< of each file of Sources
};

}  // namespace rheonet
