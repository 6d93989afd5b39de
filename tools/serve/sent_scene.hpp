#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/netlist/file_offer.hpp"

namespace rheonet::serve {

/// A netlist that was sent. Its folder is relative to the served folder.
struct SentScene {
  std::string text, file, folder;
};

SentScene sent_scene(const nlohmann::json& item);

/// Reads a netlist that was sent; its includes and tables come from the offers. A scene of too many elements is a mistake.
ReadResult read_sent(const SentScene& item, const std::vector<const FileOffer*>& offers, const ReadOptions& options);

}  // namespace rheonet::serve
