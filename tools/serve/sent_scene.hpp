#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/netlist/file_offer.hpp"

namespace rheonet::serve {

/// A netlist from a request. Its folder is relative to the served folder.
struct SentScene {
  std::string text, file, folder;
};

SentScene sent_scene(const nlohmann::json& item);

/// Reads a netlist from a request; its includes and tables come from the offers. Too many elements are a mistake.
ReadResult read_sent(const SentScene& item, const std::vector<const FileOffer*>& offers, const ReadOptions& options);

}  // namespace rheonet::serve
