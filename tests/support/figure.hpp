#pragma once

#include <string>
#include <vector>

namespace rheonet::test {

/// Checks that two figures of `rheonet plot` show the same: all texts (names of curves, numbers at axes) are equal, and each curve has the
/// same extent. Pixels are not compared, so that curves may differ within the accuracy of a run.
void check_same_figure(const std::string& drawn, const std::string& kept);

/// The texts that the groups of a pattern match, in order.
std::vector<std::string> matches(const std::string& text, const std::string& pattern);

}  // namespace rheonet::test
