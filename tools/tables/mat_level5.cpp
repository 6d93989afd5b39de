#define ZLIB_CONST  // zlib does not change its input.
#include <zlib.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <system_error>

#include "tools/tables/mat_elements.hpp"
#include "tools/tables/mat_table.hpp"

namespace rheonet::tables {
namespace {

using mat::Array;
using mat::Class;
using mat::Damage;
using mat::Element;
using mat::Type;

/// Numbers that a table may have, 1 GB, unless the file is larger itself: a compressed file of 1 MB can claim as many.
constexpr std::uint64_t most_numbers = 1U << 27;
/// Memory that a column takes besides its numbers, in numbers.
constexpr std::uint64_t column_overhead = 16;
/// Bytes that a compressed byte can stand for: a match of 258 bytes takes 2 bits (RFC 1951).
constexpr std::uint64_t most_inflated_per_byte = 1032;

/// Whether these are the first bytes of a file of level 4: its type, of four decimal digits at most, has a zero among its bytes.
bool is_level4(const std::string& head) {
  constexpr std::size_t level4_head_size = 20;
  constexpr std::uint32_t most_type = 4052;  // byte order, 0, type of number, kind of matrix
  if (head.size() < level4_head_size) return false;
  for (const bool is_swapped : {false, true}) {
    const auto type = mat::load<std::uint32_t>(head.data(), is_swapped), has_imaginary = mat::load<std::uint32_t>(head.data() + 12, is_swapped);
    if (type <= most_type && has_imaginary <= 1) return true;
  }
  return false;
}

class Level5File {
 public:
  explicit Level5File(const char* path) : file_(path, std::ios::binary) {
    std::error_code error;
    if (!file_) throw MatError(std::generic_category().message(errno != 0 ? errno : EIO));
    size_ = std::filesystem::file_size(path, error);
    if (error) throw MatError(error.message());
    budget_ = std::max(most_numbers, size_);
    read_header();
  }

  MatTable read() {
    while (at_ < size_) {
      const std::uint64_t begin = at_;
      try {
        const std::string tag = bytes(mat::tag_size);
        const std::string element = bytes(mat::load<std::uint32_t>(tag.data() + 4, is_swapped_));
        switch (mat::load<Type>(tag.data(), is_swapped_)) {
          case Type::matrix: add(element); break;
          case Type::compressed: add(inflated(element)); break;
          default: throw Damage("it is neither an array nor compressed");
        }
      } catch (const Damage& damage) {
        throw MatError("it is damaged or cut: in the variable at byte " + std::to_string(begin) + ", " + damage.what());
      }
    }
    return std::move(table_);
  }

 private:
  /// The next bytes of the file.
  std::string bytes(std::uint64_t size) {
    if (size > size_ - at_) throw Damage("the file ends before it");
    std::string result(size, '\0');
    if (!file_.read(result.data(), static_cast<std::streamsize>(size))) throw Damage("the file ends before it");  // It became shorter meanwhile.
    at_ += size;
    return result;
  }

  void read_header() {
    const std::string head = bytes(std::min<std::uint64_t>(size_, mat::header_size));
    table_.of_rheonet = head.starts_with(mat::header_text + std::string("rheonet "));
    if (is_level4(head)) throw MatError("it is a MAT file of level 4; save it as level 5: `save -v7` in MATLAB, scipy.io.savemat(..., format=\"5\")");
    if (head.size() < mat::header_size) throw MatError(head.starts_with("MATLAB 5.0") ? "it is damaged or cut: its header is not complete" : "it is no MAT file");
    const char* const version = head.data() + mat::header_text_size;
    const auto order = mat::load<std::uint16_t>(version + sizeof(std::uint16_t), false);
    is_swapped_ = order != mat::byte_order;
    if (mat::load<std::uint16_t>(version + sizeof(std::uint16_t), is_swapped_) != mat::byte_order) throw MatError("it is no MAT file");
    if (mat::load<std::uint16_t>(version, is_swapped_) != mat::version) throw MatError("it is damaged, or a MAT file of an unknown version");
  }

  /// The data of a compressed element: one element, whose tag has the size.
  std::string inflated(const std::string& deflated) const {
    z_stream stream{};
    if (::inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, decltype(&::inflateEnd)> end(&stream, &::inflateEnd);
    stream.next_in = reinterpret_cast<const Bytef*>(deflated.data());
    stream.avail_in = static_cast<uInt>(deflated.size());
    const auto inflate_to = [&](char* to, std::size_t size) {
      stream.next_out = reinterpret_cast<Bytef*>(to);
      stream.avail_out = static_cast<uInt>(size);
      return ::inflate(&stream, Z_NO_FLUSH);
    };
    char tag[mat::tag_size] = {};
    const int begun = inflate_to(tag, sizeof tag);
    if ((begun != Z_OK && begun != Z_STREAM_END) || stream.avail_out != 0) throw Damage("the compressed data cannot be inflated");
    if (mat::load<Type>(tag, is_swapped_) != Type::matrix) throw Damage("the compressed data are no array");
    const std::uint64_t size = mat::load<std::uint32_t>(tag + 4, is_swapped_);
    if (size > most_inflated_per_byte * deflated.size()) throw Damage("the compressed data are too few for the size of the array");
    if (size > sizeof(double) * budget_) throw too_large();
    std::string result(size + 1, '\0');  // With the byte too many, zlib comes to the check sum at the end.
    if (inflate_to(result.data(), result.size()) != Z_STREAM_END || stream.avail_out != 1 || stream.avail_in != 0)
      throw Damage("the compressed data are damaged, or of a different size");
    result.pop_back();
    return result;
  }

  /// Adds a variable to the table if it is a matrix of real numbers, or has names or units.
  void add(const std::string& variable) {
    std::optional<Array> array = mat::array_of(variable, is_swapped_);
    if (!array) return;
    const bool is_number = array->type >= Class::float64 && array->type <= Class::uint64;
    if (is_number && !array->is_complex) return add_numbers(*array);
    if (array->type == Class::cell && array->name == "columns")
      table_.names = mat::texts_of(std::move(*array), is_swapped_);
    else if (array->type == Class::cell && array->name == "units")
      table_.units = mat::texts_of(std::move(*array), is_swapped_);
    else
      array->data.skip_rest();
  }

  void add_numbers(Array& array) {
    if (array.entries() == 0 && !array.data.has_more()) return;
    const Element data = array.data.next();
    if (!mat::can_store(array.type, data.type)) throw Damage("`" + array.name + "` has numbers of an unknown type");
    const std::size_t size = mat::size_of(data.type);
    if (array.data.has_more() || static_cast<double>(data.bytes.size()) != array.entries() * static_cast<double>(size))
      throw Damage("`" + array.name + "` has a different number of bytes from its size");
    // An array without a name contains objects of MATLAB.
    if (array.name.empty() || data.bytes.empty() || array.size.size() != 2) return;
    const std::uint64_t rows = array.size[0], columns = array.size[1];
    const std::uint64_t needed = rows * columns + column_overhead * (rows == 1 ? 1 : columns);
    if (needed > budget_) throw too_large();
    budget_ -= needed;
    add_columns(table_, array.name, rows, columns, [&](std::size_t k) { return mat::load_number(data.type, data.bytes.data() + k * size, is_swapped_); });
  }

  static MatError too_large() {
    return MatError("its variables are too large for a table: more than " + std::to_string(most_numbers) + " numbers; save the vectors of the table alone");
  }

  std::ifstream file_;
  std::uint64_t size_ = 0, at_ = 0;  // bytes
  std::uint64_t budget_ = 0;         // numbers that may still be added
  bool is_swapped_ = false;
  MatTable table_;
};

}  // namespace

MatTable read_level5(const char* path) {
  errno = 0;
  return Level5File(path).read();
}

}  // namespace rheonet::tables
