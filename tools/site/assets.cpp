#include "tools/web/assets.hpp"

#include <fstream>
#include <iterator>
#include <string>

namespace rheonet::web {

// The site's page puts the template of reports into the file system in memory, where the programs have it in themselves.
Asset report_page() {
  static const std::string text = [] {
    std::ifstream file("/report.html");
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  return {text, "text/html; charset=utf-8"};
}

}  // namespace rheonet::web
