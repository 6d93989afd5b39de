#include "tools/rheonet/repeated_options.hpp"

#include <utility>

namespace rheonet::tool {

namespace {

bool is_override(const std::string& word) {
  const std::size_t equals = word.find('=');
  return equals != std::string::npos && equals > 0 && word[0] != '-' && word.find('/') > equals;
}

bool is_measure(const std::string& word) {
  if (word == "steps" || word == "events" || word.starts_with("energy ")) return true;
  return word[0] != '-' && word.find('(') < word.size() && word.ends_with(')');
}

bool is_shard_file(const std::string& word) { return word[0] != '-' && !word.ends_with(".toml"); }

}  // namespace

std::vector<std::string> with_every_option(const std::vector<std::string>& words) {
  constexpr std::pair<const char*, bool (*)(const std::string&)> options[] = {
      {"--set", is_override}, {"--vary", is_override}, {"--measure", is_measure}, {"--merge", is_shard_file}};
  std::vector<std::string> result;
  std::string goes_on;  // The option that the following words belong to.
  for (const std::string& word : words) {
    std::string before;
    before.swap(goes_on);
    for (const auto& [option, fits] : options) {
      const bool repeated = before == option && !word.empty() && fits(word);
      if (repeated) result.emplace_back(option);
      const bool named = !result.empty() && result.back() == option;
      if (repeated || named || word.starts_with(std::string(option) + '=')) goes_on = option;
    }
    result.push_back(word);
  }
  return result;
}

}  // namespace rheonet::tool
