#pragma once

#include <string>

#include "core/netlist/scene.hpp"
#include "core/result/certify.hpp"

namespace rheonet::tool {

/// The result of a certification and its cost, for a report.
std::string describe(const Scene& scene, const Certificate& certificate);

/// Prints the estimated error of each record, unless `quiet`. If an error exceeds the scene's accuracy, prints an error message with the
/// accuracy that was reached. Returns whether the certificate holds.
bool report_certificate(const Scene& scene, const Certificate& certificate, bool quiet);

}  // namespace rheonet::tool
