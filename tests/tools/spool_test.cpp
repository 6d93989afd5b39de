// A temporary file holds long texts, and texts that wait for an earlier one. They come out as they went in, in order, and take the memory of a few
// blocks.
#include "tools/rheonet/spool.hpp"

#include <doctest/doctest.h>
#include <malloc.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tools/rheonet/in_order.hpp"
#include "tools/rheonet/order_statistics.hpp"

namespace rheonet::test::spool_test {
namespace {

using tool::Spool, tool::SpoolFile;

/// Bytes that are allocated in this process, large blocks included.
std::size_t allocated() {
  const auto all = ::mallinfo2();
  return all.uordblks + all.hblkhd;
}

std::string line(long number, std::size_t size) { return std::to_string(number) + std::string(size, static_cast<char>('a' + number % 26)) + '\n'; }

std::string taken(Spool& spool) {
  std::string all;
  bool whole = true;
  CHECK(spool.take([&](const std::string& lines) {
    whole = whole && lines.ends_with('\n');
    all += lines;
    return true;
  }));
  CHECK(whole);
  return all;
}

}  // namespace

TEST_CASE("a text comes out as it went in, with lines below and above the size of a block") {
  SpoolFile file;
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, SpoolFile::block - 2, SpoolFile::block, 3 * SpoolFile::block + 7}) {
    CAPTURE(size);
    Spool spool(file);
    std::string expected;
    for (long k = 0; k < 20; ++k) {
      spool.append(line(k, size));
      expected += line(k, size);
    }
    CHECK(spool.size() == expected.size());
    CHECK(taken(spool) == expected);
    CHECK(spool.size() == 0);
    CHECK(taken(spool).empty());
  }
}

TEST_CASE("texts of any length are joined") {
  SpoolFile file;
  const std::vector<std::size_t> sizes{0, 5, SpoolFile::block / 2, SpoolFile::block, 5 * SpoolFile::block / 2};
  for (const std::size_t one : sizes)
    for (const std::size_t other : sizes) {
      CAPTURE(one);
      CAPTURE(other);
      Spool first(file), second(file);
      first.append(line(1, one));
      second.append(line(2, other));
      first.append(std::move(second));
      first.append(line(3, 4));
      CHECK(taken(first) == line(1, one) + line(2, other) + line(3, 4));
    }
}

TEST_CASE("the end of a text is not read after it was refused") {
  SpoolFile file;
  Spool spool(file);
  for (long k = 0; k < 10; ++k) spool.append(line(k, SpoolFile::block));
  int pieces = 0;
  CHECK_FALSE(spool.take([&](const std::string&) { return ++pieces < 3; }));
  CHECK(pieces == 3);
}

TEST_CASE("texts that wait for the first one take no memory") {
  constexpr long tasks = 20'000;
  constexpr std::size_t size = 1000;  // bytes; 20 MB in all
  std::atomic<long> made = 0;
  std::size_t most = 0;
  long next = 0, wrong = 0;
  const std::size_t before = allocated();
  const long end = tool::do_in_order({.first = 0,
                                      .end = tasks,
                                      .jobs = 3,
                                      .most_at_once = 16,
                                      .make =
                                          [&](long first, long behind, Spool& text, const std::atomic<bool>&) {
                                            // The first task ends last, and every thousandth one late.
                                            while (first == 0 && made < tasks - behind) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                            if (first == 0) most = allocated() - before;
                                            for (long task = first; task < behind; ++task) {
                                              if (task % 1000 == 7) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                              text.append(line(task, size));
                                            }
                                            made += behind - first;
                                            return true;
                                          },
                                      .take =
                                          [&](const std::string& lines) {
                                            for (std::size_t begin = 0, end = 0; (end = lines.find('\n', begin)) != lines.npos; begin = end + 1, ++next)
                                              if (lines.substr(begin, end + 1 - begin) != line(next, size)) ++wrong;
                                            return true;
                                          },
                                      .go_on = [](long) { return true; }});
  CHECK(end == tasks);
  CHECK(next == tasks);
  CHECK(wrong == 0);
  CHECK(most < 2e6);
}

TEST_CASE("an error where the texts are taken ends all tasks") {
  const auto run = [] {
    tool::do_in_order({.first = 0,
                       .end = 1'000'000'000,
                       .jobs = 2,
                       .make =
                           [](long first, long, Spool& text, const std::atomic<bool>&) {
                             text.append(line(first, 3));
                             return true;
                           },
                       .take = [](const std::string&) -> bool { throw std::runtime_error("full"); },
                       .go_on = [](long) { return true; }});
  };
  CHECK_THROWS_WITH(run(), "full");
}

TEST_CASE("order statistics of many numbers take no memory") {
  const std::size_t before = allocated();
  tool::OrderStatistics statistics;
  constexpr long count = 1'000'003;
  for (long k = 0; k < count; ++k) statistics.add(static_cast<double>(k * 617 % count) - 500'000);  // a permutation
  CHECK(allocated() - before < 1e6);
  CHECK(statistics.of_ranks({1, 2, 500'001, count}) == std::vector<double>{-500'000, -499'999, 0, 500'002});
}

}  // namespace rheonet::test::spool_test
