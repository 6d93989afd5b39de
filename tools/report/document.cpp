#include "tools/report/document.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "tools/plot/text.hpp"
#include "tools/report/messages.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::report {
namespace {

/// JSON that may stand in a script element: nothing in it ends that.
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

/// Puts a text in the place of a mark.
void replace(std::string& page, std::string_view mark, const std::string& by) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error("the page of reports has no place for its data");
  page.replace(at, mark.size(), by);
}

}  // namespace

std::string document(const std::string& title, const std::vector<std::vector<std::string>>& scenes) {
  std::string data = "{\"title\":" + to_line(title) + ",\"version\":\"" RHEONET_VERSION "\",\"scenes\":[";
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    data += k > 0 ? ",[" : "[";
    for (std::size_t i = 0; i < scenes[k].size(); ++i) data += (i > 0 ? "," : "") + scenes[k][i];
    data += "]";
  }
  std::string page(web::report_page().text);
  replace(page, "<!-- title -->", plot::escaped(title));
  replace(page, "/* data */", in_script(data + "]}"));
  return page;
}

}  // namespace rheonet::report
