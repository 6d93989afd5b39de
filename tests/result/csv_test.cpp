#include "core/result/csv.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>

#include "core/network/error.hpp"
#include "tests/support/random.hpp"

namespace rheonet::test::csv_test {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporary() {
  File file(std::tmpfile(), &std::fclose);
  REQUIRE(file);
  return file;
}

std::string contents(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c; (c = std::fgetc(file)) != EOF;) text.push_back(static_cast<char>(c));
  return text;
}

/// Any double: every bit drawn, so that all exponents occur.
double any_finite(Random& random) {
  for (;;) {
    const auto bits = static_cast<std::uint64_t>(random.uniform(0, 0x1p32)) << 32 |
                      static_cast<std::uint64_t>(random.uniform(0, 0x1p32));
    const auto x = std::bit_cast<double>(bits);
    if (std::isfinite(x)) return x;
  }
}

}  // namespace

TEST_CASE("numbers read back as the same doubles") {
  Random random(42);
  std::vector<double> values = {0.1,
                                1.0 / 3,
                                -2.0 / 3,
                                1e23,  // halfway between two doubles when read carelessly
                                9007199254740993.0,
                                5e-324,
                                -2.2250738585072011e-308,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::min(),
                                std::numeric_limits<double>::epsilon(),
                                std::nextafter(1.0, 0.0)};
  while (values.size() < 20000) values.push_back(any_finite(random));

  const File file = temporary();
  CsvWriter csv(file.get(), "the results");
  csv.header({"x"});
  for (const double x : values) csv.row(-x, {x});
  csv.flush();
  const std::string text = contents(file.get());
  REQUIRE(text.starts_with("time,x\n"));
  const char* next = text.c_str() + 7;
  for (const double x : values) {
    char* end = nullptr;
    CHECK_EQ(std::bit_cast<std::uint64_t>(std::strtod(next, &end)), std::bit_cast<std::uint64_t>(-x));
    REQUIRE_EQ(*end, ',');
    next = end + 1;
    CHECK_EQ(std::bit_cast<std::uint64_t>(std::strtod(next, &end)), std::bit_cast<std::uint64_t>(x));
    REQUIRE_EQ(*end, '\n');
    next = end + 1;
  }
  CHECK_EQ(*next, '\0');
}

TEST_CASE("no zero is negative, and numbers take no more digits than they need") {
  const File file = temporary();
  CsvWriter csv(file.get(), "the results");
  csv.header({"a", "b.c"});
  csv.row(-0.0, {-0.0, 0.1});
  csv.row(0.5, {-5e-324, 1e-7});
  csv.flush();
  CHECK_EQ(contents(file.get()), "time,a,b.c\n0,0,0.1\n0.5,-5e-324,1e-07\n");
}

TEST_CASE("a header alone, no columns, no file") {
  const File file = temporary();
  CsvWriter csv(file.get(), "the results");
  csv.header({});
  csv.row(0.25, {});
  csv.flush();
  CHECK_EQ(contents(file.get()), "time\n0.25\n");
  CsvWriter nowhere(nullptr, "the results");
  nowhere.header({"a"});
  nowhere.row(0.25, {1});
  nowhere.flush();
}

TEST_CASE("rows reach the file while it is written, all of them when it is flushed") {
  const File file = temporary();
  CsvWriter csv(file.get(), "the results");
  csv.header({"a"});
  int rows = 0;
  const auto size = [&] {
    struct stat status {};
    REQUIRE(::fstat(::fileno(file.get()), &status) == 0);
    return status.st_size;
  };
  for (; size() == 0; ++rows) {
    REQUIRE(rows < 1000000);
    csv.row(rows, {rows / 3.0});
  }
  CHECK(rows > 100);  // not each by itself
  csv.row(-1, {-1});
  csv.flush();
  CHECK(contents(file.get()).ends_with("\n-1,-1\n"));
}

TEST_CASE("a file that cannot be written stops the run once, with the reason") {
  std::FILE* full = std::fopen("/dev/full", "w");
  if (!full) return;  // a system without it
  CsvWriter csv(full, "the results");
  csv.header({"a"});
  csv.row(0.5, {1.5});
  CHECK_THROWS_WITH_AS(csv.flush(), "the results cannot be written: No space left on device", SimulationError);
  csv.row(0.7, {1.5});
  CHECK_NOTHROW(csv.flush());
  std::fclose(full);
}

}  // namespace rheonet::test::csv_test
