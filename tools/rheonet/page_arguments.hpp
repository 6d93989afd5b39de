#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rheonet::tool {

/// Of `report`.
struct ReportArguments {
  bool precision = false;  ///< also what accuracy costs
};

/// Of `serve`.
struct ServeArguments {
  std::string folder;  ///< "": the netlists that come with rheonet
  std::string host = "127.0.0.1";
  std::string framed_by;   ///< origin whose pages may show the playground in a frame; "*": all; "": none
  int port = 8017;         ///< 0: any that is free
  double seconds = 20;     ///< that a scene may take
  int megabytes = 1024;    ///< that a scene may take
  bool open = false;       ///< in the user's browser
  bool worker = false;     ///< is the process that simulates for a server
};

/// What goes into a report, and where: the options of `report` but for those that other commands have too.
void add_report_options(CLI::App& command, std::vector<std::string>& scenes, std::string& output, std::string& title,
                        bool& certify, ReportArguments& report);

void add_serve_options(CLI::App& command, ServeArguments& serve);

}  // namespace rheonet::tool
