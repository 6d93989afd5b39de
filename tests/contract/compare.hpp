#pragma once

#include <functional>

#include "core/netlist/scene.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// The expected value of a record in another run: factor x + offset + drift t.
struct Relation {
  double factor = 1, offset = 0, drift = 0;
};

/// Checks every row and record of `other` against `base`, a run of `scene`, through the relation of each record; times
/// are multiplied by `time`. Both runs are as good as `accuracy` promises of the scene, so that a difference of ten
/// times that is one of the identity.
void check_related(const Scene& scene, const RunTable& base, const RunTable& other,
                   const std::function<Relation(const Record&)>& relation, double time = 1);

/// The same for a run that is to agree to the last bit.
void check_identical(const RunTable& base, const RunTable& other);

}  // namespace rheonet::test
