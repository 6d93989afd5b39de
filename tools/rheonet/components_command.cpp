#include <fmt/format.h>

#include "core/netlist/diagnostic.hpp"
#include "core/network/component.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/reference.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

ExitStatus print_components(const Arguments& arguments) {
  std::vector<const Component*> chosen;
  std::vector<std::string> names;
  for (const Component* component : components()) {
    const Declaration& d = component->declaration;
    names.push_back(d.type);
    if (!d.rotational_type.empty()) names.push_back(d.rotational_type);
    if (arguments.type.empty() || arguments.type == d.type || arguments.type == d.rotational_type) {
      chosen.push_back(component);
    }
  }
  if (chosen.empty()) {
    const std::string here = called_here(arguments.type, declarations()), near = did_you_mean(arguments.type, names);
    say("error: unknown element type `{}`\n", arguments.type);
    if (const std::string& hint = here.empty() ? near : here; !hint.empty()) say("  {}\n", hint);
    say("  `rheonet components` lists them all\n");
    return wrong_input;
  }
  if (arguments.markdown) {
    fmt::print("{}", as_markdown(chosen));
    return done;
  }
  if (arguments.type.empty())
    fmt::print("{}", as_list(chosen));
  else
    fmt::print("{}", as_text(*chosen.front()));
  return done;
}

}  // namespace rheonet::tool
