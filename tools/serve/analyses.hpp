#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/netlist/file_offer.hpp"
#include "tools/report/messages.hpp"

// Tasks that simulate a scene many times. Each tells `progress` while it goes on, with the fraction that is done.
namespace rheonet::serve {

/// The scene without each of its effects: the message `effects`, and then as `effect_curves` the record that they change most,
/// of the full model and without each.
void weigh_effects(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

/// What accuracy costs: the message `prices`.
void price_accuracy(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

/// Measures of the scene, as `rheonet sweep --measure` names them, for each of some values of a number: `point` for each value, with
/// its measures or why it failed.
void sweep_number(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

}  // namespace rheonet::serve
