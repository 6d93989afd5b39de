#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace rheonet::serve {

class Folder;

// Requests of the playground, answered by a server or by WebAssembly in the page: see tools/web/README.md.

/// A string of a request; "" if there is none or if it is too long for a name.
std::string word(const nlohmann::json& value, const char* key);

/// The task that a request asks for, with known keys only; absent if the request is invalid.
std::optional<nlohmann::json> task_of(const nlohmann::json& request);

/// The netlists of a folder, for the gallery.
nlohmann::json listing_of(const Folder& folder);

}  // namespace rheonet::serve
