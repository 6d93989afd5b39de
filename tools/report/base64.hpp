#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace rheonet::report {

/// Bytes as text: the alphabet with + and /, and padding (RFC 4648, section 4).
std::string base64(std::span<const std::byte> bytes);

}  // namespace rheonet::report
