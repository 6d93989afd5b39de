#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/netlist/file_offer.hpp"
#include "tools/report/messages.hpp"

namespace rheonet::serve {

/// Carries out a task from task_of (requests.hpp) and sends its messages. Scenes can include only files of the offers. An error becomes a
/// message `failed`; only std::bad_alloc is thrown.
void carry_out(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

}  // namespace rheonet::serve
