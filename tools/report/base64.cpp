#include "tools/report/base64.hpp"

#include <cstdint>

namespace rheonet::report {
namespace {

constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Four digits for three bytes, of which those that are not given are 0.
void encode_group(char* out, std::uint32_t first, std::uint32_t second = 0, std::uint32_t third = 0) {
  out[0] = digits[first >> 2];
  out[1] = digits[(first << 4 | second >> 4) & 63];
  out[2] = digits[(second << 2 | third >> 6) & 63];
  out[3] = digits[third & 63];
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  const auto byte = [in = bytes.data()](std::size_t i) { return std::to_integer<std::uint32_t>(in[i]); };
  const std::size_t left = bytes.size() % 3, whole = bytes.size() - left;
  for (std::size_t i = 0; i < whole; i += 3, out += 4) encode_group(out, byte(i), byte(i + 1), byte(i + 2));
  if (left == 0) return text;
  encode_group(out, byte(whole), left == 2 ? byte(whole + 1) : 0);
  text.replace(text.size() - (3 - left), 3 - left, 3 - left, '=');
  return text;
}

}  // namespace rheonet::report
