#include "tools/serve/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <functional>
#include <map>

#include "tools/serve/glance.hpp"
#include "tools/serve/netlist_name.hpp"

namespace rheonet::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_listed = 1000, most_visited = 20'000;
constexpr int deepest = 6;
constexpr std::size_t largest_file = 1u << 20, most_looked_at = 20u << 20;

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

bool is_hidden(const fs::path& path) {
  return std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part.string().starts_with('.'); });
}

/// The text of a regular file; absent if it is none, or too large to be a netlist.
std::optional<std::string> text_of(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return {};
  struct stat status {};
  bool whole = false;
  std::string text;
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
    std::array<char, 1u << 16> piece;
    while (!whole && text.size() <= largest_file) {
      const ssize_t count = ::read(file, piece.data(), piece.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) break;
      whole = count == 0;
      text.append(piece.data(), static_cast<std::size_t>(count));
    }
  }
  ::close(file);
  if (!whole || text.size() > largest_file) return {};
  return text;
}

std::string version_of(const std::string& text) { return fmt::format("{:016x}", std::hash<std::string>{}(text)); }

/// Where a text first names a file; absent if it does not.
std::optional<std::size_t> place_of(const std::string& name, const std::string& text) {
  const auto belongs = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.'; };
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1))
    if (at == 0 || !belongs(text[at - 1])) return at;
  return {};
}

/// Puts a text in the place of another: whoever reads it meanwhile sees the old one or the new one. Why it cannot; "" if it
/// is done.
std::string put(const fs::path& place, const std::string& text) {
  std::string other = (place.parent_path() / ".rheonet-XXXXXX").string();
  const int file = ::mkstemp(other.data());
  if (file < 0) return std::strerror(errno);
  bool ok = ::fchmod(file, 0644) == 0;
  for (std::size_t written = 0; ok && written < text.size();) {
    const ssize_t count = ::write(file, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    ok = count > 0;
    written += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  int error = ok ? 0 : errno;
  if (::close(file) != 0 && ok) error = errno, ok = false;
  if (ok && ::rename(other.c_str(), place.c_str()) != 0) error = errno, ok = false;
  if (ok) return "";
  ::unlink(other.c_str());
  return std::strerror(error);
}

}  // namespace

Folder::Folder(const fs::path& path, bool may_be_written) : path_(fs::canonical(path)), may_be_written_(may_be_written) {
  if (!fs::is_directory(path_)) throw fs::filesystem_error("no folder", path, std::make_error_code(std::errc::not_a_directory));
}

std::vector<Folder::Entry> Folder::scenes() const {
  std::vector<Entry> found;
  std::error_code failed;
  std::size_t visited = 0, looked_at = 0;
  fs::recursive_directory_iterator item(path_, fs::directory_options::skip_permission_denied, failed), end;
  for (; !failed && item != end && found.size() < most_listed && ++visited < most_visited; item.increment(failed)) {
    const fs::path name = item->path().lexically_relative(path_);
    if (item->is_directory(failed) && (is_hidden(name) || item.depth() >= deepest)) item.disable_recursion_pending();
    if (!fault_of_name(name.string()).empty()) continue;
    const std::optional<std::string> text = text_of(item->path());
    if (!text) continue;
    looked_at += text->size();
    const std::optional<Glance> seen = looked_at < most_looked_at ? glance(*text) : Glance{};
    if (seen) found.push_back({name.string(), seen->title, seen->about});
  }
  std::map<fs::path, std::string> pages;
  for (Entry& entry : found) {
    const fs::path place = path_ / entry.file;
    const auto [page, is_new] = pages.try_emplace(place.parent_path());
    if (is_new) page->second = text_of(place.parent_path() / "README.md").value_or("");
    entry.place = place_of(place.filename().string(), page->second);
  }
  std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.file < b.file; });
  return found;
}

std::optional<fs::path> Folder::locate(const std::string& file, std::string& why) const {
  why = fault_of_name(file);
  if (!why.empty()) return {};
  std::error_code failed;
  // Links are followed, and must not lead out.
  const fs::path place = fs::weakly_canonical(path_ / file, failed);
  const fs::path parent = fs::path(file).parent_path();
  if (failed)
    why = fmt::format("`{}` leads nowhere: {}", file, failed.message());
  else if (!is_within(place, path_))
    why = fmt::format("`{}` is a link that leads out of the folder, or behind one", file);
  else if (!fs::is_directory(place.parent_path(), failed))
    why = fmt::format("there is no folder `{}` here to put it in", parent.string());
  else if (fs::is_directory(place, failed))
    why = fmt::format("`{}` is the name of a folder", file);
  else
    return place;
  return {};
}

std::optional<Folder::Netlist> Folder::read(const std::string& file) const {
  std::string why;
  const std::optional<fs::path> place = locate(file, why);
  if (!place) return {};
  std::optional<std::string> text = text_of(*place);
  if (!text) return {};
  std::string version = version_of(*text);
  return Netlist{std::move(*text), std::move(version)};
}

Folder::Written Folder::write(const std::string& file, const std::string& text, const std::string& version) {
  using Outcome = Written::Outcome;
  if (!may_be_written_)
    return {Outcome::not_here, "the netlists that come with rheonet are not changed; serve a folder of your own to save there", ""};
  std::string why;
  const std::optional<fs::path> place = locate(file, why);
  if (!place) return {Outcome::no_name, why, ""};
  const std::lock_guard lock(writing_);
  std::error_code failed;
  if (fs::exists(*place, failed)) {
    const std::optional<std::string> there = text_of(*place);
    if (!there) return {Outcome::failed, fmt::format("`{}` is there already, and is no netlist that can be read", file), ""};
    const std::string found = version_of(*there);
    if (version.empty()) return {Outcome::other_there, fmt::format("there is already a netlist `{}`", file), found};
    if (version != found) return {Outcome::other_there, fmt::format("`{}` has changed since it was opened here", file), found};
  }
  why = put(*place, text);
  if (!why.empty()) return {Outcome::failed, "it cannot be written: " + why, ""};
  return {Outcome::done, "", version_of(text)};
}

fs::path Folder::beside(const std::string& file) const {
  std::string why;
  const std::optional<fs::path> place = locate(file, why);
  return place ? place->parent_path() : path_;
}

}  // namespace rheonet::serve
