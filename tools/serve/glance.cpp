#include "tools/serve/glance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/netlist/document.hpp"

namespace rheonet::serve {
namespace {

/// The comment that a text begins with, up to its first empty line.
std::string first_comment(const std::string& text) {
  std::string words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
    if (line.starts_with("#:")) continue;  // The schema, for an editor.
    const std::size_t begin = line.find_first_not_of("# \t\r");
    if (begin == std::string::npos && !words.empty()) break;
    if (begin != std::string::npos) words += (words.empty() ? "" : " ") + line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
  }
  return words;
}

/// The string `key` of a table; "" if there is none.
std::string string_in(const TomlValue& table, std::string_view key) {
  const TomlEntry* entry = table.find(key);
  return entry && entry->value.is_string() ? entry->value.text : "";
}

/// The text, cut to the size of a card.
std::string shortened(std::string text) {
  constexpr std::size_t most = 400;
  if (text.size() <= most) return text;
  const std::size_t space = text.find_last_of(' ', most);
  return text.substr(0, space == std::string::npos ? 0 : space) + " ...";
}

}  // namespace

std::optional<Glance> glance(const std::string& text) {
  Sources sources;
  sources.files.push_back({"", text});
  DiagnosticList mistakes(sources);
  const std::optional<TomlValue> document = parse_toml(0, sources, mistakes);
  if (!document) {
    const Diagnostic& first = mistakes.all().front();
    return Glance{"", shortened(fmt::format("It cannot be read: {}:{}: {}", first.spot.line, first.spot.column, first.message))};
  }
  if (!document->find("elements") || !document->find("simulate")) return {};
  const TomlEntry* demo = document->find("demo");
  std::string about = demo ? string_in(demo->value, "question") : "";
  if (about.empty()) about = first_comment(text);
  return Glance{string_in(*document, "title"), shortened(std::move(about))};
}

}  // namespace rheonet::serve
