#pragma once

#include <string>

#include "core/netlist/scene.hpp"
#include "core/result/certify.hpp"

namespace rheonet::tool {

/// The same for a report: what was found, and what it cost.
std::string describe(const Scene& scene, const Certificate& certificate);

/// Says of each record how far it is estimated to be off, unless `quiet`; if that is more than the scene asks for, as an
/// error with what could be reached. Whether the certificate holds.
bool report_certificate(const Scene& scene, const Certificate& certificate, bool quiet);

}  // namespace rheonet::tool
