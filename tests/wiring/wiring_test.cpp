// A fixed part of the wiring test: see README.md for the whole.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>

#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/identities.hpp"
#include "tests/wiring/judge.hpp"
#include "tests/wiring/tally.hpp"

using namespace rheonet::test;

namespace {

constexpr unsigned seed = 20260417;

std::string listed(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "\n" + line;
  return text;
}

void check(const Tally& tally, std::size_t count) {
  CHECK_MESSAGE(tally.of(Verdict::wrong) == 0, listed(tally.wrong));
  // The reference decides nearly all.
  CHECK_MESSAGE(100 * tally.undecided.size() <= count, listed(tally.undecided));
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
  // Faults of the simulator that are open: rest behind a dilatant dashpot when the run ends just there; a velocity off by 25
  // times the accuracy in a moving frame. They are told here as long as they are, and leave the list when they are mended.
  const std::set<int> open = {3034, 10721};
  std::vector<int> numbers = sample(count, seed);
  std::erase_if(numbers, [&](int number) { return open.contains(number); });
  check(judge_all(numbers, 1, check_identities), count);
}
