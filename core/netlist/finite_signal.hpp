#pragma once

#include "core/netlist/signal.hpp"

namespace rheonet {

/// Whether the values of a signal, its rates of change and its periods are within the range of double precision.
bool is_finite(const Signal& signal);

}  // namespace rheonet
