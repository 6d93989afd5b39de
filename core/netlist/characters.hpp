#pragma once

#include <string>
#include <string_view>

namespace rheonet {

/// Decode UTF-8 to code points, and encode it again. A byte that is not UTF-8 becomes one character.
std::u32string decode(std::string_view text);
std::string encode(std::u32string_view characters);

/// Whether a terminal shows the character as itself: false for control characters (tabs too), for characters that change
/// the direction of the text and for bytes that are not UTF-8.
bool is_printable(char32_t character);
/// The text on one line: every character that is not printable is escaped as in TOML (a byte that is not UTF-8 as \xFF).
std::string printable(std::string_view text);

/// Removes the byte order mark that some programs, as Excel, write at the beginning of a file.
void drop_byte_order_mark(std::string& text);

/// A letter of any alphabet. Every byte of a character outside ASCII counts as a letter: none has a meaning of its own in a
/// path or an expression.
bool is_letter(char c);
bool is_digit(char c);

/// Number of bytes of the name at the start of the text, 0 if there is none: a letter or `_`, then also digits. A path
/// (`k1.force`, `chain.0.force`) is one name.
std::size_t name_length(std::string_view text);

/// Number of characters (code points) of a text. Positions in messages count characters, not bytes.
std::size_t count_characters(std::string_view text);

}  // namespace rheonet
