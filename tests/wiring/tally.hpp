#pragma once

#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/judge.hpp"

namespace rheonet::test {

/// Verdicts on many scenes.
struct Tally {
  std::array<int, 5> count{};  ///< Number of scenes for each verdict.
  std::vector<std::string> wrong, undecided;  ///< One line for each scene.
  double cpu_seconds = 0;
  int of(Verdict verdict) const { return count[static_cast<std::size_t>(verdict)]; }
};

using Judge = std::function<Judgement(const Wiring&)>;

/// Judges each in a process of its own; a line for each goes to `log` where there is one.
Tally judge_all(const std::vector<int>& numbers, int jobs, const Judge& judge, std::FILE* log = nullptr);

}  // namespace rheonet::test
