#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace rheonet {

class DiagnosticList;
struct Sources;
struct TomlValue;

/// The text of a file; absent if it cannot be read; `why` then gives the reason. A MAT file, which ends in `.mat`, is given as CSV: a
/// column for each vector, with its name and, in files of rheonet, its unit. If vectors have several lengths, those of the most frequent length are given.
std::optional<std::string> read_text(const std::filesystem::path& file, std::string& why);

/// Whether a file begins as NetCDF files do: classic ones, and those of NetCDF-4, which are HDF5.
bool is_netcdf(std::string_view text);
/// How such a file becomes a table.
inline constexpr char netcdf_hint[] = "in Python: xarray.open_dataset(\"rows.nc\").to_dataframe().to_csv(\"rows.csv\")";

/// Caches the files of a scene that is read many times. Each file is read from disk and parsed once, so that every reading sees the
/// same version even if the file changes meanwhile, and costs little beside a short run. Thread-safe. Failures are not cached.
class FileCache {
 public:
  /// As read_text.
  std::optional<std::string> text_of(const std::filesystem::path& file, std::string& why);

  /// Whether the file has been read.
  bool has(const std::filesystem::path& file);

  /// As std::filesystem::canonical.
  std::filesystem::path canonical(const std::filesystem::path& path, std::error_code& failed);

  /// All files that were read so far, as the cache of another process can take them.
  struct Contents {
    std::map<std::filesystem::path, std::string> texts;
    std::map<std::filesystem::path, std::filesystem::path> canonical;
  };
  Contents contents();
  void add(Contents contents);

  /// As parse_toml: nullptr after a mistake.
  std::shared_ptr<const TomlValue> document(int file, const Sources& sources, DiagnosticList& diagnostics);

 private:
  std::mutex mutex_;
  Contents contents_;
  std::map<std::pair<int, std::string>, std::shared_ptr<const TomlValue>> documents_;  ///< by number and text of a file
};

}  // namespace rheonet
