#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rheonet::tool {

/// Options of `report`.
struct ReportArguments {
  bool precision = false;  ///< Add a measurement of CPU time against error.
};

/// Options of `serve`.
struct ServeArguments {
  std::string folder;  ///< "": the netlists that come with rheonet.
  std::string host = "127.0.0.1";
  std::string framed_by;   ///< Origin whose pages may embed the playground in a frame; "*": all; "": none.
  int port = 8017;         ///< 0: any free port.
  double seconds = 20;     ///< CPU time limit for a scene [s].
  int megabytes = 1024;    ///< Memory limit for a scene [MB].
  bool open = false;       ///< Open the page in the user's browser.
  bool worker = false;     ///< This process is the worker that simulates for a server.
};

/// Adds the options of `report` that no other command has.
void add_report_options(CLI::App& command, std::vector<std::string>& scenes, std::string& output, std::string& title,
                        bool& certify, ReportArguments& report);

void add_serve_options(CLI::App& command, ServeArguments& serve);

}  // namespace rheonet::tool
