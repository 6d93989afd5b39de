#pragma once

#include <string>

#include "tests/wiring/catalogue.hpp"

namespace rheonet::test {

enum class Verdict {
  agrees,     ///< with the reference
  refused,    ///< as physics demands, and up to then it agrees
  open,       ///< agrees up to where the laws leave open how it goes on
  undecided,  ///< the reference doubts too much of its own values
  wrong,
};

struct Judgement {
  Verdict verdict = Verdict::wrong;
  double deviation = 0;  ///< the worst, of a record's scale
  double judged = 0;     ///< share of the values that the reference is sure of
  int reference_steps = 0;
  std::string text;      ///< Place of the largest deviation, or the error.
};

/// Runs the scene, integrates it independently, and compares. Where the two do not agree the reference takes shorter steps,
/// down to a 256th of those that it begins with: a motion that just touches a reversal escapes a longer step, and its
/// estimate of its error. `closer`: both with more effort, to see which of them is nearer to the truth.
Judgement judge(const Wiring& wiring, bool closer = false);

}  // namespace rheonet::test
