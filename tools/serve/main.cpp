#include <string_view>

#include "tools/rheonet/program.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/serve/playground.hpp"

// What `rheonet serve` becomes, with the words that it was given: a program of its own, as the others should not take the time
// to load an HTTP server.
int main(int count, char** words) {
  using namespace rheonet::tool;
  // Its help and its mistakes are those of `rheonet serve`.
  if (count < 2 || words[1] != std::string_view("serve")) {
    say("error: this is what `rheonet serve` starts\n  `rheonet serve --help` lists what there is\n");
    return wrong_input;
  }
  return run_program(count, words, [](const Arguments& arguments) { return rheonet::serve::play(arguments.serve); });
}
