// A fixed part of the wiring test: see README.md for the whole.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/identities.hpp"
#include "tests/wiring/judge.hpp"
#include "tests/wiring/tally.hpp"

namespace rheonet::test::wiring_test {

namespace {

constexpr unsigned seed = 20260417;

std::string format_list(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "\n" + line;
  return text;
}

void check(const Tally& tally, std::size_t count) {
  CHECK_MESSAGE(tally.of(Verdict::wrong) == 0, format_list(tally.wrong));
  // The reference decides nearly all.
  CHECK_MESSAGE(100 * tally.undecided.size() <= count, format_list(tally.undecided));
  CHECK_LE(tally.of(Verdict::open), count / 10);
  CHECK_GE(tally.of(Verdict::agrees), 4 * count / 5);
}

}  // namespace

TEST_CASE("wirings agree with an independent integrator") {
  constexpr int count = 330;
  const Tally tally = judge_all(sample(count, seed), 1, [](const Wiring& wiring) { return judge(wiring); });
  check(tally, count);
  CHECK_GT(tally.of(Verdict::refused), 0);
}

TEST_CASE("wirings satisfy the identities of mechanics") {
  constexpr int count = 330;
  check(judge_all(sample(count, seed), 1, check_identities), count);
}

TEST_CASE("reductions change no record of wirings beyond the accuracy asked") {
  constexpr int count = 110;
  check(judge_all(sample(count, seed), 1, check_reductions), count);
}

// Each of these showed a fault that the samples do not show.
TEST_CASE("wirings that did not always agree with an independent integrator") {
  const std::vector<int> numbers = {927, 1699, 3231, 3410, 4826, 5310, 8559};
  const Tally tally = judge_all(numbers, 1, [](const Wiring& wiring) { return judge(wiring); });
  CHECK_MESSAGE(tally.of(Verdict::agrees) == numbers.size(), format_list(tally.wrong));
}

TEST_CASE("wirings that did not always satisfy the identities of mechanics") {
  const std::vector<int> numbers = {449,  532,  537,  560,  776,  1096, 1139, 1353, 1395, 1416, 1420, 2035, 2910, 3514,
                                    3980, 4088, 4139, 5179, 5287, 5395, 5990, 6282, 6883, 6910, 7307, 7355, 7432, 8002,
                                    8916, 9095, 9411, 9715, 10116, 10185, 10517, 10635};
  const Tally tally = judge_all(numbers, 1, check_identities);
  CHECK_MESSAGE(tally.of(Verdict::agrees) == numbers.size(), format_list(tally.wrong));
}

}  // namespace rheonet::test::wiring_test
