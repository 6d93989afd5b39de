#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <system_error>

#include "tools/tables/table_file.hpp"

namespace rheonet::tables {
namespace {

[[noreturn]] void fail() { throw std::system_error(errno != 0 ? errno : EIO, std::generic_category()); }

/// A name as MATLAB allows it, different from all before it.
std::string allowed(const std::string& name, std::set<std::string>& used) {
  constexpr std::size_t longest = 63, suffix = 5;
  std::string word;
  for (const char c : name) {
    const bool fits = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fits || (!word.empty() && word.back() != '_')) word += fits ? c : '_';
  }
  while (!word.empty() && word.back() == '_') word.pop_back();
  if (word.empty() || std::isalpha(static_cast<unsigned char>(word[0])) == 0) word = "x" + word;
  word = word.substr(0, longest - suffix);
  std::string result = word;
  for (int k = 2; !used.insert(result).second; ++k) result = word + "_" + std::to_string(k);
  return result;
}

struct Free {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Free>;

Variable text_variable(const char* name, const std::string& text) {
  std::size_t size[2] = {text.empty() ? std::size_t{0} : std::size_t{1}, text.size()};
  return Variable(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size, const_cast<char*>(text.data()), 0));  // copied
}

Variable cells(const char* name, const std::vector<std::string>& texts) {
  std::size_t size[2] = {texts.size(), 1};
  Variable cell(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, size, nullptr, 0));
  if (!cell) fail();
  for (std::size_t k = 0; k < texts.size(); ++k) Mat_VarSetCell(cell.get(), static_cast<int>(k), text_variable(nullptr, texts[k]).release());
  return cell;
}

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Scratch = std::unique_ptr<std::FILE, Close>;

Scratch scratch() {
  Scratch file(std::tmpfile());
  if (!file) fail();
  return file;
}

/// MAT 5, which MATLAB, Octave and SciPy read. A column is a vector of that name; text is a vector of numbers, each the place of the text in
/// the cell array NAME_texts, 0 for none. A variable is written as a whole, so the rows wait in a temporary file, and the memory
/// does not grow with their number.
class MatFile : public TableFile {
 public:
  MatFile(const char* path, const Layout& layout) : layout_(layout), path_(path), rows_(scratch()), codes_(layout.columns.size()) {
    errno = 0;
    mat_ = Mat_CreateVer(path, layout.program.c_str(), MAT_FT_MAT5);
    if (!mat_) fail();
  }
  ~MatFile() override {
    if (mat_) Mat_Close(mat_);
  }

  void append(const Rows& rows) override {
    pieces_.push_back(rows.count);
    count_ += rows.count;
    for (std::size_t k = 0; k < layout_.columns.size(); ++k) {
      std::vector<double> numbers = rows.numbers[k];
      for (const std::string& text : rows.texts[k]) numbers.push_back(code(k, text));
      if (std::fwrite(numbers.data(), sizeof(double), numbers.size(), rows_.get()) != numbers.size()) fail();
    }
  }

  void close() override {
    errno = 0;
    std::set<std::string> used{"title", "source", "columns", "units"};
    std::vector<std::string> names, units, titles;
    if (std::fflush(rows_.get()) != 0) fail();
    for (std::size_t k = 0; k < layout_.columns.size(); ++k) {
      names.push_back(allowed(layout_.columns[k].name, used));
      titles.push_back(layout_.columns[k].name);
      units.push_back(layout_.columns[k].unit);
      write_column(k, names.back());
      if (layout_.columns[k].kind != Column::Kind::text) continue;
      std::vector<std::string> texts(codes_[k].size());
      for (const auto& [text, place] : codes_[k]) texts[place - 1] = text;
      write(cells(allowed(names.back() + "_texts", used).c_str(), texts));
    }
    write(text_variable("title", layout_.title));
    write(text_variable("source", layout_.program));
    write(cells("columns", titles));
    write(cells("units", units));
    const int closed = Mat_Close(mat_);
    mat_ = nullptr;
    if (closed != 0) fail();
    const int error = errno;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (is_written(k, names[k])) continue;
      errno = error == ENOSPC || error == EFBIG || error == EDQUOT ? error : EIO;
      fail();
    }
  }

 private:
  double code(std::size_t column, const std::string& text) {
    if (text.empty()) return 0;
    auto& codes = codes_[column];
    return static_cast<double>(codes.emplace(text, codes.size() + 1).first->second);
  }

  void write(const Variable& variable) {
    if (!variable || Mat_VarWrite(mat_, variable.get(), MAT_COMPRESSION_NONE) != 0) fail();
  }

  /// Calls take(first row, numbers) for each piece of a column.
  template <class Take>
  void for_pieces(std::size_t column, const Take& take) {
    const std::size_t columns = layout_.columns.size();
    std::size_t before = 0;  // rows
    std::vector<double> piece;
    for (const std::size_t count : pieces_) {
      piece.resize(count);
      const auto place = static_cast<off_t>((before * columns + column * count) * sizeof(double));
      const auto bytes = static_cast<ssize_t>(count * sizeof(double));
      if (::pread(fileno(rows_.get()), piece.data(), static_cast<std::size_t>(bytes), place) != bytes) fail();
      take(before, piece);
      before += count;
    }
  }

  /// The library does not say that the disk is full: the file is read again.
  bool is_written(std::size_t column, const std::string& name) {
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> mat(Mat_Open(path_.c_str(), MAT_ACC_RDONLY), &Mat_Close);
    const Variable variable(mat ? Mat_VarReadInfo(mat.get(), name.c_str()) : nullptr);
    if (!variable || variable->rank != 2 || variable->dims[0] != count_) return false;
    bool same = true;
    std::vector<double> found;
    for_pieces(column, [&](std::size_t before, const std::vector<double>& piece) {
      found.assign(piece.size(), 0);
      same = same && Mat_VarReadDataLinear(mat.get(), variable.get(), found.data(), static_cast<int>(before), 1, static_cast<int>(piece.size())) == 0 &&
             std::memcmp(found.data(), piece.data(), piece.size() * sizeof(double)) == 0;
    });
    return same;
  }

  /// Gathers a column in a second file, and writes it from there.
  void write_column(std::size_t column, const std::string& name) {
    const Scratch gathered = scratch();
    for_pieces(column, [&](std::size_t, const std::vector<double>& piece) {
      if (std::fwrite(piece.data(), sizeof(double), piece.size(), gathered.get()) != piece.size()) fail();
    });
    if (std::fflush(gathered.get()) != 0) fail();
    std::size_t size[2] = {count_, 1};
    const std::size_t bytes = count_ * sizeof(double);
    void* const data = bytes == 0 ? nullptr : ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, fileno(gathered.get()), 0);
    if (data == MAP_FAILED) fail();
    const auto unmap = [bytes](void* mapped) { ::munmap(mapped, bytes); };
    const std::unique_ptr<void, decltype(unmap)> mapped(data, unmap);
    write(Variable(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, data, MAT_F_DONT_COPY_DATA)));
  }

  const Layout layout_;
  const std::string path_;
  mat_t* mat_ = nullptr;
  Scratch rows_;
  std::vector<std::size_t> pieces_;  ///< rows in each
  std::size_t count_ = 0;
  std::vector<std::map<std::string, std::size_t>> codes_;  ///< of each column of text
};

/// The numbers of a vector or of each column of a matrix, as `name`, or as `name_1`, `name_2`, ...
struct NamedColumn {
  std::string name;
  std::vector<double> numbers;
};

template <class Number>
void append(std::vector<double>& numbers, const void* data, std::size_t from, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) numbers.push_back(static_cast<double>(static_cast<const Number*>(data)[from + k]));
}

/// Part of a variable as numbers; false for a type that has none.
bool append_numbers(const matvar_t& variable, std::size_t from, std::size_t count, std::vector<double>& numbers) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE: append<double>(numbers, variable.data, from, count); return true;
    case MAT_C_SINGLE: append<float>(numbers, variable.data, from, count); return true;
    case MAT_C_INT8: append<std::int8_t>(numbers, variable.data, from, count); return true;
    case MAT_C_UINT8: append<std::uint8_t>(numbers, variable.data, from, count); return true;
    case MAT_C_INT16: append<std::int16_t>(numbers, variable.data, from, count); return true;
    case MAT_C_UINT16: append<std::uint16_t>(numbers, variable.data, from, count); return true;
    case MAT_C_INT32: append<std::int32_t>(numbers, variable.data, from, count); return true;
    case MAT_C_UINT32: append<std::uint32_t>(numbers, variable.data, from, count); return true;
    default: return false;
  }
}

void add_columns(const matvar_t& variable, std::vector<NamedColumn>& columns) {
  if (variable.rank != 2 || variable.isComplex || !variable.data) return;
  const bool vector = variable.dims[0] == 1 || variable.dims[1] == 1;
  const std::size_t rows = vector ? variable.dims[0] * variable.dims[1] : variable.dims[0], count = vector ? 1 : variable.dims[1];
  for (std::size_t k = 0; k < count; ++k) {
    NamedColumn column{variable.name + (vector ? "" : "_" + std::to_string(k + 1)), {}};
    if (append_numbers(variable, k * rows, rows, column.numbers)) columns.push_back(std::move(column));
  }
}

/// The texts of a cell array; empty if it has something else.
std::vector<std::string> texts_of(mat_t* mat, const char* name) {
  const Variable cell(Mat_VarRead(mat, name));
  std::vector<std::string> texts;
  if (!cell || cell->class_type != MAT_C_CELL) return texts;
  for (std::size_t k = 0; k < cell->dims[0] * cell->dims[1]; ++k) {
    const matvar_t* text = Mat_VarGetCell(cell.get(), static_cast<int>(k));
    if (!text || text->class_type != MAT_C_CHAR || (text->data_type != MAT_T_UTF8 && text->data_type != MAT_T_UINT8 && text->data_type != MAT_T_INT8)) return {};
    texts.emplace_back(static_cast<const char*>(text->data), text->nbytes);
  }
  return texts;
}

bool read_as_csv(const char* path, std::string& text, std::string& why) {
  errno = 0;
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> mat(Mat_Open(path, MAT_ACC_RDONLY), &Mat_Close);
  if (!mat) {
    why = errno != 0 ? std::strerror(errno) : "it is no MAT file";
    return false;
  }
  std::vector<NamedColumn> columns;
  while (const Variable variable{Mat_VarReadNext(mat.get())}) add_columns(*variable, columns);
  std::map<std::size_t, std::size_t> frequency;  // of each length
  for (const NamedColumn& column : columns) ++frequency[column.numbers.size()];
  const auto most = std::max_element(frequency.begin(), frequency.end(), [](const auto& a, const auto& b) { return a.second <= b.second; });
  const std::size_t rows = most == frequency.end() ? 0 : most->first;
  std::erase_if(columns, [rows](const NamedColumn& column) { return column.numbers.size() != rows; });
  if (columns.empty() || rows == 0) {
    why = "it has no vector of numbers";
    return false;
  }
  // A file of rheonet has the names of records, and their units.
  const std::vector<std::string> names = texts_of(mat.get(), "columns"), units = texts_of(mat.get(), "units");
  if (names.size() == columns.size() && units.size() == columns.size()) {
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].name = names[k] + (units[k].empty() ? "" : " [" + units[k] + "]");
  }
  for (std::size_t k = 0; k < columns.size(); ++k) text += (k > 0 ? ",\"" : "\"") + columns[k].name + '"';
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    char number[32];  // 17 digits, sign, point and exponent
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto written = std::to_chars(number, number + sizeof number, columns[k].numbers[row]);
      if (k > 0) text += ',';
      text.append(number, written.ptr);
    }
    text += '\n';
  }
  return true;
}

}  // namespace
}  // namespace rheonet::tables

extern "C" __attribute__((visibility("default"))) bool table_text(const char* path, std::string& text, std::string& why) {
  return rheonet::tables::read_as_csv(path, text, why);
}

extern "C" __attribute__((visibility("default"))) rheonet::tables::TableFile* open_table_file(const char* path, const rheonet::tables::Layout& layout) {
  return new rheonet::tables::MatFile(path, layout);
}
