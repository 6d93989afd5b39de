#include "core/netlist/characters.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rheonet {

namespace {

// Bytes that are not UTF-8 are mapped to these code points (surrogates, which encode no text), and back.
constexpr char32_t stray = 0xDC00;

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Number of bytes of the character that begins with `c`; 0 if none does.
std::size_t length_of_character(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80 ? 1 : byte < 0xC2 ? 0 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : byte < 0xF5 ? 4 : 0;
}

}  // namespace

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::u32string decode(std::string_view text) {
  std::u32string characters;
  characters.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = length_of_character(text[0]);
    if (bytes == 0 || bytes > text.size() ||
        !std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(bytes), continues)) {
      characters += stray + static_cast<unsigned char>(text[0]);
      text.remove_prefix(1);
      continue;
    }
    char32_t c = static_cast<unsigned char>(text[0]);
    if (bytes > 1) c &= 0x7FU >> bytes;
    for (std::size_t i = 1; i < bytes; ++i) c = c << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
    characters += c;
    text.remove_prefix(bytes);
  }
  return characters;
}

std::string encode(std::u32string_view characters) {
  std::string text;
  for (const char32_t c : characters) {
    const auto tail = [&](unsigned shift) { text += static_cast<char>(0x80U | ((c >> shift) & 0x3FU)); };
    if (c < 0x80) {
      text += static_cast<char>(c);
    } else if (c < 0x800) {
      text += static_cast<char>(0xC0U | c >> 6U);
      tail(0);
    } else if (c >= stray && c < stray + 0x100) {
      text += static_cast<char>(c - stray);
    } else if (c < 0x10000) {
      text += static_cast<char>(0xE0U | c >> 12U);
      tail(6);
      tail(0);
    } else {
      text += static_cast<char>(0xF0U | c >> 18U);
      tail(12);
      tail(6);
      tail(0);
    }
  }
  return text;
}

void drop_byte_order_mark(std::string& text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
}

bool is_printable(char32_t c) {
  const auto within = [c](char32_t first, char32_t last) { return first <= c && c <= last; };
  return !(c < 0x20 || within(0x7F, 0x9F) || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
           within(0x2066, 0x2069) || within(0xD800, 0xDFFF));
}

std::string printable(std::string_view text) {
  std::string result;
  for (const char32_t c : decode(text)) {
    if (is_printable(c)) {
      result += encode(std::u32string_view(&c, 1));
    } else if (c == U'\n') {
      result += "\\n";
    } else if (c == U'\r') {
      result += "\\r";
    } else if (c == U'\t') {
      result += "\\t";
    } else if (c >= stray && c < stray + 0x100) {
      result += fmt::format("\\x{:02X}", static_cast<unsigned>(c - stray));
    } else {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    }
  }
  return result;
}

std::size_t name_length(std::string_view text) {
  const auto within = [&](std::size_t at) { return at < text.size() && (is_letter(text[at]) || is_digit(text[at]) || text[at] == '_'); };
  if (text.empty() || is_digit(text[0]) || !within(0)) return 0;
  std::size_t end = 1;
  while (within(end) || (end < text.size() && text[end] == '.' && within(end + 1))) ++end;
  return end;
}

std::size_t count_characters(std::string_view text) { return decode(text).size(); }

}  // namespace rheonet
