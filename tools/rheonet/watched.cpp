#include "tools/rheonet/watched.hpp"

#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"

namespace rheonet::tool {

bool do_watched(const Sources& sources, const std::function<void(const std::function<void(double)>&)>& work) {
  Progress progress(true);
  try {
    work([&progress](double fraction) { progress.update(fraction); });
  } catch (const SimulationError& error) {
    progress.erase();
    report(error, sources);
    return false;
  }
  return true;
}

}  // namespace rheonet::tool
