#include "core/netlist/files.hpp"

#include <algorithm>
#include <system_error>

namespace rheonet {

namespace fs = std::filesystem;

namespace {

/// Whether `path` lies in `folder` or below it; both canonical.
bool within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::optional<std::string> Files::text_of(const fs::path& file, std::string& why) const {
  return cache_ ? cache_->text_of(file, why) : read_text(file, why);
}

int Files::add(fs::path shown, std::string text, fs::path folder, Sources::Role role) {
  // A byte order mark is no part of the text that lines and columns count.
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  sources_.files.push_back({std::move(shown), std::move(text), role});
  folders_.push_back(std::move(folder));
  return static_cast<int>(sources_.files.size()) - 1;
}

std::optional<Files::Found> Files::find(const TomlValue& name, int from, Mistakes& mistakes) const {
  const fs::path path(name.text);
  const fs::path normal = path.lexically_normal();
  const std::string rule = "files are looked for beside the one that names them and below, then in the library";
  if (path.empty()) {
    mistakes.error(name.spot, "the name of a file is empty");
    return {};
  }
  if (path.is_absolute() || *normal.begin() == "..") {
    mistakes.error(name.spot, "`" + name.text + "` leads outside the netlist's folder", rule);
    return {};
  }
  // Files named on the command line count as named by the scene itself.
  std::vector<fs::path> folders{folders_[static_cast<std::size_t>(std::max(from, 0))]};
  folders.insert(folders.end(), library_.begin(), library_.end());
  for (const fs::path& folder : folders) {
    std::error_code failed;
    const fs::path base = fs::canonical(folder.empty() ? fs::path(".") : folder, failed);
    if (failed) continue;
    const fs::path canonical = fs::canonical(base / normal, failed);
    if (failed) continue;
    if (!within(canonical, base)) {
      mistakes.error(name.spot, "`" + name.text + "` is a link that leads outside the netlist's folder", rule);
      return {};
    }
    if (!fs::is_regular_file(canonical, failed)) {
      mistakes.error(name.spot, "`" + name.text + "` is no file");
      return {};
    }
    return Found{(folder / normal).lexically_normal(), canonical};
  }
  mistakes.error(name.spot, "there is no file `" + name.text + "`", rule);
  return {};
}

std::optional<int> Files::read(const Found& found, Sources::Role role, Spot spot, Mistakes& mistakes) {
  std::string why;
  auto text = text_of(found.canonical, why);
  if (!text) {
    mistakes.error(spot, "`" + found.shown.string() + "` cannot be read: " + why);
    return {};
  }
  return add(found.shown, std::move(*text), found.shown.parent_path(), role);
}

}  // namespace rheonet
