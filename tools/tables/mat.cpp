#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "tools/tables/mat_format.hpp"
#include "tools/tables/mat_table.hpp"
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

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

void put(std::FILE* file, const void* bytes, std::size_t size) {
  if (std::fwrite(bytes, 1, size, file) != size) fail();
}

/// A temporary file without a name beside another one, whose disk has to have room for the same numbers.
File scratch_beside(const std::string& path) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::read_symlink(path, error);  // `path` may be that of a descriptor, in /proc.
  std::string name = ((error ? std::filesystem::path(path) : file).parent_path() / ".rheonet-XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) fail();
  ::unlink(name.c_str());
  File scratch(::fdopen(descriptor, "w+"));
  if (!scratch) fail();
  return scratch;
}

using mat::Class;
using mat::tag_size;
using mat::Type;

std::size_t padded(std::size_t size) { return (size + 7) / 8 * 8; }

void put_tag(std::FILE* file, Type type, std::size_t size) {
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    errno = EFBIG;
    fail();
  }
  const std::uint32_t tag[] = {static_cast<std::uint32_t>(type), static_cast<std::uint32_t>(size)};
  put(file, tag, sizeof tag);
}

void put_element(std::FILE* file, Type type, const std::string& bytes) {
  put_tag(file, type, bytes.size());
  const std::string filled = bytes + std::string(padded(bytes.size()) - bytes.size(), '\0');
  put(file, filled.data(), filled.size());
}

/// The size of a matrix in the file. `content` is the size of what follows its head.
std::size_t matrix_size(const std::string& name, std::size_t content) { return 4 * tag_size + tag_size + padded(name.size()) + content; }

/// The head of a matrix with `rows` x `columns` entries.
void put_head(std::FILE* file, Class type, std::size_t rows, std::size_t columns, const std::string& name, std::size_t content) {
  put_tag(file, Type::matrix, matrix_size(name, content));
  const std::uint32_t flags[] = {static_cast<std::uint32_t>(type), 0};
  put_tag(file, Type::uint32, sizeof flags);
  put(file, flags, sizeof flags);
  const std::int32_t size[] = {static_cast<std::int32_t>(rows), static_cast<std::int32_t>(columns)};
  put_tag(file, Type::int32, sizeof size);
  put(file, size, sizeof size);
  put_element(file, Type::int8, name);
}

void put_text(std::FILE* file, const std::string& name, const std::string& text) {
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  put_head(file, Class::text, text.empty() ? 0 : 1, static_cast<std::size_t>(characters), name, tag_size + padded(text.size()));
  put_element(file, Type::utf8, text);
}

/// The cells of an array of texts, in a temporary file.
class Cells {
 public:
  explicit Cells(File file) : file_(std::move(file)) {}

  /// Returns the index, from 1.
  std::size_t add(const std::string& text) {
    put_text(file_.get(), "", text);
    return ++count_;
  }

  void put_array(std::FILE* file, const std::string& name) const {
    const long bytes = std::ftell(file_.get());
    if (bytes < 0 || std::fflush(file_.get()) != 0) fail();
    put_head(file, Class::cell, count_, 1, name, static_cast<std::size_t>(bytes));
    std::rewind(file_.get());
    std::vector<char> piece(1 << 16);
    for (std::size_t read = 0; (read = std::fread(piece.data(), 1, piece.size(), file_.get())) > 0;) put(file, piece.data(), read);
    if (std::ferror(file_.get()) != 0) fail();
  }

 private:
  File file_;
  std::size_t count_ = 0;
};

/// MAT 5, which MATLAB, Octave and SciPy read. A column is a vector of that name; text is a vector of numbers, each the place of the text in
/// the cell array NAME_texts, 0 for none. A vector begins with its length, so the rows wait in a temporary file, and the memory does
/// not grow with their number. 
class MatFile : public TableFile {
 public:
  MatFile(const char* path, const Layout& layout)
      : layout_(layout), path_(path), file_(std::fopen(path, "wb")), rows_(scratch_beside(path)), texts_(layout.columns.size()) {
    if (!file_) fail();
  }

  void append(const Rows& rows) override {
    pieces_.push_back(rows.count);
    count_ += rows.count;
    for (std::size_t k = 0; k < layout_.columns.size(); ++k) {
      std::vector<double> numbers = rows.numbers[k];
      for (const std::string& text : rows.texts[k]) numbers.push_back(index(k, text));
      put(rows_.get(), numbers.data(), numbers.size() * sizeof(double));
    }
  }

  void close() override {
    put_header();
    std::set<std::string> used{"title", "source", "columns", "units"};
    Cells units(scratch_beside(path_)), titles(scratch_beside(path_));
    if (std::fflush(rows_.get()) != 0) fail();
    for (std::size_t k = 0; k < layout_.columns.size(); ++k) {
      const std::string name = allowed(layout_.columns[k].name, used);
      titles.add(layout_.columns[k].name);
      units.add(layout_.columns[k].unit);
      put_column(k, name);
      if (layout_.columns[k].kind != Column::Kind::text) continue;
      if (!texts_[k].cells) texts_[k].cells.emplace(scratch_beside(path_));
      texts_[k].cells->put_array(file_.get(), allowed(name + "_texts", used));
    }
    put_text(file_.get(), "title", layout_.title);
    put_text(file_.get(), "source", layout_.program);
    titles.put_array(file_.get(), "columns");
    units.put_array(file_.get(), "units");
    if (std::fclose(file_.release()) != 0) fail();
  }

 private:
  /// The different texts of a column.
  struct Texts {
    std::map<std::string, std::size_t> indices;
    std::optional<Cells> cells;
  };

  double index(std::size_t column, const std::string& text) {
    constexpr std::size_t most_known = 10'000;  // A text that is not known any more is written again.
    if (text.empty()) return 0;
    Texts& texts = texts_[column];
    const auto known = texts.indices.find(text);
    if (known != texts.indices.end()) return static_cast<double>(known->second);
    if (!texts.cells) texts.cells.emplace(scratch_beside(path_));
    if (texts.indices.size() == most_known) texts.indices.clear();
    return static_cast<double>(texts.indices[text] = texts.cells->add(text));
  }

  void put_header() {
    std::string text = mat::header_text + layout_.program;
    text.resize(mat::header_text_size, ' ');
    put(file_.get(), text.data(), text.size());
    const std::uint16_t version_and_order[] = {mat::version, mat::byte_order};
    put(file_.get(), version_and_order, sizeof version_and_order);
  }

  void put_column(std::size_t column, const std::string& name) {
    const std::size_t columns = layout_.columns.size(), bytes = count_ * sizeof(double);
    put_head(file_.get(), Class::float64, count_, 1, name, tag_size + bytes);
    put_tag(file_.get(), Type::float64, bytes);
    std::size_t before = 0;  // rows
    std::vector<double> piece;
    for (const std::size_t count : pieces_) {
      piece.resize(count);
      const auto place = static_cast<off_t>((before * columns + column * count) * sizeof(double));
      const auto size = static_cast<ssize_t>(count * sizeof(double));
      if (::pread(fileno(rows_.get()), piece.data(), static_cast<std::size_t>(size), place) != size) fail();
      put(file_.get(), piece.data(), static_cast<std::size_t>(size));
      before += count;
    }
  }

  const Layout layout_;
  const std::string path_;
  File file_, rows_;
  std::vector<std::size_t> pieces_;  ///< Rows in each.
  std::size_t count_ = 0;
  std::vector<Texts> texts_;  ///< Of each column.
};

}  // namespace
}  // namespace rheonet::tables

extern "C" __attribute__((visibility("default"))) bool table_text(const char* path, std::string& text, std::string& why) {
  return rheonet::tables::table_text(&rheonet::tables::read_level5, path, text, why);
}

extern "C" __attribute__((visibility("default"))) rheonet::tables::TableFile* open_table_file(const char* path, const rheonet::tables::Layout& layout) {
  return new rheonet::tables::MatFile(path, layout);
}
