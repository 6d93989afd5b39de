#include "core/solve/unknown.hpp"

#include "core/base/index.hpp"

namespace rheonet {

std::vector<Unknown> unknowns_of(Dae& dae) {
  using Sort = Unknown::Sort;
  std::vector<Unknown> result(at(dae.size()), {Sort::velocity, 0});
  const auto stands_for = [&](int unknown, Sort sort, std::size_t index) {
    if (unknown >= 0) result[at(unknown)] = {sort, static_cast<unsigned>(index)};
  };
  const Structure& structure = dae.structure();
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) stands_for(dae.indices().deflection[j], Sort::deflection, j);
  for (std::size_t r = 0; r < structure.rates.size(); ++r) stands_for(dae.indices().force[r], Sort::force, r);
  for (std::size_t n = 0; n < structure.kind.size(); ++n) {
    stands_for(dae.indices().velocity[n], Sort::velocity, n);
    stands_for(dae.indices().position[n], Sort::position, n);
  }
  for (std::size_t k = 0; k < dae.inputs().blocks().states(); ++k) stands_for(dae.indices().block[k], Sort::block, k);
  return result;
}

}  // namespace rheonet
