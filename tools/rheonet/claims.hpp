#pragma once

#include <string>

#include "core/netlist/diagnostic.hpp"
#include "core/result/run.hpp"

namespace rheonet::tool {

/// A claim and the finding, as text.
struct ClaimInWords {
  std::string name;     ///< As in "largest k1.force from 1 s to 2 s".
  std::string claimed;  ///< As in "2 N within 0.01 N".
  std::string found;    ///< As in "2.003 N", "never comes".
  bool holds;
};
ClaimInWords in_words(const Scene& scene, const Claim& claim, const Finding& finding);

/// The SI unit of a claim's figure, as a user would type it; "1" for a dimensionless figure.
std::string unit_of_claim(const Claim& claim, const Scene& scene);

/// Prints for each claim of the scene's [expect] whether it holds, with the figures: a claim that fails as an error at its place in the
/// netlist, any other as a line unless `quiet`. Returns whether all hold.
bool report_claims(const Scene& scene, const Summary& summary, const Sources& sources, bool quiet);

}  // namespace rheonet::tool
