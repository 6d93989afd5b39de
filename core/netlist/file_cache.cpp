#include "core/netlist/file_cache.hpp"

#include <dlfcn.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "core/netlist/document.hpp"

namespace rheonet {

namespace fs = std::filesystem;

namespace {

/// Whether a MAT file is of version 7.3, whose header has this version and a byte order at its end.
bool is_mat_of_hdf5(const fs::path& file) {
  char head[128] = {};
  std::ifstream(file, std::ios::binary).read(head, sizeof head);
  const std::string_view end(head + 124, 4);
  return end == std::string_view("\0\2IM", 4) || end == std::string_view("\2\0MI", 4);
}

/// The table of a MAT file as CSV, by a part of rheonet that is loaded for it: tools/tables/mat_level5.cpp or mat_hdf5.cpp.
std::optional<std::string> mat_as_csv(const fs::path& file, std::string& why) {
  using TableText = bool(const char* path, std::string& text, std::string& why);
  const bool is_hdf5 = is_mat_of_hdf5(file);
  const std::string library = is_hdf5 ? "librheonet_mat_hdf5.so" : "librheonet_mat.so", package = is_hdf5 ? "libmatio-dev" : "zlib1g-dev";
  void* const part = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays loaded
  if (part == nullptr) {
    const char* const reason = ::dlerror();
    why = (is_hdf5 ? ".mat files of version 7.3 need a part of rheonet that is missing: " : ".mat files need a part of rheonet that is missing: ") +
          (reason ? reason : library) + "; build rheonet with the Debian package " + package + ", or save the table as " +
          (is_hdf5 ? ".csv, or with `save -v7`" : ".csv");
    return {};
  }
  std::string text;
  if (reinterpret_cast<TableText*>(::dlsym(part, "table_text"))(file.c_str(), text, why)) return text;
  return {};
}

}  // namespace

bool is_netcdf(std::string_view text) {
  return text.starts_with("\x89HDF") || text.starts_with("CDF\x01") || text.starts_with("CDF\x02") || text.starts_with("CDF\x05");
}

std::optional<std::string> read_text(const fs::path& file, std::string& why) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    why = "it is a folder";
    return {};
  }
  if (file.extension() == ".mat") return mat_as_csv(file, why);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) text.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream && !stream.eof()) {
    why = errno != 0 ? std::strerror(errno) : "it cannot be opened";
    return {};
  }
  return text;
}

std::optional<std::string> FileCache::text_of(const fs::path& file, std::string& why) {
  const std::scoped_lock lock(mutex_);
  const auto known = contents_.texts.find(file);
  if (known != contents_.texts.end()) return known->second;
  auto text = read_text(file, why);
  if (text) contents_.texts.emplace(file, *text);
  return text;
}

bool FileCache::has(const fs::path& file) {
  const std::scoped_lock lock(mutex_);
  return contents_.texts.contains(file);
}

fs::path FileCache::canonical(const fs::path& path, std::error_code& failed) {
  const std::scoped_lock lock(mutex_);
  const auto known = contents_.canonical.find(path);
  failed.clear();
  if (known != contents_.canonical.end()) return known->second;
  fs::path found = fs::canonical(path, failed);
  if (!failed) contents_.canonical.emplace(path, found);
  return found;
}

FileCache::Contents FileCache::contents() {
  const std::scoped_lock lock(mutex_);
  return contents_;
}

void FileCache::add(Contents contents) {
  const std::scoped_lock lock(mutex_);
  contents_.texts.merge(contents.texts);
  contents_.canonical.merge(contents.canonical);
}

std::shared_ptr<const TomlValue> FileCache::document(int file, const Sources& sources, DiagnosticList& diagnostics) {
  const std::string& text = sources.files[static_cast<std::size_t>(file)].text;
  {
    const std::scoped_lock lock(mutex_);
    if (const auto known = documents_.find({file, text}); known != documents_.end()) return known->second;
  }
  const std::size_t told = diagnostics.all().size();
  std::optional<TomlValue> parsed = parse_toml(file, sources, diagnostics);
  if (!parsed) return nullptr;
  const auto document = std::make_shared<const TomlValue>(std::move(*parsed));
  const std::scoped_lock lock(mutex_);
  if (diagnostics.all().size() == told) documents_.emplace(std::pair{file, text}, document);
  return document;
}

}  // namespace rheonet
