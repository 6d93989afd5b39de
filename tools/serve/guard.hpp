#pragma once

#include <httplib.h>

#include <string>

namespace rheonet::serve {

/// Why a request is refused before anything of it is looked at; "" if it is not. A page of another origin must not
/// reach a server that listens at this machine only: neither by name (a name that its owner lets point here) nor by a
/// request across origins. `host` is the address that is listened at.
std::string refusal(const httplib::Request& request, const std::string& host);

}  // namespace rheonet::serve
