#pragma once

// std::from_chars for floating-point numbers, which the C++ library of this compiler lacks.
#include <charconv>
#include <cmath>
#include <fast_float/fast_float.h>

namespace std {

/// As the standard says: a number beyond the range of double is an error, and leaves `value` as it is.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  double read = 0;
  const fast_float::from_chars_result result = fast_float::from_chars(first, last, read);
  if (result.ec != errc{}) return {result.ptr, result.ec};
  // fast_float gives infinity or 0 for a number that is too large or too small.
  const auto significant = [&] {
    for (const char* c = first; c != result.ptr && *c != 'e' && *c != 'E'; ++c)
      if (*c >= '1' && *c <= '9') return true;
    return false;
  };
  if ((isinf(read) || read == 0) && significant()) return {result.ptr, errc::result_out_of_range};
  value = read;
  return {result.ptr, errc{}};
}

}  // namespace std
