#include "tools/rheonet/program.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/serve/playground.hpp"

// What `rheonet serve` becomes, with the words that it was given: a program of its own, as the others should not take the time
// to load an HTTP server.
int main(int count, char** words) {
  using namespace rheonet::tool;
  return run_program(count, words, [](const Arguments& arguments) {
    if (arguments.command == Arguments::Command::serve) return rheonet::serve::play(arguments.serve);
    say("error: this is what `rheonet serve` starts\n");
    return wrong_input;
  });
}
