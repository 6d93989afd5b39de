#include <H5Fpublic.h>
#include <H5public.h>
#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <system_error>

#include "tools/tables/table_file.hpp"

namespace rheonet::tables {
namespace {

/// The libraries below keep the number of a system error, but do not return it.
void check(int status) {
  if (status == NC_NOERR) return;
  const int error = errno;
  if (status > 0) throw std::system_error(status, std::generic_category());
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(), nc_strerror(status));
}

/// A name as NetCDF allows it, without `/` and different from all before it.
std::string allowed(std::string name, std::set<std::string>& used) {
  std::replace(name.begin(), name.end(), '/', '_');
  while (!used.insert(name).second) name += '_';
  return name;
}

void add_text(int file, int variable, const char* name, const std::string& text) {
  check(nc_put_att_text(file, variable, name, text.size(), text.c_str()));
}

/// Keeps the cache of HDF5 for the structure of the file, and for texts, at its first size. It would grow with the number of texts, up to 32 MB. NetCDF does not
/// give access to this setting.
void limit_metadata_cache() {
  hid_t file = H5I_INVALID_HID;
  if (H5Fget_obj_ids(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_FILE, 1, &file) != 1) return;
  H5AC_cache_config_t config;
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  if (H5Fget_mdc_config(file, &config) < 0) return;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  config.set_initial_size = true;
  config.initial_size = config.min_size;
  H5Fset_mdc_config(file, &config);
}

/// Variables over one unlimited dimension. A column that is called as the rows are is the coordinate.
class NetcdfFile : public TableFile {
  static constexpr std::size_t chunk = 8192;  // rows

 public:
  NetcdfFile(const char* path, const Layout& layout) {
    H5dont_atexit();  // At exit HDF5 would flush unfinished files, and crash if the disk is full.
    errno = 0;
    check(nc_create(path, NC_NETCDF4 | NC_CLOBBER, &file_));
    limit_metadata_cache();
    try {
      int dimension = 0;
      check(nc_def_dim(file_, layout.row.c_str(), NC_UNLIMITED, &dimension));
      if (!layout.title.empty()) add_text(file_, NC_GLOBAL, "title", layout.title);
      add_text(file_, NC_GLOBAL, "source", layout.program);
      std::set<std::string> used;
      for (const Column& column : layout.columns) {
        const nc_type type = column.kind == Column::Kind::number ? NC_DOUBLE : column.kind == Column::Kind::text ? NC_STRING : NC_INT64;
        int& variable = variables_.emplace_back();
        check(nc_def_var(file_, allowed(column.name, used).c_str(), type, 1, &dimension, &variable));
        check(nc_def_var_chunking(file_, variable, NC_CHUNKED, &chunk));
        constexpr std::size_t cache = 1 << 18, slots = 13;  // bytes for a few chunks: rows come one after the other
        check(nc_set_var_chunk_cache(file_, variable, cache, slots, 1));
        if (type != NC_STRING) check(nc_def_var_deflate(file_, variable, 1, 1, 1));
        if (!column.unit.empty() && type == NC_DOUBLE) add_text(file_, variable, "units", column.unit);
        add_text(file_, variable, "long_name", column.name);
      }
      written_.resize(variables_.size());
      check(nc_enddef(file_));
    } catch (...) {
      nc_abort(file_);
      throw;
    }
  }
  ~NetcdfFile() override {
    if (open_) nc_close(file_);
  }

  void append(const Rows& rows) override {
    errno = 0;
    for (std::size_t k = 0; k < variables_.size(); ++k) {
      if (!rows.texts[k].empty()) {
        // A text costs more time and memory than a row of numbers, and most cells of `error` are empty. Those after the last text that is
        // written read as "".
        if (std::all_of(rows.texts[k].begin(), rows.texts[k].end(), [](const std::string& text) { return text.empty(); })) continue;
        put_empty_texts(k);
        written_[k] = row_ + rows.count;
        std::vector<const char*> texts;
        for (const std::string& text : rows.texts[k]) texts.push_back(text.c_str());
        check(nc_put_vara_string(file_, variables_[k], &row_, &rows.count, texts.data()));
      } else {
        check(nc_put_vara_double(file_, variables_[k], &row_, &rows.count, rows.numbers[k].data()));
      }
    }
    row_ += rows.count;
  }

  void close() override {
    errno = 0;
    open_ = false;
    check(nc_close(file_));
  }

 private:
  /// For the rows of a variable up to here that are not written: HDF5 could not read them.
  void put_empty_texts(std::size_t k) {
    std::vector<const char*> texts(chunk, "");
    for (std::size_t row = written_[k]; row < row_; row += chunk) {
      const std::size_t count = std::min(chunk, row_ - row);
      check(nc_put_vara_string(file_, variables_[k], &row, &count, texts.data()));
    }
  }

  int file_ = 0;
  bool open_ = true;
  std::vector<int> variables_;
  std::vector<std::size_t> written_;  ///< Rows of each variable of texts that are written.
  std::size_t row_ = 0;
};

}  // namespace
}  // namespace rheonet::tables

extern "C" __attribute__((visibility("default"))) rheonet::tables::TableFile* open_table_file(const char* path, const rheonet::tables::Layout& layout) {
  return new rheonet::tables::NetcdfFile(path, layout);
}
