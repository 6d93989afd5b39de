#pragma once

#include <sundials/sundials_nvector.h>

namespace rheonet {

/// Gives a serial vector operations of our own for what an integration does in every step: sums, multiples, norms. Clones of it
/// have them too. What they return is the same but for rounding. (Those of SUNDIALS are as fast as it was compiled: as it is
/// packaged without optimisation they take half of a step.)
void quicken(N_Vector vector);

}  // namespace rheonet
