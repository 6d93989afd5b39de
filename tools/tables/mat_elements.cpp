#include "tools/tables/mat_elements.hpp"

namespace rheonet::tables::mat {

namespace {

/// Whether a text is UTF-8 (RFC 3629) without control characters.
bool is_line(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t k) { return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U; };
    const unsigned first = byte(0), second = byte(1);
    const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (length == 0 || first < ' ') return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(k) & 0xC0U) != 0x80U) return false;
    // Longer than need be, a surrogate, or beyond the last character.
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) || (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90)) return false;
    at += length;
  }
  return true;
}

}  // namespace

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int8: case Type::uint8: return 1;
    case Type::int16: case Type::uint16: return 2;
    case Type::int32: case Type::uint32: case Type::float32: return 4;
    case Type::int64: case Type::uint64: case Type::float64: return 8;
    default: return 0;
  }
}

double load_number(Type type, const char* from, bool is_swapped) {
  switch (type) {
    case Type::int8: return load<std::int8_t>(from, is_swapped);
    case Type::uint8: return load<std::uint8_t>(from, is_swapped);
    case Type::int16: return load<std::int16_t>(from, is_swapped);
    case Type::uint16: return load<std::uint16_t>(from, is_swapped);
    case Type::int32: return load<std::int32_t>(from, is_swapped);
    case Type::uint32: return load<std::uint32_t>(from, is_swapped);
    case Type::float32: return load<float>(from, is_swapped);
    case Type::int64: return static_cast<double>(load<std::int64_t>(from, is_swapped));
    case Type::uint64: return static_cast<double>(load<std::uint64_t>(from, is_swapped));
    default: return load<double>(from, is_swapped);
  }
}

bool can_store(Class stored, Type type) {
  if (type == Type::float32 || type == Type::float64) return stored == Class::float64 || stored == Class::float32;
  if (type == Type::int64 || type == Type::uint64) return stored == Class::int64 || stored == Class::uint64;
  return size_of(type) > 0;
}

std::optional<Array> array_of(std::string_view bytes, bool is_swapped) {
  Elements elements(bytes, is_swapped);
  if (!elements.has_more()) return {};
  const std::string_view flags = elements.next({Type::uint32}, "the flags of an array");
  if (flags.size() != 8) throw Damage("the flags of an array do not have 8 bytes");
  const auto word = load<std::uint32_t>(flags.data(), is_swapped);
  Array array{static_cast<Class>(word & 0xFFU), (word & mat::is_complex) != 0, {}, {}, elements};
  if (array.type < Class::cell || array.type > Class::opaque) throw Damage("an array has an unknown class");
  if (array.type >= Class::function) {
    elements.skip_rest();
    return {};
  }
  const std::string_view size = elements.next({Type::int32, Type::uint32}, "the size of an array");
  if (size.size() < 8 || size.size() % 4 != 0) throw Damage("an array has less than two dimensions");
  for (std::size_t at = 0; at < size.size(); at += 4) {
    const auto length = load<std::int32_t>(size.data() + at, is_swapped);
    if (length < 0) throw Damage("an array has a negative size");
    array.size.push_back(static_cast<std::size_t>(length));
  }
  array.name = elements.next({Type::int8, Type::uint8, Type::utf8}, "the name of an array");
  if (!is_line(array.name)) throw Damage("a name is not readable text");
  array.data = elements;
  return array;
}

namespace {

/// UTF-16, as MATLAB writes it, in UTF-8.
std::string utf8_of(std::string_view units, bool is_swapped) {
  std::string text;
  for (std::size_t at = 0; at + 2 <= units.size(); at += 2) {
    std::uint32_t code = load<std::uint16_t>(units.data() + at, is_swapped);
    if (code >= 0xD800 && code < 0xDC00 && at + 4 <= units.size()) {
      at += 2;
      code = 0x10000 + ((code - 0xD800) << 10) + (load<std::uint16_t>(units.data() + at, is_swapped) & 0x3FFU);
    }
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // bytes after the first
    constexpr std::uint32_t first[] = {0, 0xC0, 0xE0, 0xF0};
    text += static_cast<char>(first[more] | (code >> (6 * more)));
    for (int k = more - 1; k >= 0; --k) text += static_cast<char>(0x80U | ((code >> (6 * k)) & 0x3FU));
  }
  return text;
}

/// The text of a cell; absent if it contains something else, or more than a line.
std::optional<std::string> text_of(std::string_view bytes, bool is_swapped) {
  std::optional<Array> cell = array_of(bytes, is_swapped);
  if (!cell || cell->type != Class::text) return {};
  if (cell->entries() == 0) return "";
  const Element data = cell->data.next();
  const bool is_utf16 = data.type == Type::uint16 || data.type == Type::utf16;
  const auto is_character = [&](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  // Programs differ in whether the size of UTF-8 counts characters or bytes.
  const auto most = static_cast<double>(data.bytes.size() / (is_utf16 ? 2 : 1));
  const auto least = is_utf16 ? most : static_cast<double>(std::count_if(data.bytes.begin(), data.bytes.end(), is_character));
  if (cell->entries() < least || cell->entries() > most) throw Damage("a text has a different length from its size");
  const std::string text = is_utf16 ? utf8_of(data.bytes, is_swapped) : std::string(data.bytes);
  return is_line(text) ? std::optional(text) : std::nullopt;
}

}  // namespace

std::vector<std::string> texts_of(Array cells, bool is_swapped) {
  std::vector<std::string> texts;
  bool are_texts = true;
  std::size_t count = 0;
  for (; cells.data.has_more(); ++count) {
    auto text = text_of(cells.data.next({Type::matrix}, "a cell"), is_swapped);
    are_texts = are_texts && text;
    if (are_texts) texts.push_back(std::move(*text));
  }
  if (static_cast<double>(count) != cells.entries()) throw Damage("`" + cells.name + "` has a different number of cells from its size");
  return are_texts ? texts : std::vector<std::string>{};
}

}  // namespace rheonet::tables::mat
