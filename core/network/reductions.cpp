#include "core/network/reductions.hpp"

#include <algorithm>

namespace rheonet {

const std::vector<ReductionWords>& reductions() {
  static const std::vector<ReductionWords> all{
      {Reduction::chains, "chains", "linear springs in series or side by side are one, and so are linear dashpots"},
      {Reduction::bundles, "bundles", "springs in series with sliders are one element, all between the same two nodes one bundle"},
      {Reduction::given, "given", "what stands between prescribed motions has no unknown: it follows from them"},
      {Reduction::positions, "positions", "positions that nobody asks for are not integrated"},
      {Reduction::parts, "parts", "independent parts are integrated each with steps of its own, on as many cores as there are"},
      {Reduction::unasked, "unasked", "independent parts that no record or claim needs, and that nothing can go wrong in, are not integrated"},
      {Reduction::reach, "reach", "masses at rest so far from all that moves that nothing comes to them before the stop are not integrated"},
  };
  return all;
}

const std::string& name_of(Reduction reduction) {
  return std::find_if(reductions().begin(), reductions().end(), [&](const ReductionWords& r) { return r.reduction == reduction; })->name;
}

bool kept(const Scene& scene, Reduction reduction) {
  return !scene.keep.empty() && std::find(scene.keep.begin(), scene.keep.end(), name_of(reduction)) != scene.keep.end();
}

}  // namespace rheonet
