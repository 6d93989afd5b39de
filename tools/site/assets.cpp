#include <fstream>
#include <iterator>
#include <string>

#include "core/netlist/read.hpp"
#include "tools/web/assets.hpp"

// What the site's page puts into the file system in memory, and the programs have in themselves.
namespace rheonet {
namespace {

std::string text_of(const char* path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

namespace web {

Asset report_page() {
  static const std::string text = text_of("/report.html");
  return {text, "text/html; charset=utf-8"};
}

}  // namespace web

/// That of all components. The code that makes it would be a twentieth of the module.
std::string json_schema(Declarations) { return text_of("/schema.json"); }

}  // namespace rheonet
