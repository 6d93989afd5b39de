#pragma once

#include "core/netlist/declaration.hpp"

namespace rheonet::test {

/// A few element types that have every property which a declaration can have, so that tests of the reader do not depend
/// on the components.
Declarations fake_declarations();

}  // namespace rheonet::test
