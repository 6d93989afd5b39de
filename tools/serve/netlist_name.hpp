#pragma once

#include <string>

namespace rheonet::serve {

/// Why `file` is not a valid name of a netlist or a lesson in a folder, such as "teaching/creep.toml" or "teaching/creep.lesson"; "" if it is
/// valid. A valid name can be shown on one line and does not lead out of the folder. The folder itself is not read.
std::string fault_of_name(const std::string& file);

}  // namespace rheonet::serve
