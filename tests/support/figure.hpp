#pragma once

#include <string>
#include <vector>

namespace rheonet::test {

/// Whether a figure of `rheonet plot` shows what another does: all that can be read in it (what its curves are, the numbers
/// at its axes) is the same, and each of its curves goes as far. Fails the test where not; not of pixels, so that curves
/// may differ by what the accuracy of a run allows.
void check_same_figure(const std::string& drawn, const std::string& kept);

/// The texts that the groups of a pattern match, in order.
std::vector<std::string> matches(const std::string& text, const std::string& pattern);

}  // namespace rheonet::test
