#pragma once

namespace rheonet {

/// The energy account up to a time of a run [J]; its defect is supplied - stored - dissipated.
struct EnergySoFar {
  double supplied = 0, stored = 0, dissipated = 0;  ///< since the start; `stored` is a gain
  double kinetic = 0, elastic = 0;                  ///< stored at that time
};

}  // namespace rheonet
