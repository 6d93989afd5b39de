#include "tools/report/base64.hpp"

#include <doctest/doctest.h>

#include <span>
#include <string_view>

namespace rheonet::test::base64_test {

TEST_CASE("the texts of RFC 4648, section 10, and bytes beyond ASCII") {
  const auto of = [](std::string_view text) { return report::base64(std::as_bytes(std::span(text))); };
  CHECK(of("") == "");
  CHECK(of("f") == "Zg==");
  CHECK(of("fo") == "Zm8=");
  CHECK(of("foo") == "Zm9v");
  CHECK(of("foob") == "Zm9vYg==");
  CHECK(of("fooba") == "Zm9vYmE=");
  CHECK(of("foobar") == "Zm9vYmFy");
  CHECK(of("\xfb\xff\xfe") == "+//+");
}

}  // namespace rheonet::test::base64_test
