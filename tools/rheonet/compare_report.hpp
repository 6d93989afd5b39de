#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/rheonet/comparison.hpp"

namespace rheonet::tool {

/// "k1.force", or "k1.force / m.spring1.force" if the record has another name in scene `other`.
std::string name_of(const Pairing& pairing, std::size_t other);

/// The letter for a scene in a report: A, B, ... The command line takes at most 26 scenes.
std::string letter(std::size_t scene);

/// The whole comparison as text.
std::string describe(const Compared& compared);

/// All rows of all scenes: time, A.k1.force, B.k1.force, ...
std::string overlay(const Compared& compared);

/// One row of a comparison over a range.
struct Varied {
  std::string value;
  std::vector<std::vector<Difference>> differences;  ///< As in Compared.
  std::vector<double> dissipated;                    ///< For each scene [J].
};

/// The differences over the varied value, as text and as CSV. The names of scenes and records come from `compared`.
std::string describe(const std::string& path, const std::vector<Varied>& rows, const Compared& compared);
std::string table(const std::string& path, const std::vector<Varied>& rows, const Compared& compared);

/// The pair of records with the largest difference, on which the verdict is based.
struct Furthest {
  std::string name;
  Difference difference;
  std::string value;  ///< The value of the varied parameter.
};
std::string verdict(double within, const Furthest& furthest, const std::string& varied);

}  // namespace rheonet::tool
