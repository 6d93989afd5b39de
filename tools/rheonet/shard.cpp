#include "tools/rheonet/shard.hpp"

#include <fmt/format.h>

#include <charconv>

#include "tools/rheonet/option_values.hpp"

namespace rheonet::tool {

Shard read_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool divided = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto of = divided ? std::from_chars(number.ptr + 1, end, shard.of) : number;
  if (!divided || of.ec != std::errc() || of.ptr != end)
    throw WrongCommandLine{fmt::format("`--shard {}` is not K/N", text), "--shard 3/64 simulates the third of 64 parts"};
  if (shard.of < 1 || shard.of > most_shards)
    throw WrongCommandLine{fmt::format("`--shard {}`: the number of shards must be from 1 to {}", text, most_shards), ""};
  if (shard.number < 1 || shard.number > shard.of)
    throw WrongCommandLine{fmt::format("`--shard {}`: the shards are numbered from 1 to {}", text, shard.of), ""};
  return shard;
}

}  // namespace rheonet::tool
