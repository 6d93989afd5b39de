#include "tools/rheonet/order_statistics.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <map>
#include <system_error>

namespace rheonet::tool {
namespace {

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category(), "a temporary file for the quantiles"); }

constexpr std::uint64_t sign = std::uint64_t{1} << 63U;

/// Maps doubles to integers of the same order.
std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}
double value_of(std::uint64_t key) { return std::bit_cast<double>((key & sign) != 0 ? key & ~sign : ~key); }

}  // namespace

OrderStatistics::OrderStatistics() : file_(std::tmpfile()) {
  if (!file_) fail();
}

void OrderStatistics::add(double value) {
  value += 0.0;  // Turns -0 into 0.
  if (std::fwrite(&value, sizeof value, 1, file_.get()) != 1) fail();
  ++count_;
}

std::vector<double> OrderStatistics::of_ranks(const std::vector<long>& ranks) {
  // Radix selection. The leading bits of the number at each rank are known; each pass over the file counts the values of the next bits
  // among all numbers with the same leading bits.
  constexpr unsigned radix_bits = 8;
  struct Search {
    std::uint64_t prefix = 0;
    long rank = 0;  ///< Rank among the numbers with this prefix.
  };
  std::vector<Search> searches;
  for (const long rank : ranks) searches.push_back({0, rank});
  for (unsigned known = 0; known < 64; known += radix_bits) {
    std::map<std::uint64_t, std::array<long, 1U << radix_bits>> counts;
    for (const Search& search : searches) counts[search.prefix].fill(0);
    if (std::fflush(file_.get()) != 0) fail();
    std::rewind(file_.get());
    std::array<double, 4096> values{};
    for (std::size_t read = 0; (read = std::fread(values.data(), sizeof(double), values.size(), file_.get())) > 0;)
      for (std::size_t k = 0; k < read; ++k) {
        const std::uint64_t key = key_of(values[k]);
        const auto of_prefix = counts.find(known == 0 ? 0 : key >> (64 - known));
        if (of_prefix != counts.end()) ++of_prefix->second[key >> (64 - known - radix_bits) & ((1U << radix_bits) - 1)];
      }
    if (std::ferror(file_.get()) != 0) fail();
    for (Search& search : searches) {
      const auto& of_prefix = counts[search.prefix];
      std::size_t digit = 0;
      for (; search.rank > of_prefix[digit]; ++digit) search.rank -= of_prefix[digit];
      search.prefix = (search.prefix << radix_bits) | digit;
    }
  }
  std::vector<double> result;
  for (const Search& search : searches) result.push_back(value_of(search.prefix));
  return result;
}

}  // namespace rheonet::tool
