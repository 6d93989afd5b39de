#include <fstream>
#include <iterator>
#include <string>

#include "core/netlist/read.hpp"
#include "tools/web/assets.hpp"

// Reads from the in-memory file system, which the site's page fills, the files that are compiled into the programs.
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

/// The JSON Schema of all components, read from a file: the code that generates it would be a twentieth of the module.
std::string json_schema(Declarations) { return text_of("/schema.json"); }

}  // namespace rheonet
