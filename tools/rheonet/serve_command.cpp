#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/library.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

ExitStatus serve_playground(const Arguments& arguments) {
  std::string server = (program_folder() / "rheonet-serve").string();
  std::vector<std::string> given = arguments.words;
  std::vector<char*> words{server.data()};
  for (std::string& word : given) words.push_back(word.data());
  words.push_back(nullptr);
  ::execv(server.c_str(), words.data());
  say("error: `serve` cannot begin: `{}`: {}\n  it belongs beside `rheonet`: build or install both\n", printable(server), std::strerror(errno));
  return not_simulated;
}

}  // namespace rheonet::tool
