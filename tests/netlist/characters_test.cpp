#include "core/netlist/characters.hpp"

#include <doctest/doctest.h>

namespace rheonet::test::characters_test {

TEST_CASE("UTF-8 of one to four bytes is decoded and encoded again") {
  const std::string text = "aµ\u07FF\u0800∞\uFFFD\U00010000😀\U0010FFFF";
  CHECK(decode(text) == U"aµ\u07FF\u0800∞\uFFFD\U00010000😀\U0010FFFF");
  CHECK(encode(decode(text)) == text);
  CHECK(count_characters("2 µm") == 4);
}

TEST_CASE("what a terminal would act upon is escaped, what it shows is not") {
  CHECK(printable("2 µm ∞ 😀 \\") == "2 µm ∞ 😀 \\");
  CHECK(printable("a\x1B[31mb\nc\td\re\x7F") == "a\\u001B[31mb\\nc\\td\\re\\u007F");
  CHECK(printable("\u009B2J \u202Eback\u2066\u2028\u200F") == "\\u009B2J \\u202Eback\\u2066\\u2028\\u200F");
  CHECK(printable(std::string("\0x\xFFy", 4)) == "\\u0000x\\xFFy");
  for (const char32_t shown : {U' ', U'~', U'\u00A0', U'\u200D', U'\uFFFD', U'\U0010FFFF'}) CHECK(is_printable(shown));
}

TEST_CASE("bytes that are not UTF-8 are one character each and survive") {
  for (const std::string text : {"a\xFFz", "\xC2", "\xB5m", "\xE2\x88", "x\xE2\x88y", "\xF0\x9F\x98", "\xC0\x80"}) {
    CHECK(count_characters(text) == text.size());
    CHECK(encode(decode(text)) == text);
  }
}

}  // namespace rheonet::test::characters_test
