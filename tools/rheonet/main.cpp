#include <fmt/format.h>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/expression_reference.hpp"
#include "tools/rheonet/program.hpp"

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
    case Command::expressions:
      fmt::print("{}", arguments.markdown ? expressions_as_markdown() : expressions_as_text());
      return done;
    case Command::schema:
      fmt::print("{}\n", rheonet::json_schema(rheonet::declarations()));
      return done;
  }
  return wrong_input;
}

}  // namespace

int main(int count, char** words) { return rheonet::tool::run_program(count, words, carry_out); }
