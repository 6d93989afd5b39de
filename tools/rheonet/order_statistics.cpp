#include "tools/rheonet/order_statistics.hpp"

#include <array>
#include <bit>
#include <map>

namespace rheonet::tool {
namespace {

constexpr std::size_t block = 4096;  // numbers

constexpr std::uint64_t sign = std::uint64_t{1} << 63U;

/// Maps doubles to integers of the same order.
std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}
double value_of(std::uint64_t key) { return std::bit_cast<double>((key & sign) != 0 ? key & ~sign : ~key); }

}  // namespace

void OrderStatistics::add(double value) {
  if (block_.size() == block) {
    file_.write(block_.data(), block * sizeof(double), written_);
    written_ += static_cast<std::int64_t>(block * sizeof(double));
    block_.clear();
  }
  block_.push_back(value + 0.0);  // Turns -0 into 0.
  ++count_;
}

void OrderStatistics::for_each(const std::function<void(double)>& take) const {
  std::vector<double> values(block);
  for (std::int64_t place = 0; place < written_; place += static_cast<std::int64_t>(block * sizeof(double))) {
    file_.read(values.data(), block * sizeof(double), place);
    for (const double value : values) take(value);
  }
  for (const double value : block_) take(value);
}

std::vector<double> OrderStatistics::of_ranks(const std::vector<long>& ranks) const {
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
    for_each([&](double value) {
      const std::uint64_t key = key_of(value);
      const auto of_prefix = counts.find(known == 0 ? 0 : key >> (64 - known));
      if (of_prefix != counts.end()) ++of_prefix->second[key >> (64 - known - radix_bits) & ((1U << radix_bits) - 1)];
    });
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
