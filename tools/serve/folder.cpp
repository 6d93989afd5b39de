#include "tools/serve/folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <regex>
#include <sstream>

namespace rheonet::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_scenes = 1000, most_visited = 20'000;
constexpr int deepest = 6;
constexpr std::uintmax_t most_bytes = 1u << 20;

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

bool is_hidden(const fs::path& path) {
  return std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part.string().starts_with('.'); });
}

std::string read_regular(const fs::path& path, bool& ok) {
  ok = false;
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return "";
  struct stat status {};
  std::string text;
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && static_cast<std::uintmax_t>(status.st_size) <= most_bytes) {
    text.resize(static_cast<std::size_t>(status.st_size));
    const ssize_t count = ::read(file, text.data(), text.size());
    ok = count >= 0;
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  ::close(file);
  return text;
}

/// What stands between the first and the last quote of a line.
std::string in_quotes(const std::string& line) {
  const std::size_t from = line.find('"'), to = line.rfind('"');
  return from != std::string::npos && to > from ? line.substr(from + 1, to - from - 1) : "";
}

/// Title, and the question of a demo or else the first comment, as far as a glance tells: a netlist is only read when it is
/// opened.
Folder::Entry glance(const std::string& file, const std::string& text) {
  Folder::Entry entry{file, "", ""};
  std::istringstream lines(text);
  bool comment = true, in_table = false, in_demo = false;
  std::string question;
  for (std::string line; std::getline(lines, line);) {
    if (comment && line.starts_with("#") && !line.starts_with("#:")) {
      const std::string words = line.substr(std::min<std::size_t>(line.size(), 2));
      if (words.empty() && !entry.about.empty())
        comment = false;
      else
        entry.about += (entry.about.empty() ? "" : " ") + words;
      continue;
    }
    comment = false;
    if (line.starts_with("[")) in_table = true, in_demo = line.starts_with("[demo]");
    if (!in_table && line.starts_with("title")) entry.title = in_quotes(line);
    if (in_demo && line.starts_with("question")) question = in_quotes(line);
  }
  if (!question.empty()) entry.about = question;
  constexpr std::size_t most_words = 400;
  if (entry.about.size() > most_words) entry.about = entry.about.substr(0, entry.about.find_last_of(' ', most_words)) + " ...";
  return entry;
}

bool has_scene(const std::string& text) {
  return (text.starts_with("[simulate]") || text.find("\n[simulate]") != std::string::npos) &&
         text.find("[elements") != std::string::npos;
}

}  // namespace

Folder::Folder(const fs::path& path, bool may_be_written) : path_(fs::canonical(path)), may_be_written_(may_be_written) {
  if (!fs::is_directory(path_)) throw fs::filesystem_error("no folder", path, std::make_error_code(std::errc::not_a_directory));
}

std::vector<Folder::Entry> Folder::scenes() const {
  std::vector<Entry> found;
  std::error_code failed;
  std::size_t visited = 0;
  fs::recursive_directory_iterator item(path_, fs::directory_options::skip_permission_denied, failed), end;
  for (; !failed && item != end && found.size() < most_scenes && ++visited < most_visited; item.increment(failed)) {
    const fs::path name = item->path().lexically_relative(path_);
    if (item->is_directory(failed) && (is_hidden(name) || item.depth() >= deepest)) item.disable_recursion_pending();
    if (name.extension() != ".toml" || is_hidden(name)) continue;
    bool ok = false;
    const std::string text = read_regular(item->path(), ok);
    if (ok && has_scene(text)) found.push_back(glance(name.string(), text));
  }
  std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.file < b.file; });
  return found;
}

std::optional<fs::path> Folder::locate(const std::string& file) const {
  const fs::path name(file);
  constexpr std::size_t longest = 1000;
  if (file.empty() || file.size() > longest || file.find('\0') != std::string::npos || name.is_absolute() || is_hidden(name) ||
      name.extension() != ".toml")
    return {};
  std::error_code failed;
  // Links are followed, and must not lead out.
  const fs::path place = fs::weakly_canonical(path_ / name, failed);
  if (failed || !is_within(place, path_) || !fs::is_directory(place.parent_path(), failed)) return {};
  return place;
}

std::optional<std::string> Folder::read(const std::string& file) const {
  const std::optional<fs::path> place = locate(file);
  if (!place) return {};
  bool ok = false;
  std::string text = read_regular(*place, ok);
  if (!ok) return {};
  return text;
}

std::string Folder::write(const std::string& file, const std::string& text) const {
  if (!may_be_written_) return "the netlists that come with rheonet are not changed; serve a folder of your own to save there";
  const std::optional<fs::path> place = locate(file);
  if (!place) return "`" + file + "` is no name of a netlist in this folder: it must end in .toml";
  // Whoever reads it meanwhile sees the old text or the new one.
  std::string other = (place->parent_path() / ".rheonet-XXXXXX").string();
  const int opened = ::mkstemp(other.data());
  if (opened < 0) return std::string("it cannot be written: ") + std::strerror(errno);
  bool ok = ::fchmod(opened, 0644) == 0;
  for (std::size_t written = 0; ok && written < text.size();) {
    const ssize_t count = ::write(opened, text.data() + written, text.size() - written);
    ok = count > 0;
    written += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  ok = ::close(opened) == 0 && ok;
  ok = ok && ::rename(other.c_str(), place->c_str()) == 0;
  if (ok) return "";
  const std::string why = std::strerror(errno);
  ::unlink(other.c_str());
  return "it cannot be written: " + why;
}

fs::path Folder::beside(const std::string& file) const {
  const std::optional<fs::path> place = locate(file);
  return place ? place->parent_path() : path_;
}

}  // namespace rheonet::serve
