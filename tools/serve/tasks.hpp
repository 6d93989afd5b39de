#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/netlist/file_offer.hpp"
#include "tools/report/messages.hpp"

namespace rheonet::serve {

/// Carries out a task of the playground as task_of (requests.hpp) gives it, and tells its messages. A scene includes files of the
/// offers alone. An error becomes a message `failed`; only std::bad_alloc is thrown.
void carry_out(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

}  // namespace rheonet::serve
