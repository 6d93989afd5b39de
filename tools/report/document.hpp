#pragma once

#include <string>
#include <vector>

namespace rheonet::report {

/// A report as one HTML file that needs no other. `scenes` are the messages of each scene.
std::string document(const std::string& title, const std::vector<std::vector<std::string>>& scenes);

}  // namespace rheonet::report
