#include <H5Epublic.h>
#include <matio.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

#include "tools/tables/mat_table.hpp"

namespace rheonet::tables {
namespace {

struct Free {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Free>;

template <class Number>
void add_numbers(MatTable& table, const matvar_t& variable) {
  add_columns(table, variable.name, variable.dims[0], variable.dims[1],
              [data = static_cast<const Number*>(variable.data)](std::size_t k) { return static_cast<double>(data[k]); });
}

void add(MatTable& table, const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex || !variable.name || !variable.data) return;
  switch (variable.class_type) {
    case MAT_C_DOUBLE: return add_numbers<double>(table, variable);
    case MAT_C_SINGLE: return add_numbers<float>(table, variable);
    case MAT_C_INT8: return add_numbers<std::int8_t>(table, variable);
    case MAT_C_UINT8: return add_numbers<std::uint8_t>(table, variable);
    case MAT_C_INT16: return add_numbers<std::int16_t>(table, variable);
    case MAT_C_UINT16: return add_numbers<std::uint16_t>(table, variable);
    case MAT_C_INT32: return add_numbers<std::int32_t>(table, variable);
    case MAT_C_UINT32: return add_numbers<std::uint32_t>(table, variable);
    case MAT_C_INT64: return add_numbers<std::int64_t>(table, variable);
    case MAT_C_UINT64: return add_numbers<std::uint64_t>(table, variable);
    default: return;
  }
}

/// Notes errors within HDF5 while it lives. libmatio overlooks some, and HDF5 would print them.
class Hdf5Errors {
 public:
  Hdf5Errors() {
    H5Eget_auto2(H5E_DEFAULT, &former_, &former_data_);
    H5Eset_auto2(H5E_DEFAULT, &note, this);
  }
  ~Hdf5Errors() { H5Eset_auto2(H5E_DEFAULT, former_, former_data_); }
  Hdf5Errors(const Hdf5Errors&) = delete;
  Hdf5Errors& operator=(const Hdf5Errors&) = delete;

  bool any() const { return any_; }

 private:
  static herr_t note(hid_t /*stack*/, void* self) {
    static_cast<Hdf5Errors*>(self)->any_ = true;
    return 0;
  }

  H5E_auto2_t former_ = nullptr;
  void* former_data_ = nullptr;
  bool any_ = false;
};

/// Reads a MAT file of version 7.3, which is HDF5: that library checks the sizes.
MatTable read_hdf5(const char* path) {
  const Hdf5Errors errors;
  errno = 0;
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_Open(path, MAT_ACC_RDONLY), &Mat_Close);
  if (!file) throw MatError(errno != 0 ? std::strerror(errno) : "it is no MAT file");
  std::size_t count = 0, listed = 0;
  Mat_GetDir(file.get(), &listed);
  MatTable table;
  for (; const Variable variable{Mat_VarReadNext(file.get())}; ++count) add(table, *variable);
  if (errors.any() || count < listed) throw MatError("it is damaged or cut: the HDF5 library cannot read it to its end");
  return table;
}

}  // namespace
}  // namespace rheonet::tables

extern "C" __attribute__((visibility("default"))) bool table_text(const char* path, std::string& text, std::string& why) {
  return rheonet::tables::table_text(&rheonet::tables::read_hdf5, path, text, why);
}
