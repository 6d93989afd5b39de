#pragma once

#include <string>

#include "tests/wiring/catalogue.hpp"

namespace rheonet::test {

enum class Verdict {
  agrees,     ///< Agrees with the reference.
  refused,    ///< Refused as physics demands; agrees up to then.
  open,       ///< Agrees up to the time from which the laws do not determine the motion.
  undecided,  ///< The reference doubts too many of its own values.
  wrong,
};

struct Judgement {
  Verdict verdict = Verdict::wrong;
  double deviation = 0;  ///< Largest deviation, as a fraction of the record's scale.
  double judged = 0;     ///< Fraction of the values of which the reference is certain.
  int reference_steps = 0;
  std::string text;      ///< Place of the largest deviation, or the error.
};

/// Runs the scene, integrates it independently, and compares. If they do not agree, the reference takes shorter steps, down to a 256th of its
/// first ones: longer steps, and their error estimate, can miss a motion that just touches a reversal. `closer`: computes both with more
/// effort, to see which is closer to the exact solution.
Judgement judge(const Wiring& wiring, bool closer = false);

}  // namespace rheonet::test
