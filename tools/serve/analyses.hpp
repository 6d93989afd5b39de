#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/netlist/file_offer.hpp"
#include "tools/report/messages.hpp"

// Tasks that simulate a scene many times. Each sends messages `progress` with the fraction that is done.
namespace rheonet::serve {

/// Compares the scene with and without each of its effects. Sends the message `effects`, then `effect_curves` with the record that changes
/// most, for the full model and without each effect.
void weigh_effects(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

/// Measures CPU time against error: the message `prices`.
void price_accuracy(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

/// Simulates the scene for several values of one number. Sends for each value a message `point` with the measures (named as for
/// `rheonet sweep --measure`) or the reason of a failure.
void sweep_number(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

}  // namespace rheonet::serve
