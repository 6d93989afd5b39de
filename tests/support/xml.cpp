#include "tests/support/xml.hpp"

#include <regex>
#include <vector>

namespace rheonet::test {

std::string what_is_wrong_with_xml(const std::string& text) {
  static const std::regex tag(R"(^/?([a-zA-Z:]+)((?: [a-zA-Z:-]+="[^<"]*")*) ?/?$)");
  std::vector<std::string> open;
  bool seen = false;
  std::size_t at = text.starts_with("<?xml") ? text.find("?>") + 2 : 0;
  while (at < text.size()) {
    if (text[at] != '<') {
      const std::size_t end = std::min(text.find('<', at), text.size());
      for (std::size_t i = at; i < end; ++i) {
        if (static_cast<unsigned char>(text[i]) < 0x20 && text[i] != '\n') return "a control character";
        if (text[i] != '&') continue;
        const std::string entity = text.substr(i, text.find(';', i) - i + 1);
        if (entity != "&lt;" && entity != "&gt;" && entity != "&amp;" && entity != "&quot;") return "a bare & in text";
      }
      if (open.empty() && text.find_first_not_of(" \n", at) < end) return "text outside of the document";
      at = end;
      continue;
    }
    const std::size_t end = text.find('>', at);
    if (end == text.npos) return "a tag that does not end";
    const std::string inside = text.substr(at + 1, end - at - 1);
    std::smatch parts;
    // A path of many thousand points is no task for a recursive matcher: its data are taken out.
    std::string brief = inside;
    if (const std::size_t data = brief.find(" d=\"M"); data != brief.npos) {
      const std::size_t last = brief.find_first_not_of("MLZ0123456789. -", data + 4);
      if (last != brief.npos) brief.erase(data + 4, last - data - 4);
    }
    if (!std::regex_match(brief, parts, tag)) return "a tag that is none: <" + brief.substr(0, 60);
    if (inside.front() == '/') {
      if (open.empty() || open.back() != parts[1]) return "</" + parts[1].str() + "> closes nothing";
      open.pop_back();
    } else if (inside.back() != '/') {
      if (open.empty() && seen) return "a second document";
      open.push_back(parts[1]);
      seen = true;
    }
    at = end + 1;
  }
  if (!open.empty()) return "<" + open.back() + "> is not closed";
  return seen ? "" : "no element";
}

}  // namespace rheonet::test
