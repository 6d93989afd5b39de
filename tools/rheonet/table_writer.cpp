#include "tools/rheonet/table_writer.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "core/netlist/csv_fields.hpp"

namespace rheonet::tool {
namespace {

constexpr TableFormat formats[] = {{".nc", "librheonet_netcdf.so", "libnetcdf-dev"}, {".mat", "librheonet_mat.so", "zlib1g-dev"}};
constexpr std::size_t rows_together = 8192;

}  // namespace

const TableFormat* table_format(const std::string& path) {
  const auto* const found = std::find_if(std::begin(formats), std::end(formats), [&](const TableFormat& f) { return path.ends_with(f.ending); });
  return found == std::end(formats) ? nullptr : found;
}

TableWriter::TableWriter(const TableFormat& format, tables::Layout layout) : layout_(std::move(layout)) {
  void* const part = ::dlopen(format.part, RTLD_NOW | RTLD_LOCAL);  // Never unloaded.
  if (part == nullptr) {
    const char* const why = ::dlerror();
    throw std::runtime_error(fmt::format("{} files need a part of rheonet that is missing: {}\n  build rheonet with the Debian package {}, or write .csv",
                                         format.ending, why ? why : format.part, format.package));
  }
  open_ = reinterpret_cast<tables::OpenTableFile*>(::dlsym(part, "open_table_file"));
  rows_.numbers.resize(layout_.columns.size());
  rows_.texts.resize(layout_.columns.size());
}

TableWriter::~TableWriter() = default;

void TableWriter::begin(const char* path) { file_.reset(open_(path, layout_)); }

void TableWriter::take(std::string_view text) {
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    begun_ += text.substr(0, end);
    take_line(begun_);
    begun_.clear();
    text.remove_prefix(end + 1);
  }
  begun_ += text;
}

void TableWriter::take_line(std::string_view line) {
  if (!std::exchange(has_header_, true)) return;
  const std::vector<CsvField> fields = csv_fields(line);
  if (fields.size() != layout_.columns.size()) throw std::system_error(EINVAL, std::generic_category(), "a row has another number of cells than the table");
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (layout_.columns[k].kind == tables::Column::Kind::text)
      rows_.texts[k].emplace_back(fields[k].text);
    else
      rows_.numbers[k].push_back(csv_number(fields[k].text).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (++rows_.count == rows_together) put();
}

void TableWriter::put() {
  if (rows_.count > 0) file_->append(rows_);
  rows_.count = 0;
  for (auto& column : rows_.numbers) column.clear();
  for (auto& column : rows_.texts) column.clear();
}

void TableWriter::close() {
  put();
  file_->close();
  file_.reset();
}

}  // namespace rheonet::tool
