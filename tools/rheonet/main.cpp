#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/say.hpp"

namespace {

using namespace rheonet::tool;

ExitStatus carry_out(const Arguments& arguments) {
  using Command = Arguments::Command;
  switch (arguments.command) {
    case Command::run:
      return run_scene(arguments);
    case Command::check:
      return check_scene(arguments);
    case Command::explain:
      return explain_scene(arguments);
    case Command::effects:
      return weigh_effects(arguments);
    case Command::compare:
      return compare_scenes(arguments);
    case Command::precision:
      return price_scene(arguments);
    case Command::sweep:
      return sweep_scene(arguments);
    case Command::plot:
      return plot_results(arguments);
    case Command::draw:
      return draw_network(arguments);
    case Command::report:
      return write_report(arguments);
    case Command::serve:
      return serve_playground(arguments);
    case Command::components:
      return print_components(arguments);
    case Command::schema:
      fmt::print("{}\n", rheonet::json_schema(rheonet::declarations()));
      return done;
  }
  return wrong_input;
}

}  // namespace

int main(int count, char** words) {
  fail_writes_with_errors();
  try {
    const std::variant<Arguments, ExitStatus> read = read_arguments({words + 1, words + count});
    if (const ExitStatus* status = std::get_if<ExitStatus>(&read)) return *status;
    const ExitStatus status = carry_out(std::get<Arguments>(read));
    if (std::fflush(stdout) != 0) {
      say("error: cannot write to standard output\n");
      return not_simulated;
    }
    return status;
  } catch (const std::system_error& error) {
    say("error: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    say("error: out of memory\n");
  } catch (const std::exception& error) {
    say("error: a mistake in rheonet itself: {}\n", error.what());
  }
  return not_simulated;
}
