#pragma once

#include <string>

#include "core/netlist/diagnostic.hpp"
#include "core/result/run.hpp"

namespace rheonet::tool {

/// A claim and what was found, for a person to read.
struct ClaimInWords {
  std::string name;     ///< "largest k1.force from 1 s to 2 s"
  std::string claimed;  ///< "2 N within 0.01 N"
  std::string found;    ///< "2.003 N", "never comes"
  bool holds;
};
ClaimInWords in_words(const Scene& scene, const Claim& claim, const Finding& finding);

/// The SI unit of a claim's figure, as a user would type it; "1" for a number.
std::string unit_of_claim(const Claim& claim, const Scene& scene);

/// Says of each claim of the scene's [expect] whether it holds, with the figures: those that fail as errors at their
/// places, the others as lines unless `quiet`. Whether all hold.
bool report_claims(const Scene& scene, const Summary& summary, const Sources& sources, bool quiet);

}  // namespace rheonet::tool
