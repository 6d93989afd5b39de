#include "tests/wiring/refusals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rheonet::test {

bool says(const std::string& message, const Refusal& refusal) {
  return std::any_of(refusal.words.begin(), refusal.words.end(),
                     [&](const char* words) { return message.find(words) != std::string::npos; });
}

double time_in(const std::string& message) {
  const std::size_t at = message.find("t = ");
  return at == std::string::npos ? std::nan("") : std::strtod(message.c_str() + at + 4, nullptr);
}

}  // namespace rheonet::test
