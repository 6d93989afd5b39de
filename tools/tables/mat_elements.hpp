#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tools/tables/mat_format.hpp"

/// The elements of a MAT file of level 5, and the arrays that they make up. Every size is compared with the bytes that are left before it is used.
namespace rheonet::tables::mat {

/// Sizes in the file that contradict each other. The text continues "it is damaged or cut: ".
struct Damage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class Number>
Number load(const char* from, bool is_swapped) {
  char bytes[sizeof(Number)];
  std::memcpy(bytes, from, sizeof bytes);
  if (is_swapped) std::reverse(bytes, bytes + sizeof bytes);
  return std::bit_cast<Number>(bytes);
}

/// Bytes of a number of this type; 0 for a type that is no number.
std::size_t size_of(Type type);

double load_number(Type type, const char* from, bool is_swapped);

/// Whether a class may store its numbers as this type: a writer shortens numbers whose values allow it.
bool can_store(Class stored, Type type);

struct Element {
  Type type;
  std::string_view bytes;
};

/// The elements that a matrix consists of, one after the other.
class Elements {
 public:
  Elements(std::string_view bytes, bool is_swapped) : rest_(bytes), is_swapped_(is_swapped) {}

  bool has_more() const { return !rest_.empty(); }

  Element next() {
    const auto word = load<std::uint32_t>(take(4).data(), is_swapped_);
    if (const std::uint32_t small_size = word >> 16; small_size != 0) {
      if (small_size > 4) throw Damage("a small element has more than 4 bytes");
      return {static_cast<Type>(word & 0xFFFFU), take(4).substr(0, small_size)};
    }
    const std::string_view bytes = take(load<std::uint32_t>(take(4).data(), is_swapped_));
    const std::size_t padding = (8 - bytes.size() % 8) % 8;
    rest_.remove_prefix(std::min(padding, rest_.size()));  // Some writers do not pad the last element.
    return {static_cast<Type>(word), bytes};
  }

  /// An element of one of these types.
  std::string_view next(std::initializer_list<Type> types, const char* what) {
    const Element element = next();
    if (std::find(types.begin(), types.end(), element.type) == types.end()) throw Damage(std::string("an unknown type stands in place of ") + what);
    return element.bytes;
  }

  void skip_rest() {
    while (has_more()) next();
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw Damage("an element is longer than what contains it");
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }

  std::string_view rest_;
  bool is_swapped_;
};

/// A variable, or a cell of one.
struct Array {
  Class type;
  bool is_complex;
  std::vector<std::size_t> size;
  std::string name;
  Elements data;

  /// Product of the sizes. As a double it does not overflow, and it is exact where it equals a number of bytes.
  double entries() const {
    double product = 1;
    for (const std::size_t length : size) product *= static_cast<double>(length);
    return product;
  }
};

/// Absent for an empty array without a head, which MATLAB writes for an empty cell, and for classes whose head differs. Throws Damage, as do all below.
std::optional<Array> array_of(std::string_view bytes, bool is_swapped);

/// The texts of a cell array in UTF-8; empty if it contains anything else.
std::vector<std::string> texts_of(Array cells, bool is_swapped);

}  // namespace rheonet::tables::mat
