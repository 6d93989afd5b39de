// The rows of runs side by side are read back as they were added, from memory and from the temporary file.
#include "core/result/row_store.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/result/csv.hpp"

namespace rheonet::test::row_store_test {
namespace {

double value(std::size_t run, std::size_t row, std::size_t column) { return static_cast<double>(run * 1'000'000'000 + row * 10 + column) / 7; }

void add(RowStore& store, std::size_t run, std::size_t first, std::size_t end, std::size_t width) {
  std::vector<double> values(width);
  for (std::size_t row = first; row < end; ++row) {
    for (std::size_t column = 0; column < width; ++column) values[column] = value(run, row, column);
    store.add(run, static_cast<double>(row), values);
  }
}

void check(const RowStore& store, std::size_t run, std::size_t count, std::size_t width) {
  REQUIRE(store.rows(run) == count);
  REQUIRE(store.width(run) == width + 1);
  RowStore::Reader reader = store.read(run);
  std::size_t wrong = 0;
  for (std::size_t row = 0; row < count; ++row) {
    const double* const found = reader.next();
    REQUIRE(found);
    if (found[0] != static_cast<double>(row)) ++wrong;
    for (std::size_t column = 0; column < width; ++column)
      if (found[1 + column] != value(run, row, column)) ++wrong;
  }
  CHECK(wrong == 0);
  CHECK_FALSE(reader.next());
  CHECK_FALSE(reader.next());
}

}  // namespace

TEST_CASE("rows are read as they were added, however many, wide and mixed they are") {
  // A block has 32768 numbers here; one row of 40000 is more.
  const std::vector<std::size_t> widths{0, 1, 6, 40000}, counts{0, 32768 / 2, 32768 / 7 * 5 + 1, 9};
  RowStore store(widths);
  for (std::size_t part = 0; part < 3; ++part)
    for (std::size_t run = 0; run < widths.size(); ++run) add(store, run, counts[run] * part / 3, counts[run] * (part + 1) / 3, widths[run]);
  for (std::size_t run = 0; run < widths.size(); ++run) {
    CAPTURE(run);
    check(store, run, counts[run], widths[run]);
  }
}

TEST_CASE("rows of many runs, added in several threads and read in turn") {
  constexpr std::size_t runs = 40, count = 50'000;
  RowStore store(std::vector<std::size_t>(runs, 1));
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < 4; ++thread)
    threads.emplace_back([&store, thread] {
      for (std::size_t run = thread; run < runs; run += 4) add(store, run, 0, count, 1);
    });
  for (std::thread& thread : threads) thread.join();
  std::vector<RowStore::Reader> readers;
  for (std::size_t run = 0; run < runs; ++run) readers.push_back(store.read(run));
  std::size_t wrong = 0;
  for (std::size_t row = 0; row < count; ++row)
    for (std::size_t run = 0; run < runs; ++run)
      if (readers[run].next()[1] != value(run, row, 0)) ++wrong;
  CHECK(wrong == 0);
}

TEST_CASE("rows are read several times, at several places at once, also after the store has moved") {
  constexpr std::size_t count = 100'000;
  RowStore store({1});
  add(store, 0, 0, count, 1);
  RowStore::Reader ahead = store.read();
  for (std::size_t row = 0; row < count / 2; ++row) ahead.next();
  const RowStore moved = std::move(store);
  check(moved, 0, count, 1);
  check(moved, 0, count, 1);
  CHECK(ahead.next()[1] == value(0, count / 2, 0));
}

TEST_CASE("rows that cannot be kept are an error that names the folder") {
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", "/proc", 1);
  RowStore store({1});
  CHECK_THROWS_WITH_AS(add(store, 0, 0, 100'000, 1), doctest::Contains("temporary file in `/proc`"), WriteError);
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
}

}  // namespace rheonet::test::row_store_test
