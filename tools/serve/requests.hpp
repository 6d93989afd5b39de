#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace rheonet::serve {

class Folder;

// Requests of the playground, whether a server or the page's own WebAssembly answers them: see tools/web/README.md.

/// A string of a request, "" if there is none; a long one is no name.
std::string word(const nlohmann::json& value, const char* key);

/// The task that a request asks for, with nothing in it but what is known; absent if it asks for none.
std::optional<nlohmann::json> task_of(const nlohmann::json& request);

/// The netlists of a folder, as the gallery lists them.
nlohmann::json listing_of(const Folder& folder);

}  // namespace rheonet::serve
