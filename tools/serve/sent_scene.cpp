#include "tools/serve/sent_scene.hpp"

#include <nlohmann/json.hpp>

#include "tools/rheonet/reading.hpp"

namespace rheonet::serve {
namespace {

constexpr std::size_t most_elements = 100'000;

}  // namespace

SentScene sent_scene(const nlohmann::json& item) {
  return {item.at("text").get<std::string>(), item.at("file").get<std::string>(), item.at("folder").get<std::string>()};
}

ReadResult read_sent(const SentScene& item, const std::vector<const FileOffer*>& offers, const ReadOptions& options) {
  ReadResult result = tool::read_text(item.text, item.file, item.folder, options, offers);
  if (result.scene && result.scene->elements.size() > most_elements) {
    result.diagnostics.push_back({.severity = Severity::error,
                                  .spot = {0, 1, 1},
                                  .message = "a scene here may have " + std::to_string(most_elements) + " elements",
                                  .hint = "`rheonet run` has no such limit"});
    result.scene.reset();
  }
  return result;
}

}  // namespace rheonet::serve
