#pragma once

#include <optional>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// The text of a file of other people's published results. They are no part of the project: they are looked for in the
/// folder that the environment variable RHEONET_REFERENCES names, else in ../shared/references beside the source tree.
/// Where it is not there, says so and gives nothing; the test is then to be left.
std::optional<std::string> reference_text(const std::string& file);

/// The same, read as a CSV file with a header row.
std::optional<RunTable> reference(const std::string& file);

/// Checks that `shift` + a column of ours is a column of the reference, within `tolerance` times the range of the
/// latter (1 if that is 0), at every time of the reference. Ours has rows at all of these times, `every` apart from 0.
void check_reference(const RunTable& ours, const std::string& column, double shift, const RunTable& theirs,
                     const std::string& their_column, double every, double tolerance);

}  // namespace rheonet::test
