#include "core/netlist/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "core/netlist/characters.hpp"
#include "core/netlist/file_offer.hpp"

namespace rheonet {

namespace fs = std::filesystem;

namespace {

/// Whether `path` lies in or below `folder`; both are canonical.
bool within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

bool path_without_ending(const std::string& name) { return fs::path(name).extension().empty(); }

const char* const rule = "files are looked for beside the one that names them and below, then in the library";

}  // namespace

std::optional<std::string> Files::text_of(const fs::path& file, std::string& why) const {
  return cache_ ? cache_->text_of(file, why) : read_text(file, why);
}

std::optional<Document> Files::document(int file, DiagnosticList& diagnostics) const {
  std::shared_ptr<const TomlValue> parsed;
  if (cache_)
    parsed = cache_->document(file, sources_, diagnostics);
  else if (auto value = parse_toml(file, sources_, diagnostics))
    parsed = std::make_shared<const TomlValue>(std::move(*value));
  return parsed ? std::optional(Document(std::move(parsed))) : std::nullopt;
}

int Files::add(fs::path shown, std::string text, fs::path folder, Sources::Role role) {
  // Lines and columns do not count a byte order mark.
  drop_byte_order_mark(text);
  sources_.files.push_back({std::move(shown), std::move(text), role});
  places_.push_back({std::move(folder)});
  return static_cast<int>(sources_.files.size()) - 1;
}

std::optional<Files::Found> Files::find(const TomlValue& name, int from, DiagnosticList& diagnostics) const {
  const fs::path path(name.text);
  if (path.empty()) {
    diagnostics.error(name.spot, "the name of a file is empty");
    return {};
  }
  if (path.is_absolute() || *path.lexically_normal().begin() == "..") {
    diagnostics.error(name.spot, "`" + name.text + "` leads outside the netlist's folder", rule);
    return {};
  }
  // Files named on the command line are searched for as if named by the scene itself.
  const Place& place = places_[static_cast<std::size_t>(std::max(from, 0))];
  return offers_.empty() ? find_on_disk(name, place, diagnostics) : find_offered(name, place, diagnostics);
}

std::optional<Files::Found> Files::find_on_disk(const TomlValue& name, const Place& from, DiagnosticList& diagnostics) const {
  const fs::path normal = fs::path(name.text).lexically_normal();
  std::vector<fs::path> folders{from.folder};
  folders.insert(folders.end(), library_.begin(), library_.end());
  for (const fs::path& folder : folders) {
    std::error_code failed;
    const fs::path base = canonical(folder.empty() ? fs::path(".") : folder, failed);
    if (failed) continue;
    const fs::path found = canonical(base / normal, failed);
    if (failed) continue;
    if (!within(found, base)) {
      diagnostics.error(name.spot, "`" + name.text + "` is a link that leads outside the netlist's folder", rule);
      return {};
    }
    if (!(cache_ && cache_->has(found)) && !fs::is_regular_file(found, failed)) {
      diagnostics.error(name.spot, "`" + name.text + "` is no file");
      return {};
    }
    return Found{(folder / normal).lexically_normal(), found};
  }
  diagnostics.error(name.spot, "there is no file `" + name.text + "`", path_without_ending(name.text) ? "is its name `" + name.text + ".toml`?" : rule);
  return {};
}

std::string Files::file_with_model(std::string_view name) const {
  std::set<std::string> files;
  for (const fs::path& folder : library_) {
    std::error_code failed;
    for (const fs::directory_entry& file : fs::directory_iterator(folder / "library", failed)) {
      std::string why;
      const std::optional<std::string> text = file.path().extension() == ".toml" ? text_of(file.path(), why) : std::nullopt;
      const auto has = [&](const char* kind) { return text && text->find(fmt::format("[{}.{}]", kind, name)) != text->npos; };
      if (has("models") || has("laws")) files.insert("library/" + file.path().filename().string());
    }
  }
  return files.empty() ? "" : *files.begin();
}

std::optional<Files::Found> Files::find_offered(const TomlValue& name, const Place& from, DiagnosticList& diagnostics) const {
  std::vector<Place> places{from};
  for (std::size_t offer = 1; offer < offers_.size(); ++offer) places.push_back({"", offer});
  for (const Place& place : places) {
    const fs::path path = (place.folder / name.text).lexically_normal();
    std::string why;
    std::optional<std::string> text = offers_[place.offer]->text_of(path, why);
    if (text) return Found{path, fs::path(std::to_string(place.offer)) / path, std::move(text), place.offer};
    if (why.empty()) continue;
    diagnostics.error(name.spot, "`" + name.text + "` cannot be read: " + why, rule);
    return {};
  }
  diagnostics.error(name.spot, "there is no file `" + name.text + "`", rule);
  return {};
}

std::optional<int> Files::read(const Found& found, Sources::Role role, Spot spot, DiagnosticList& diagnostics) {
  std::string why;
  auto text = found.text ? found.text : text_of(found.canonical, why);
  if (!text) {
    diagnostics.error(spot, "`" + found.shown.string() + "` cannot be read: " + why);
    return {};
  }
  const int file = add(found.shown, std::move(*text), found.shown.parent_path(), role);
  places_.back().offer = found.offer;
  return file;
}

}  // namespace rheonet
