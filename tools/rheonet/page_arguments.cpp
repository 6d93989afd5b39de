#include "tools/rheonet/page_arguments.hpp"

#include <CLI/CLI.hpp>

namespace rheonet::tool {

void add_report_options(CLI::App& command, std::vector<std::string>& scenes, std::string& output, std::string& title,
                        bool& certify, ReportArguments& report) {
  constexpr int most_scenes = 26;
  command.add_option("SCENES", scenes, "the netlists; several are set side by side, and compared")
      ->required()
      ->expected(1, most_scenes)
      ->option_text("SCENE [SCENE ...]");
  command.add_option("-o,--output", output, "the report, an .html; `-` is standard output")->required()->type_name("FILE");
  command.add_option("--title", title, "above the report, in place of that of the first scene")->type_name("TEXT");
  command.add_flag("--certify", certify, "estimate the error of each record by a much tighter run, as `run --certify`");
  command.add_flag("--precision", report.precision, "also what accuracy costs in each scene, as `precision` measures it");
}

void add_serve_options(CLI::App& command, ServeArguments& serve) {
  command.add_option("FOLDER", serve.folder, "whose netlists are shown; those that come with rheonet if it is not given")
      ->type_name("");
  command.add_option("--host", serve.host, "the address that is listened at; 127.0.0.1, this machine alone, if not given")
      ->type_name("ADDRESS");
  command.add_option("--port", serve.port, "if not given 8017; 0 is any that is free")->check(CLI::Range(0, 65535))->type_name("N");
  command.add_option("--time-limit", serve.seconds, "that a run may take [s]; 20 if not given")
      ->check(CLI::Range(0.1, 3600.0))
      ->type_name("S");
  command.add_option("--memory-limit", serve.megabytes, "that a run may take [MB]; 1024 if not given")
      ->check(CLI::Range(64, 1 << 20))
      ->type_name("N");
  command.add_flag("--open", serve.open, "open the page in the browser");
  command.add_flag("--worker", serve.worker)->group("");  // for the server itself
}

}  // namespace rheonet::tool
