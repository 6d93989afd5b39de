#include <string_view>

#include "tools/rheonet/program.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/serve/playground.hpp"

// The program that `rheonet serve` replaces itself by, with the same arguments. It is separate so that the other commands need not load an
// HTTP server.
int main(int count, char** words) {
  using namespace rheonet::tool;
  // The program's help and error messages speak of `rheonet serve`.
  if (count < 2 || words[1] != std::string_view("serve")) {
    say("error: this is what `rheonet serve` starts\n  `rheonet serve --help` lists what there is\n");
    return wrong_input;
  }
  return run_program(count, words, [](const Arguments& arguments) { return rheonet::serve::play(arguments.serve); });
}
