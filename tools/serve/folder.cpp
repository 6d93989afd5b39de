#include "tools/serve/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <functional>
#include <map>
#include <system_error>

#include "tools/rheonet/replacement.hpp"
#include "tools/serve/glance.hpp"
#include "tools/serve/netlist_name.hpp"

namespace rheonet::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_listed = 1000, most_visited = 20'000;
constexpr int deepest = 6;
constexpr std::size_t largest_file = 1u << 20, most_looked_at = 20u << 20;

std::string version_of(const std::string& text) { return fmt::format("{:016x}", std::hash<std::string>{}(text)); }

/// The position of the first mention of a file in a text; absent if there is none.
std::optional<std::size_t> place_of(const std::string& name, const std::string& text) {
  const auto belongs = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.'; };
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1))
    if (at == 0 || !belongs(text[at - 1])) return at;
  return {};
}

/// The version of the netlist `name` in a folder; "" if there is none. Absent if this entry of the folder must not be
/// overwritten: `why` then gives the reason.
std::optional<std::string> version_there(int folder, const fs::path& name, std::string& why) {
  struct stat status {};
  if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return "";
  constexpr mode_t writable = S_IWUSR | S_IWGRP | S_IWOTH;
  if (const std::optional<std::string> text = text_below(folder, name, largest_file, why)) {
    // Root can write to any file, but a file without any write permission must not be changed.
    if ((status.st_mode & writable) != 0 && ::faccessat(folder, name.c_str(), W_OK, AT_EACCESS) == 0) return version_of(*text);
    why = "it is read-only";
  }
  return {};
}

/// Replaces the text of a file. Returns the reason of a failure, or "".
std::string put(int folder, const fs::path& name, const std::string& text) {
  try {
    tool::Replacement file(folder, name.string());
    int error = tool::write_text(file.descriptor(), text);
    if (error == 0) error = file.commit();
    return error == 0 ? "" : std::strerror(error);
  } catch (const std::system_error& error) {
    return error.code().message();
  }
}

/// The .toml files in a folder and below, sorted by name.
std::vector<fs::path> netlists_below(const fs::path& folder, bool& all_visited) {
  std::vector<fs::path> names;
  std::error_code failed;
  std::size_t visited = 0;
  fs::recursive_directory_iterator item(folder, fs::directory_options::skip_permission_denied, failed), end;
  for (; !failed && item != end && visited < most_visited; item.increment(failed), ++visited) {
    const fs::path name = item->path().lexically_relative(folder);
    if (item->is_directory(failed) && (is_hidden(name) || item.depth() >= deepest)) item.disable_recursion_pending();
    if (name.extension() == ".toml" && fault_of_name(name.string()).empty()) names.push_back(name);
  }
  all_visited = visited < most_visited;
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Folder::Folder(const fs::path& path, bool may_be_written)
    : path_(fs::canonical(path)), root_(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)), may_be_written_(may_be_written) {
  if (!root_.is_open()) throw fs::filesystem_error("no folder", path, std::error_code(errno, std::generic_category()));
}

Folder::Listing Folder::scenes() const {
  Listing found;
  const std::vector<fs::path> names = netlists_below(path_, found.all_visited);
  std::map<fs::path, std::string> pages;
  std::size_t looked_at = 0, taken = 0;
  for (; taken < names.size() && found.scenes.size() < most_listed; ++taken) {
    const fs::path& name = names[taken];
    std::string why;
    const std::optional<std::string> text = text_below(root_.get(), name, largest_file, why);
    if (!text) continue;
    looked_at += text->size();
    const std::optional<Glance> seen = looked_at < most_looked_at ? glance(*text) : Glance{};
    if (!seen) continue;
    const auto [page, is_new] = pages.try_emplace(name.parent_path());
    if (is_new) page->second = text_below(root_.get(), name.parent_path() / "README.md", largest_file, why).value_or("");
    found.scenes.push_back({name.string(), seen->title, seen->about, place_of(name.filename().string(), page->second)});
    if (const auto lesson = text_below(root_.get(), lesson_file_of(name.string()), largest_file, why)) found.scenes.back().lesson = glance_at_lesson(*lesson);
  }
  found.left_out = names.size() - taken;
  return found;
}

std::optional<Folder::Netlist> Folder::read(const std::string& file) const {
  if (!fault_of_name(file).empty()) return {};
  std::string why;
  std::optional<std::string> text = text_below(root_.get(), file, largest_file, why);
  if (!text) return {};
  std::string version = version_of(*text);
  return Netlist{std::move(*text), std::move(version)};
}

Folder::Written Folder::write(const std::string& file, const std::string& text, const std::string& version) {
  using Outcome = Written::Outcome;
  if (!may_be_written_)
    return {Outcome::not_here, "the netlists that come with rheonet are not changed; serve a folder of your own to save there", ""};
  std::string why = fault_of_name(file);
  if (!why.empty()) return {Outcome::no_name, why, ""};
  const fs::path path(file), name = path.filename();
  const Descriptor parent = open_parent(root_.get(), path, why);
  if (!parent.is_open()) {
    if (why.empty()) why = fmt::format("there is no folder `{}` here to put it in", path.parent_path().string());
    return {Outcome::no_name, why, ""};
  }
  const std::lock_guard lock(writing_);
  const std::optional<std::string> there = version_there(parent.get(), name, why);
  if (!there) return {Outcome::not_here, fmt::format("`{}` is there already, and is not overwritten: {}", file, why), ""};
  if (!there->empty() && version.empty()) return {Outcome::other_there, fmt::format("there is already a {} `{}`", path.extension() == ".lesson" ? "lesson" : "netlist", file), *there};
  if (!there->empty() && version != *there) return {Outcome::other_there, fmt::format("`{}` has changed since it was opened here", file), *there};
  why = put(parent.get(), name, text);
  if (!why.empty()) return {Outcome::failed, "it cannot be written: " + why, ""};
  return {Outcome::done, "", version_of(text)};
}

}  // namespace rheonet::serve
