#pragma once

#include <string>
#include <string_view>

namespace rheonet {

/// UTF-8 to code points and back. A byte that is not UTF-8 becomes one character, so that positions stay countable.
std::u32string decode(std::string_view text);
std::string encode(std::u32string_view characters);

/// Whether a terminal shows a character as itself: no control character (a tab is one), none that turns the direction of
/// the text around it, no stray byte.
bool is_printable(char32_t character);
/// A text with each character that is not printable escaped as TOML would have it (a stray byte as \xFF), and so on one
/// line.
std::string printable(std::string_view text);

/// A letter of any alphabet: every byte of a character outside ASCII counts as one, since none has a meaning in a path or
/// an expression.
bool is_letter(char c);
bool is_digit(char c);

/// Number of characters (code points) of a text: positions in messages count these, not bytes.
std::size_t count_characters(std::string_view text);

}  // namespace rheonet
