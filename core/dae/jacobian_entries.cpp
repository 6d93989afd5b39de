#include "core/dae/jacobian_entries.hpp"

namespace rheonet {

std::vector<int> JacobianEntries::build(int size) {
  std::vector<int> entry;
  pattern_ = builder_.build(size, entry);
  builder_ = {};
  const auto take = [&](auto& list) {
    for (auto& item : list) item.entry = entry[at(item.entry)];
    list = std::vector(list.begin(), list.end());  // without spare capacity
  };
  take(constants_);
  take(masses_);
  take(scatter_);
  return entry;
}

}  // namespace rheonet
