#pragma once

#include <string>

namespace rheonet::serve {

/// Why `file`, such as "teaching/creep.toml", is no name of a netlist in a folder, whatever is in the folder; "" if it is
/// one. Such a name can be shown on one line, and does not lead out of the folder.
std::string fault_of_name(const std::string& file);

}  // namespace rheonet::serve
