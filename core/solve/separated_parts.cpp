#include "core/solve/separated_parts.hpp"

#include "core/base/disjoint_sets.hpp"

namespace rheonet {

void SeparatedParts::attach(const Structure& structure) {
  structure_ = &structure;
  DisjointSets parts(structure.kind.size());
  const auto join = [&](const Branch& b) {
    if (structure.kind[at(b.a)] != Kind::known && structure.kind[at(b.b)] != Kind::known) parts.join(b.a, b.b);
  };
  for (const Branch& b : structure.deflections) join(b);
  for (const Branch& b : structure.rates) join(b);
  for (const Branch& b : structure.sliders) join(b);
  representative_.clear();
  for (std::size_t n = 0; n < structure.kind.size(); ++n) representative_.push_back(parts.find(static_cast<NodeId>(n)));
}

}  // namespace rheonet
