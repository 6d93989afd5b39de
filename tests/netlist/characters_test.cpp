#include "core/netlist/characters.hpp"

#include <doctest/doctest.h>

using namespace rheonet;

TEST_CASE("UTF-8 of one to four bytes is decoded and encoded again") {
  const std::string text = "aµ\u07FF\u0800∞\uFFFD\U00010000😀\U0010FFFF";
  CHECK(decode(text) == U"aµ\u07FF\u0800∞\uFFFD\U00010000😀\U0010FFFF");
  CHECK(encode(decode(text)) == text);
  CHECK(count_characters("2 µm") == 4);
}

TEST_CASE("bytes that are not UTF-8 are one character each and survive") {
  for (const std::string text : {"a\xFFz", "\xC2", "\xB5m", "\xE2\x88", "x\xE2\x88y", "\xF0\x9F\x98", "\xC0\x80"}) {
    CHECK(count_characters(text) == text.size());
    CHECK(encode(decode(text)) == text);
  }
}
