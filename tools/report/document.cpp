#include "tools/report/document.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "tools/plot/text.hpp"
#include "tools/report/messages.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::report {
namespace {

/// JSON escaped for a script element, which nothing in it can end.
std::string in_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

/// A text that replaces a mark in the page.
struct Filling {
  std::string_view mark;
  std::string text;
};

/// The page with its marks replaced, which must be in this order. Marks are searched in the page only, not in the inserted texts.
std::string filled(std::string_view page, const std::vector<Filling>& fillings) {
  std::string result;
  for (const auto& [mark, text] : fillings) {
    const std::size_t at = page.find(mark);
    if (at == std::string_view::npos) throw std::logic_error("the page of reports has no place for its data");
    result += page.substr(0, at);
    result += text;
    page.remove_prefix(at + mark.size());
  }
  return result.append(page);
}

}  // namespace

std::string document(const std::string& title, const std::vector<std::vector<std::string>>& scenes) {
  std::string data = "{\"title\":" + to_line(title) + ",\"version\":\"" RHEONET_VERSION "\",\"scenes\":[";
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    data += k > 0 ? ",[" : "[";
    for (std::size_t i = 0; i < scenes[k].size(); ++i) data += (i > 0 ? "," : "") + scenes[k][i];
    data += "]";
  }
  return filled(web::report_page().text, {{"<!-- title -->", plot::escaped(title)}, {"/* data */", in_script(data + "]}")}});
}

}  // namespace rheonet::report
