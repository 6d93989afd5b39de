#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/rheonet/comparison.hpp"

namespace rheonet::tool {

/// "k1.force", or "k1.force / m.spring1.force" where scene `other` calls it otherwise than the first.
std::string name_of(const Pairing& pairing, std::size_t other);

/// The letter by which a report calls a scene: A, B, ... The command line takes no more scenes than there are letters.
std::string letter(std::size_t scene);

/// The whole comparison, for a person to read.
std::string describe(const Compared& compared);

/// All rows of all scenes: time, A.k1.force, B.k1.force, ...
std::string overlay(const Compared& compared);

/// One row of a comparison over a range.
struct Varied {
  std::string value;
  std::vector<std::vector<Difference>> differences;  ///< as in Compared
  std::vector<double> dissipated;                    ///< by each scene [J]
};

/// How the differences go with what is varied: as text, and as CSV. `compared` says of what they are.
std::string describe(const std::string& path, const std::vector<Varied>& rows, const Compared& compared);
std::string table(const std::string& path, const std::vector<Varied>& rows, const Compared& compared);

/// What a verdict is about: the pair that is furthest apart.
struct Furthest {
  std::string name;
  Difference difference;
  std::string value;  ///< of what is varied
};
std::string verdict(double within, const Furthest& furthest, const std::string& varied);

}  // namespace rheonet::tool
