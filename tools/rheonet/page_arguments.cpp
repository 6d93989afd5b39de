#include "tools/rheonet/page_arguments.hpp"

#include <CLI/CLI.hpp>
#include <regex>
#include <string>

namespace rheonet::tool {
namespace {

/// The error in an origin, which is copied into an HTTP header; "" if it is valid.
std::string fault_of_origin(const std::string& origin) {
  static const std::regex form(R"(\*|https?://[A-Za-z0-9.-]+(:[0-9]+)?|https?://\[[0-9a-fA-F:]+\](:[0-9]+)?)");
  return std::regex_match(origin, form) ? "" : "an origin is as in https://school.example or http://localhost:8000, without a path; * is every page";
}

}  // namespace

void add_report_options(CLI::App& command, std::vector<std::string>& scenes, std::string& output, std::string& title,
                        bool& certify, ReportArguments& report) {
  constexpr int most_scenes = 26;
  command.add_option("SCENES", scenes, "the netlists; several stand side by side, with their differences")
      ->required()
      ->expected(1, most_scenes)
      ->option_text("SCENE [SCENE ...]");
  command.add_option("-o,--output", output, "the report (.html); `-` is standard output")->required()->type_name("FILE");
  command.add_option("--title", title, "title of the report, instead of that of the first scene")->type_name("TEXT");
  command.add_flag("--certify", certify, "estimate the error of each record, as `run --certify` does");
  command.add_flag("--precision", report.precision, "add the cost of accuracy in each scene, as `precision` measures it");
}

void add_serve_options(CLI::App& command, ServeArguments& serve) {
  command.add_option("FOLDER", serve.folder, "folder of netlists (default: those that come with rheonet)")
      ->type_name("");
  command.add_option("--host", serve.host, "address to listen on (default 127.0.0.1: this machine alone)")
      ->type_name("ADDRESS");
  command.add_option("--port", serve.port, "port (default 8017); 0 takes a free one")->check(CLI::Range(0, 65535))->type_name("N");
  command.add_option("--framed-by", serve.framed_by, "origin whose pages may show the playground in a frame (default: none); * is every page")
      ->check(fault_of_origin)
      ->type_name("ORIGIN");
  command.add_option("--time-limit", serve.seconds, "largest CPU time of a run [s] (default 20)")
      ->check(CLI::Range(0.1, 3600.0))
      ->type_name("S");
  command.add_option("--memory-limit", serve.megabytes, "largest memory of a run [MB] (default 1024)")
      ->check(CLI::Range(64, 1 << 20))
      ->type_name("N");
  command.add_flag("--open", serve.open, "open the page in the browser");
  command.add_flag("--worker", serve.worker)->group("");  // For the server itself.
}

}  // namespace rheonet::tool
