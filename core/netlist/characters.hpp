#pragma once

#include <string>
#include <string_view>

namespace rheonet {

/// UTF-8 to code points and back. A byte that is not UTF-8 becomes one character, so that positions stay countable.
std::u32string decode(std::string_view text);
std::string encode(std::u32string_view characters);

/// Number of characters (code points) of a text: positions in messages count these, not bytes.
std::size_t count_characters(std::string_view text);

}  // namespace rheonet
